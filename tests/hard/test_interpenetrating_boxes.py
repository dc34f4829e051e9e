"""Two boxes that run into one another, as CAD assemblies do: edges end where they go into the other box.

CadQuery#593: the projection of interpenetrating solids lacks the lines where they meet, and edges inside the other
solid show. What is drawn is the union as it would be seen; the lines of intersection belong to neither box.
"""

from __future__ import annotations

from dataclasses import replace

import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import agrees, by_oracle, differences, expect, ink, of_kind
from support.meshes import BOX_EDGES, as_parts, box, merged, ring
from support.models import solids

BLOCK = ((-10, -10, -10), (10, 10, 10))
BAR = ((0, -4, -3), (30, 4, 5))
"""Leaves the block through x = 10 only."""
POST = ((4, -16, 0), (16, -4, 20))
"""Cuts the block's edge x = 10, y = -10: sticks out of three faces."""


def brep(*boxes):
    sizes = [tuple(b - a for a, b in zip(*box, strict=True)) for box in boxes]
    return solids(
        *((s, tuple((a + b) / 2 for a, b in zip(*box, strict=True))) for s, box in zip(sizes, boxes, strict=True))
    )


def mesh(*boxes):
    return as_parts(*(box(*b) for b in boxes))


KINDS = pytest.mark.parametrize("kind", [mesh, brep])


@pytest.mark.slow
@KINDS
@pytest.mark.parametrize("other", [BAR, POST])
@pytest.mark.parametrize("view", ["iso", "iso-nw", "front", "top", "right", (3, 2, -1), (3, -2, 2)])
def test_edges_end_where_they_enter(picture, kind, other, view):
    drawing = hlr.draw(kind(BLOCK, other), view, **AT_SIZE)
    edges = [*BOX_EDGES, *((i + 8, j + 8) for i, j in BOX_EDGES)]
    agrees(drawing, by_oracle(drawing, *merged(box(*BLOCK), box(*other)), edges), without=("intersection",))
    if other is POST and view == (3, -2, 2) and kind is mesh:
        picture(drawing)


@KINDS
def test_the_bar_shows_a_rectangle_on_the_face_it_leaves(kind):
    drawing = hlr.draw(kind(BLOCK, BAR), (3, -2, 2), **AT_SIZE)
    # From x > 0, y < 0, z > 0 the face x = 10 is seen. The bar covers what lies behind its top and its front side.
    low, high = BAR[0][1:], BAR[1][1:]
    corners = [(10, low[0], low[1]), (10, high[0], low[1]), (10, high[0], high[1]), (10, low[0], high[1])]
    bottom, back, top, front = ring(corners)
    drawn = ink(replace(drawing, lines=tuple(of_kind(drawing, "intersection"))))
    assert not differences(expect(drawing, [front, top], [bottom, back]), drawn, drawing.accuracy.used)


@KINDS
def test_the_post_stands_in_the_block_by_lines_that_it_hides_itself(kind):
    drawing = hlr.draw(kind(BLOCK, POST), (3, -2, 2), **AT_SIZE)
    # Sides and bottom of the post that meet the block's faces z = 10, y = -10 and x = 10 are all turned away.
    top = [((4, -10, 10), (4, -4, 10)), ((4, -4, 10), (10, -4, 10))]
    under = [((4, -10, 0), (10, -10, 0)), ((10, -10, 0), (10, -4, 0))]
    side = [((4, -10, 0), (4, -10, 10)), ((10, -4, 0), (10, -4, 10))]
    drawn = ink(replace(drawing, lines=tuple(of_kind(drawing, "intersection"))))
    assert not differences(expect(drawing, [], [*top, *under, *side]), drawn, drawing.accuracy.used)
