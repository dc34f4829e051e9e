"""Half a ball, or half a torus, seen along its axis: its rim is also its outline, and one circle.

The curved face is seen edge-on all along the rim, and turned toward the viewer beside it: the rim is visible, chord by
chord. Else pieces of the edge and pieces of the outline take turns around the circle.
"""

from __future__ import annotations

import cadquery as cq
import pytest

import hlr


def ball(size):
    cube = cq.Workplane().box(60 * size, 60 * size, 60 * size).translate((0, 0, 30 * size))
    return cq.Workplane().sphere(25 * size).intersect(cube)


def bowl(size):
    return ball(size).cut(cq.Workplane().sphere(22 * size))


def ring(size):
    cube = cq.Workplane().box(60 * size, 60 * size, 60 * size).translate((0, 0, -30 * size))
    return cq.Workplane(cq.Solid.makeTorus(20 * size, 6 * size)).cut(cube)


@pytest.mark.parametrize("size", [0.04, 1.0, 1000.0])
@pytest.mark.parametrize(("shape", "circles"), [(ball, 1), (bowl, 1), (ring, 2)])
@pytest.mark.parametrize("view", ["top", "bottom"])
def test_the_rim_is_one_circle(shape, circles, view, size):
    drawing = hlr.draw(shape(size), view, hidden=True)
    seen = drawing.visible
    assert [line.kind for line in seen] == ["sharp"] * (2 if view == "bottom" and shape is bowl else circles)
    assert all(abs(line.curve.angles[1] - line.curve.angles[0]) == pytest.approx(6.283185, abs=1e-5) for line in seen)
