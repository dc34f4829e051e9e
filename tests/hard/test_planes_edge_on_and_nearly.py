"""Planar faces seen exactly edge-on, and a billionth off: they hide nothing, show nothing, and flicker not.

The sign of an area that is zero but for rounding decides whether a face is turned to the viewer. A prism with a
slanting roof is drawn along the roof, and a little to each side of it.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest
from hard.brep import like, once, turn, walk

import hlr
from support.at_size import AT_SIZE
from support.expected import expect

ROOF = [(0, 0), (40, 0), (40, 10), (0, 30)]
"""The section in x and z; it runs from y = 0 to 25."""
DEEP = 25.0
ALONG = (40.0, 0.0, -20.0)
"""Down the roof, and up it the other way round."""


def prism():
    return cq.Workplane("XZ").polyline(ROOF).close().extrude(-DEEP)


def expected(drawing):
    """Seen along the roof: the nearer of its ends covers the farther one; the wall below it is in front or behind."""
    d = np.asarray(drawing.view.direction)
    seen, unseen = [], []
    faces = []
    for (x0, z0), (x1, z1) in zip(ROOF, [*ROOF[1:], ROOF[0]], strict=True):
        facing = (z1 - z0) * d[0] - (x1 - x0) * d[2]
        faces.append(facing > 1e-3)
    ends = (d[1] < -1e-3, d[1] > 1e-3)
    for i, (x, z) in enumerate(ROOF):
        edge = ((x, 0, z), (x, DEEP, z))
        (seen if faces[i] or faces[i - 1] else unseen).append(edge)
        following = ROOF[(i + 1) % 4]
        for y, end in ((0, ends[0]), (DEEP, ends[1])):
            edge = ((x, y, z), (following[0], y, following[1]))
            (seen if faces[i] or end else unseen).append(edge)
    return expect(drawing, seen, unseen)


@pytest.mark.parametrize("degrees", [0, 1e-9, -1e-9, 1e-7, -1e-7, 1e-5, -1e-5])
@pytest.mark.parametrize("sense", [1, -1])
def test_along_the_roof(degrees, sense, picture):
    view = turn([sense * c for c in ALONG], (0, 1, 0), degrees)
    drawing = hlr.draw(prism(), view, **AT_SIZE)
    like(drawing, expected(drawing))
    if (degrees, sense) == (1e-9, -1):
        picture(drawing)


@pytest.mark.parametrize("off", [(0, 0), (1e-9, 0), (0, -1e-9), (-1e-9, 1e-9), (1e-7, 1e-7)])
@pytest.mark.parametrize("tilt", [0, 31])
def test_a_box_of_which_five_faces_are_edge_on_or_away(off, tilt):
    """One rectangle is all that is seen, whichever of the sides turns a billionth toward the viewer."""
    box = cq.Workplane().box(30, 20, 10).val().rotate((0, 0, 0), (1, 2, 3), tilt)
    view, up = (turn(v, (1, 2, 3), tilt) for v in ((off[0], -1, off[1]), (0, 0, 1)))
    drawing = hlr.draw(box, view, up=up, **AT_SIZE)
    rectangle = [(x, -10, z) for x, z in ((-15, -5), (15, -5), (15, 5), (-15, 5), (-15, -5))]
    flat = hlr.draw(cq.Workplane().box(30, 20, 10), "front", **AT_SIZE)
    like(drawing, expect(flat, walk(rectangle)))
    once(drawing)
