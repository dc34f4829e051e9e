"""A post with a bar through it, blended, seen along the post: the blends are tangent to the edge-on wall only nearly.

OpenCASCADE's blends of two cylinders turn from their walls by up to a hundred thousandth. Along the wall of the post,
seen edge-on, a blend on its far side then faced the viewer in many short strips, and of the circle of the post behind
the bar a row of dashes was drawn. (Seen on random parts of two cylinders.)
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE

RADIUS, HALF, BAR, REACH = 10.0, 5.0, 5.0, 16.0
ACCURACY = 0.02


def post(aside, below, blend):
    bar = cq.Workplane("XZ").cylinder(2 * REACH, BAR).translate((aside, 0, -below))
    return cq.Workplane().cylinder(2 * HALF, RADIUS).union(bar).edges().fillet(blend)


@pytest.mark.slow
@pytest.mark.parametrize("aside, below, blend", [(0.0, 3.0, 0.6), (0.1, 2.8, 0.6), (1.0, 2.0, 0.5), (1.0, -1.0, 0.5)])
def test_the_circle_goes_on_behind_the_bar(aside, below, blend, picture):
    """In two whole arcs: with those beside the bar, which are visible, they close the circle."""
    part = post(aside, below, blend)
    near, far = ((0, 0, -1), (0, 0, 1)) if below > 0 else ((0, 0, 1), (0, 0, -1))
    drawing = hlr.draw(part, near, accuracy=ACCURACY, **AT_SIZE)
    hidden = [line for line in drawing.lines if not line.visible]
    around = [line for line in drawing.lines if line.visible and on_circle(line)]
    assert (len(hidden), len(around)) == (2, 2)
    assert all(on_circle(line) for line in hidden)
    # Arcs meet within the wide line's width.
    assert sum(angle(line) for line in hidden + around) == pytest.approx(2.0 * np.pi, abs=4 * 0.5 / RADIUS)
    assert straight(drawing) == pytest.approx(straight(hlr.draw(part, far, accuracy=ACCURACY, **AT_SIZE)), abs=ACCURACY)
    if aside == 0.0:
        picture(drawing)


@pytest.mark.slow
def test_the_wall_is_drawn_where_it_stands_in_front():
    """From the other end, the wall stands in front of the same blends: its circle is visible, all around."""
    drawing = hlr.draw(post(0.0, 3.0, 0.6), (0, 0, 1), accuracy=ACCURACY, **AT_SIZE)
    circles = [line for line in drawing.lines if width(line) > 1.9 * RADIUS]
    assert len(circles) == 1
    assert all(line.visible for line in drawing.lines)


def on_circle(line):
    return np.abs(np.hypot(*np.asarray(line.points3)[:, :2].T) - RADIUS).max() < ACCURACY


def angle(line):
    """Radians around the axis of the post, along a line on its circle."""
    way = np.diff(np.asarray(line.points3)[:, :2], axis=0)
    return float(np.hypot(*way.T).sum()) / RADIUS


def straight(drawing):
    """Millimetres of the longest straight line: an outline of the bar's side."""
    return max(float(np.ptp(np.asarray(x.points), axis=0).max()) for x in drawing.lines if len(x.points) == 2)


def width(line):
    return float(np.ptp(np.asarray(line.points), axis=0).min())
