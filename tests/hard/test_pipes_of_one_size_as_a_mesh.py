"""Two pipes of one size that cross, as an exporter's mesh: they meet in two ellipses, whose fold falls from 90 degrees
to nothing where the ellipses cross. The creases go on below the crease angle; nothing is missing in the middle.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr
from support.at_size import ALL_LINES

RADIUS, LENGTH = 10.0, 60.0


def pipes(size, deflection, angle):
    """(points, triangles) of the two, their axes along x and y, each as long as six radii."""
    one = cq.Workplane("XZ").circle(RADIUS).extrude(LENGTH / 2, both=True)
    shape = one.union(cq.Workplane("YZ").circle(RADIUS).extrude(LENGTH / 2, both=True)).val()
    points, triangles = shape.tessellate(deflection, angle)
    return size * np.array([p.toTuple() for p in points]), np.array(triangles)


def creases(drawing):
    return [line.points3 for line in drawing.lines if line.kind == "sharp"]


@pytest.mark.parametrize("size", [0.05, 1.0, 1000.0])
@pytest.mark.parametrize(("deflection", "angle"), [(0.01, 0.1), (0.1, 0.2), (0.2, 0.3)])
def test_the_ellipses_are_whole(size, deflection, angle):
    drawing = hlr.draw(pipes(size, deflection, angle), (1, 2, 5), fit=(150, 150), **ALL_LINES)
    rims, ellipses = 4 * 2 * np.pi * RADIUS, 2 * _ellipse(RADIUS, np.sqrt(2) * RADIUS)
    found = sum(float(np.linalg.norm(np.diff(line, axis=0), axis=1).sum()) for line in creases(drawing)) / size
    assert found == pytest.approx(rims + ellipses, rel=0.02)


@pytest.mark.parametrize("view", [(2, 1, 3), "top", (1, 2, 5)])
def test_no_crease_ends_where_the_ellipses_cross(view):
    drawing = hlr.draw(pipes(1.0, 0.05, 0.15), view, fit=(150, 150), smooth=False)
    near = [line for line in creases(drawing) if np.linalg.norm(line - (0, 0, RADIUS), axis=1).min() < RADIUS / 4]
    assert near
    for line in near:
        ends = np.linalg.norm(line[[0, -1]] - (0, 0, RADIUS), axis=1)
        assert ((ends < 1e-4) | (ends > 0.9 * RADIUS)).all()


@pytest.mark.parametrize(("deflection", "angle"), [(0.005, 0.03), (0.02, 0.1), (0.05, 0.2), (0.2, 0.3)])
def test_a_pipe_that_ends_in_another_meets_it_in_a_v(deflection, angle):
    one = cq.Workplane("XZ").circle(RADIUS).extrude(LENGTH / 2, both=True)
    shape = one.union(cq.Workplane("YZ").circle(RADIUS).extrude(LENGTH / 2)).val()
    points, triangles = shape.tessellate(deflection, angle)
    drawing = hlr.draw((np.array([p.toTuple() for p in points]), np.array(triangles)), "top", fit=(150, 150))
    near = [line for line in creases(drawing) if np.linalg.norm(line - (0, 0, RADIUS), axis=1).min() < 0.5 * RADIUS]
    at_tip = [np.linalg.norm(line - (0, 0, RADIUS), axis=1).argmin() for line in near]
    assert near
    for line, i in zip(near, at_tip, strict=True):
        assert np.linalg.norm(line[i] - (0, 0, RADIUS)) < 1e-4 * RADIUS


def _ellipse(a, b):
    """The length of an ellipse with the half axes a and b."""
    t = np.linspace(0, 2 * np.pi, 20001)
    return float(np.linalg.norm(np.diff([a * np.cos(t), b * np.sin(t)], axis=1), axis=0).sum())
