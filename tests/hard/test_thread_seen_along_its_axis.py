"""A helix seen along its axis: all its turns lie on one another, and the circle is drawn once.

Drawn once a turn, the dashes of a hidden one fill each other's gaps: it looks like a visible line.
"""

from __future__ import annotations

from pathlib import Path

import cadquery as cq
import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import doubled
from support.measures import length

SCREW = Path(__file__).parents[1] / "data" / "M6-1x12-countersunk-screw.step"
PITCH, RADIUS, HALF = 2.5, 6.0, 0.5


def wire(turns):
    return cq.Workplane(obj=cq.Wire.makeHelix(PITCH, PITCH * turns, RADIUS))


def channel(turns):
    """A bar with a square channel along a helix, which ends inside it."""
    size = 2 * HALF
    void = cq.Workplane("XZ").center(RADIUS, 0).rect(size, size).sweep(wire(turns), isFrenet=True)
    return cq.Workplane().circle(8).extrude(PITCH * turns + 10).translate((0, 0, -5)).cut(void)


def spring(turns):
    return cq.Workplane("XZ").center(RADIUS, 0).rect(2 * HALF, 2 * HALF).sweep(wire(turns), isFrenet=True)


@pytest.mark.slow
@pytest.mark.parametrize("turns", [3, 6.25, 25])
@pytest.mark.parametrize("view", ["top", "bottom"])
def test_each_hidden_circle_is_there_once(view, turns):
    drawing = hlr.draw(channel(turns), view, **AT_SIZE)
    hidden = [line for line in drawing.lines if not line.visible]
    for radius in (RADIUS - HALF, RADIUS + HALF):
        circle = [line for line in hidden if at(line, radius)]
        assert sum(map(length, circle)) == pytest.approx(2 * np.pi * radius, rel=0.01)


@pytest.mark.slow
def test_a_spring_is_two_circles_none_of_them_hidden(picture):
    drawing = hlr.draw(spring(7.5), "top", **AT_SIZE)
    for radius in (RADIUS - HALF, RADIUS + HALF):
        circle = [line for line in drawing.lines if at(line, radius) and np.ptp(line.points, axis=0).max() > 0.5]
        assert all(line.visible for line in circle)
        assert sum(map(length, circle)) == pytest.approx(2 * np.pi * radius, rel=0.01)
    picture(drawing)


@pytest.mark.parametrize("view", ["top", "bottom"])
def test_no_line_of_a_real_screw_lies_on_another(view):
    assert doubled(hlr.draw(SCREW, view, hidden=True)) == 0.0


def at(line, radius):
    """Whether all of a line is so far from the axis of the model."""
    x, y, _ = np.asarray(line.points3).T
    return abs(np.hypot(x, y) - radius).max() < 0.05
