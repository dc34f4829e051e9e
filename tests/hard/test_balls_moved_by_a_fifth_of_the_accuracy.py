"""Two equal balls, the one moved by a fifth of the accuracy: they touch all over, and have no line in common.

Far from the circle in which they meet their surfaces are steep there, and lie far apart by height, but not at right
angles. So half a circle was drawn.
"""

from __future__ import annotations

import math

import cadquery as cq
import pytest

import hlr
from support.at_size import AT_SIZE

RADIUS = 10.0


def meeting(moved: float) -> float:
    """Length of the line in which the balls meet, mm."""
    ball = cq.Workplane().sphere(RADIUS)
    both = cq.Assembly().add(ball).add(ball.translate((moved, 0.4 * moved, 0.3 * moved)))
    lines = hlr.draw(both, view="iso", **AT_SIZE).lines
    return sum(line.length_mm for line in lines if line.kind == "intersection")


@pytest.mark.parametrize("moved", [0.003, 0.009])
def test_balls_that_touch_have_no_line(moved: float) -> None:
    assert meeting(moved) == 0.0


@pytest.mark.parametrize("moved", [0.2, 0.5])
def test_balls_that_pass_through_one_another_have_one(moved: float) -> None:
    assert meeting(moved) > 0.7 * 2 * math.pi * RADIUS
