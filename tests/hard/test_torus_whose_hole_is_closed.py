"""A torus whose hole is closed but for a hundredth of a micrometre to a micrometre.

At the neck the surface bends a million times more sharply around the axis than along it. A mesher that lays out its
points in a stretched chart of (u, v) has edges there that pass points on the wrong side; with a chart that is not
stretched, a small solid gets a million triangles, and takes a minute.
"""

from __future__ import annotations

import cadquery as cq
import pytest
from hard.brep import arc, like, ring

import hlr
from support.at_size import AT_SIZE
from support.expected import expect

MAJOR = 10.0
OPEN = 1e-2
"""Of the radius: half the width of a hole that any mesher copes with."""
CLOSED = [1e-5, 1e-6, 1e-7, 1e-9]


def torus(hole):
    return cq.Solid.makeTorus(MAJOR, MAJOR * (1 - hole))


@pytest.mark.parametrize("view", ["front", "iso"])
def test_it_has_as_many_triangles_as_one_with_a_hole(view):
    usual = hlr.draw(torus(OPEN), view, page="A4").counters["triangles"]
    for hole in CLOSED:
        assert hlr.draw(torus(hole), view, page="A4").counters["triangles"] < 1.05 * usual, hole


@pytest.mark.parametrize("hole", CLOSED)
def test_from_the_side_a_stadium_with_its_inner_half_circles_hidden(hole):
    drawing = hlr.draw(torus(hole), "front", **AT_SIZE)
    minor = MAJOR * (1 - hole)
    seen, unseen = [((-MAJOR, 0, s * minor), (MAJOR, 0, s * minor)) for s in (1, -1)], []
    for s in (1, -1):
        seen += arc((s * MAJOR, 0, 0), (s * minor, 0, 0), (0, 0, minor), -90, 90)
        unseen += arc((s * MAJOR, 0, 0), (s * minor, 0, 0), (0, 0, minor), 90, 270)
    like(drawing, expect(drawing, seen, unseen))


def test_along_its_axis_one_circle():
    for hole in CLOSED:
        drawing = hlr.draw(torus(hole), "top", **AT_SIZE)
        like(drawing, expect(drawing, ring(MAJOR * (2 - hole)), []))
