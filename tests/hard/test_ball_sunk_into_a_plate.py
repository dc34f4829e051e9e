"""A ball sunk into a plate so deep that a ring of its mesh's corners lies just below the plate's top.

Every other triangle of the ball then has no more than a corner below, and so have its neighbours. The plate's plane
crosses them all the same: the line in which the two meet is one circle.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr
from support.at_size import ALL_LINES

RADIUS, TOP = 8.0, 2.5
SUNK = [(3.8, 3.0), (4.4, 3.0), (8.0, 2.0), (8.6, 2.0)]
"""Height of the centre, and the scale: at these, corners of the mesh lie so, at the accuracy of 0.05 mm."""


def drawn(height, scale, view):
    plate = cq.Workplane().box(60, 40, 2 * TOP)
    ball = cq.Workplane().sphere(RADIUS).translate((0, 0, height))
    model = cq.Assembly().add(plate, name="plate").add(ball, name="ball")
    return hlr.draw(model, view, scale=scale, accuracy=0.05, **ALL_LINES)


@pytest.mark.parametrize(("height", "scale"), [*SUNK, (8.0, 1.0), (5.0, 2.0)])
def test_each_line_is_one_circle(height, scale):
    lines = [line for line in drawn(height, scale, "top").lines if line.kind == "intersection"]
    # It comes out of the bottom too, where it is sunk deep.
    levels = [TOP] if height - RADIUS > -TOP else [TOP, -TOP]
    assert sorted(round(float(line.points3[0, 2]), 6) for line in lines) == sorted(levels)
    for line in lines:
        points, radius = line.points3, np.sqrt(RADIUS**2 - (height - line.points3[0, 2]) ** 2)
        assert np.abs(np.hypot(points[:, 0], points[:, 1]) - radius).max() < 0.05 / scale
        assert line.curve is not None and (line.points[0] == line.points[-1]).all()


@pytest.mark.parametrize(("height", "scale"), SUNK)
def test_seen_from_the_side_none_is_in_pieces(height, scale):
    lines = [line for line in drawn(height, scale, "iso").lines if line.kind == "intersection"]
    assert 1 <= len(lines) <= 6
