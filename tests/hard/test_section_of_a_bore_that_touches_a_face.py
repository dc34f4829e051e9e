"""A closed bore whose wall touches the back of its block along a line, cut parallel to that line.

At its mouth, the border of the bore touches that of the block in a vertex, for which the mesh of that face has two
points in one place, one of them without a triangle. Such a point is no piece of what the plane leaves. OpenCASCADE does
not cut this block from the front either.
"""

from __future__ import annotations

import math

import cadquery as cq
import pytest

import hlr
from support.at_size import AT_SIZE
from support.sections import measured_area

SIDE, RADIUS, DEPTH, AT = 16.0, 3.0, 11.0, (5.0, 4.0)
"""Millimetres; the axis of the bore lies at y, z."""


def block() -> cq.Workplane:
    bore = cq.Workplane("YZ").circle(RADIUS).extrude(DEPTH + 1.0).translate((-SIDE / 2 - 1.0, *AT))
    return cq.Workplane().box(SIDE, SIDE, SIDE).cut(bore)


@pytest.mark.parametrize("view", ["front", "back"])
@pytest.mark.parametrize("y", [2.5, 4.9, 6.0, 7.0, 7.9])
def test_it_is_cut_from_both_sides(view, y):
    drawing = hlr.draw(block(), view, section=y, **AT_SIZE)
    width = 2.0 * math.sqrt(RADIUS**2 - (y - AT[0]) ** 2)
    assert measured_area(drawing) == pytest.approx(SIDE * SIDE - DEPTH * width, rel=0.03)


@pytest.mark.parametrize(("view", "place"), [("top", 4.5), ("bottom", 3.5), ("left", 0.0), ("right", -1.0)])
def test_other_planes_cut_it_too(view, place):
    drawing = hlr.draw(block(), view, section=place, **AT_SIZE)
    across = 2.0 * math.sqrt(RADIUS**2 - 0.25)
    lost = math.pi * RADIUS**2 if view in ("left", "right") else across * DEPTH
    assert measured_area(drawing) == pytest.approx(SIDE * SIDE - lost, rel=0.03)


def test_picture(picture):
    picture(hlr.draw(block(), "front", section=6.0, **AT_SIZE))
