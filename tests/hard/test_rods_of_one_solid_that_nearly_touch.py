"""Rods on one foot, side by side, with gaps of a third or more of the deflection between them: one solid.

An outline is moved off its face before visibility is decided: here toward the next rod. Where it was moved as far as
the facets of a coarse mesh are off their surface, it was inside that rod, and both lines at the gap were hidden.
"""

from __future__ import annotations

import cadquery as cq
import pytest

import hlr
from hlr.request.accuracy import TESSELLATION
from support.at_size import AT_SIZE

RADIUS, HEIGHT, RODS = 2.0, 15.0, 4
FRONT = (0.0, -1.0, 0.0)


def rods(gap):
    solid = cq.Workplane().rect(40, 8).extrude(-2)
    for k in range(RODS):
        solid = solid.union(cq.Workplane(origin=(k * (2 * RADIUS + gap) - 8, 0, 0)).circle(RADIUS).extrude(HEIGHT))
    assert solid.solids().size() == 1
    return solid


def coil(gap):
    """A wire of 2 mm that is wound so closely that `gap` is left."""
    pitch, radius = 2.0 + gap, 8.0
    path = cq.Wire.makeHelix(pitch, 4 * pitch, radius)
    start = cq.Plane((radius, 0, 0), (1, 0, 0), (0, 1, pitch / (2 * 3.14159265 * radius)))
    return cq.Workplane(start).circle(1).sweep(cq.Workplane(obj=path), isFrenet=True)


def outlines(gap, accuracy):
    drawing = hlr.draw(rods(gap), FRONT, accuracy=accuracy, **AT_SIZE)
    found = [line for line in drawing.lines if line.kind == "outline"]
    return sorted((round(float(line.points[0][0]), 3), line.visible, round(line.length_mm, 1)) for line in found)


@pytest.mark.parametrize("accuracy", [0.1, 0.03, 0.02, 0.01, 0.002])
@pytest.mark.parametrize("share", [0.33, 0.4, 0.5, 0.6, 1.0])
def test_all_outlines_are_seen(share, accuracy):
    gap = share * TESSELLATION * accuracy
    x = [20 - 8 + k * (2 * RADIUS + gap) + side for k in range(RODS) for side in (-RADIUS, RADIUS)]
    found = outlines(gap, accuracy)
    # Of two outlines as near as this, one may stand for both.
    assert found and all(visible and length == HEIGHT for _, visible, length in found)
    assert all(any(abs(at - wanted) < accuracy + 0.001 for at, *_ in found) for wanted in x)


@pytest.mark.parametrize("view", ["front", (1, 0.02, 0.01)])
def test_the_lines_between_the_turns_of_a_spring_are_seen(view):
    """A line between two turns is seen from end to end: with a gap that a pen shows, as much of it is seen."""

    def seen(gap):
        drawing = hlr.draw(coil(gap), view, accuracy=0.0147, **AT_SIZE)
        return sum(line.length_mm for line in drawing.visible if line.kind == "outline")

    assert seen(0.004) == pytest.approx(seen(0.0065), rel=0.01)
