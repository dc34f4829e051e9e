"""A post with a bar through it, blended, seen along the post: the blends are tangent to the edge-on wall only nearly.

OpenCASCADE's blends of two cylinders turn from their walls by up to a hundred thousandth. Along the wall of the post,
seen edge-on, a blend on its far side then faced the viewer in many short strips, and a row of hidden dashes lay on the
circle of the post. (Seen on random parts of two cylinders.)
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
def test_nothing_folds_behind(aside, below, blend, picture):
    """What is turned away is one sheet: it rises along the wall and goes on, and has no outline of its own."""
    part = post(aside, below, blend)
    near, far = ((0, 0, -1), (0, 0, 1)) if below > 0 else ((0, 0, 1), (0, 0, -1))
    drawing = hlr.draw(part, near, accuracy=ACCURACY, **AT_SIZE)
    assert [line for line in drawing.lines if not line.visible] == []
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


def straight(drawing):
    """Millimetres of the longest straight line: an outline of the bar's side."""
    return max(float(np.ptp(np.asarray(x.points), axis=0).max()) for x in drawing.lines if len(x.points) == 2)


def width(line):
    return float(np.ptp(np.asarray(line.points), axis=0).min())
