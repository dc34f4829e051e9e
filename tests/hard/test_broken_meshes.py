"""Meshes with faces missing, turned over, doubled or without area: drawn as surfaces with two sides, and reported.

Back-face culling makes a box with one face turned over lose that face; doubled faces make every edge non-manifold; a
triangle whose corners lie on one line has no normal, so every angle at it is noise.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import agrees, by_oracle, defects
from support.meshes import BOX_EDGES, box, merged, turned_over

POINTS, TRIANGLES = box((-10, -10, -10), (10, 10, 10))
INSIDE = box((-4, -4, -4), (4, 4, 4))
VIEWS = ["iso", "iso-nw", (1, 2, -1), "front", "top"]


def without(face):
    return np.delete(TRIANGLES, [2 * face, 2 * face + 1], axis=0)


def flipped(*numbers):
    out = TRIANGLES.copy()
    for n in numbers:
        out[n] = out[n][::-1]
    return out


BROKEN = {
    "sound": (TRIANGLES, []),
    "inside out": (TRIANGLES[:, ::-1], [(1, "inside out")]),
    "one face turned": (flipped(0, 1), [(4, "opposite orientation")]),
    "one triangle turned": (flipped(6), [(3, "opposite orientation")]),
    "front missing": (without(2), [(4, "border")]),
    "top missing": (without(5), [(4, "border")]),
    "left missing": (without(0), [(4, "border")]),
    "two missing": (np.delete(TRIANGLES, [0, 1, 2, 3], axis=0), [(8, "border")]),
    "some twice": (np.concatenate([TRIANGLES, TRIANGLES[:5]]), [(5, "duplicated")]),
    "some twice, turned": (np.concatenate([TRIANGLES, TRIANGLES[:5, ::-1]]), [(5, "duplicated")]),
}


@pytest.mark.slow
@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("name", BROKEN)
def test_what_lies_inside_is_seen_only_through_what_is_open(picture, name, view):
    points, triangles = merged((POINTS, BROKEN[name][0]), INSIDE)
    drawing = hlr.draw((points, triangles), view, **AT_SIZE)
    edges = [*BOX_EDGES, *((i + 8, j + 8) for i, j in BOX_EDGES)]
    agrees(drawing, by_oracle(drawing, points, triangles, edges), step=0.3)
    if view == "iso" and name == "front missing":
        picture(drawing)


@pytest.mark.parametrize("name", BROKEN)
def test_what_is_wrong_is_said(name):
    triangles, said = BROKEN[name]
    found = defects((POINTS, triangles))
    assert len(found) == len(said)
    for text, (count, word) in zip(found, said, strict=True):
        assert str(count) in text and word in text


@pytest.mark.parametrize("name", [n for n in BROKEN if BROKEN[n][1]])
def test_a_drawing_notes_what_is_wrong(name):
    assert hlr.draw((POINTS, BROKEN[name][0]), "iso", **AT_SIZE).notes


def needle(a, b, middle):
    """The box with a triangle without area along a -> b, its third corner in between."""
    points = np.concatenate([POINTS, [middle]])
    return points, np.concatenate([TRIANGLES, [[a, b, 8]]])


@pytest.mark.parametrize("middle", [(0, -10, -10), (3, -10, -10), (20, -10, -10)])
def test_a_triangle_without_area_changes_nothing(middle):
    # Along the edge from (-10, -10, -10) to (10, -10, -10), and beyond its end.
    points, triangles = needle(0, 4, middle)
    for view in VIEWS:
        drawing = hlr.draw((points, triangles), view, **AT_SIZE)
        edges = [*BOX_EDGES, (4, 8)] if middle[0] > 10 else BOX_EDGES
        agrees(drawing, by_oracle(drawing, points, triangles, edges), step=0.3)


@pytest.mark.parametrize("corner", [0, 3, 7])
def test_a_triangle_with_two_corners_in_one_place_is_left_out_and_noted(corner):
    triangles = np.concatenate([TRIANGLES, [[corner, corner, 1], [2, 5, 5]]])
    drawing = hlr.draw((POINTS, triangles), "iso", **AT_SIZE)
    assert "2 degenerate triangles (two corners in one place) were left out." in map(str, drawing.notes)
    agrees(drawing, by_oracle(drawing, POINTS, TRIANGLES, BOX_EDGES))


def test_a_triangle_without_area_is_reported_as_such():
    said = " ".join(defects(needle(0, 4, (0, -10, -10))))
    assert "area" in said or "degenerate" in said


def test_a_hollow_solid_is_no_defective_one_to_look_at():
    # The void's faces are turned inward, as they must be: culling by orientation alone would show it from outside.
    points, triangles = merged((POINTS, TRIANGLES), turned_over(INSIDE))
    edges = [*BOX_EDGES, *((i + 8, j + 8) for i, j in BOX_EDGES)]
    for view in VIEWS:
        drawing = hlr.draw((points, triangles), view, **AT_SIZE)
        agrees(drawing, by_oracle(drawing, points, triangles, edges), step=0.3)
