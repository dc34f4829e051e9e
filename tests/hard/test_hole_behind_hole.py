"""Plates with equal holes exactly behind one another, and a checkerboard: a look past many borders at once.

All borders of the holes are collinear in the image; one sign wrong on one of them and the view through is blocked, or
what is beside the hole shows.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import agrees, by_oracle, expect
from support.meshes import as_parts, box, box_lines, grid, merged, ring

HOLE = [(-5, 0, -5), (5, 0, -5), (5, 0, 5), (-5, 0, 5)]
RIM = [(-15, 0, -15), (15, 0, -15), (15, 0, 15), (-15, 0, 15)]


def plate(y):
    """A square of 30 with a square hole of 10 in the middle, in a plane square to y."""
    xs = (-15.0, -5.0, 5.0, 15.0)
    points, triangles = grid(np.array([[(x, y, z) for z in xs] for x in xs]))
    # Cell 4 of 3 x 3 is the hole; two triangles each.
    return points, np.delete(triangles, [8, 9], axis=0)


@pytest.mark.parametrize("how", [merged, as_parts])
@pytest.mark.parametrize("count", [1, 2, 20])
def test_through_all_holes_a_bar_is_seen_between_their_borders(picture, how, count):
    low, high = (-9, 90, -2), (9, 94, 2)
    drawing = hlr.draw(how(*(plate(4.0 * k) for k in range(count)), box(low, high)), "front", **AT_SIZE)
    seen = [*ring(RIM), *ring(HOLE), *(((-5, 90, z), (5, 90, z)) for z in (-2, 2))]
    unseen = [((s * 5, 90, z), (s * 9, 90, z)) for s in (-1, 1) for z in (-2, 2)]
    unseen += [((s * 9, 90, -2), (s * 9, 90, 2)) for s in (-1, 1)]
    agrees(drawing, expect(drawing, seen, unseen))
    if count == 2 and how is merged:
        picture(drawing)


@pytest.mark.parametrize("how", [merged, as_parts])
def test_a_block_exactly_as_large_as_the_holes(how):
    # Its front lies on the borders in the image: there once, as part of the first plate's hole.
    low, high = (-5, 90, -5), (5, 94, 5)
    drawing = hlr.draw(how(plate(0.0), plate(4.0), box(low, high)), "front", **AT_SIZE)
    agrees(drawing, expect(drawing, [*ring(RIM), *ring(HOLE)]))


@pytest.mark.parametrize("view", ["front", (0.2, -1, 0.1), "iso"])
def test_through_a_checkerboard_every_other_square_is_seen(picture, view):
    n = 6
    cells = [(i, j) for i in range(n) for j in range(n) if (i + j) % 2]
    squares = [
        [(4.0 * i, 0, 4.0 * j), (4.0 * i + 4, 0, 4.0 * j), (4.0 * i + 4, 0, 4.0 * j + 4), (4.0 * i, 0, 4.0 * j + 4)]
        for i, j in cells
    ]
    board = (
        np.array(squares).reshape(-1, 3),
        np.array([[4 * k + a, 4 * k + b, 4 * k + c] for k in range(len(cells)) for a, b, c in ((0, 1, 2), (0, 2, 3))]),
    )
    points, triangles = merged(board, box((3, 5, 3), (21, 7, 19)))
    first = len(board[0])
    edges = [(4 * k + i, 4 * k + (i + 1) % 4) for k in range(len(cells)) for i in range(4)]
    edges += [(first + i, first + j) for i in range(8) for j in range(i + 1, 8) if bin(i ^ j).count("1") == 1]
    drawing = hlr.draw((points, triangles), view, **AT_SIZE)
    agrees(drawing, by_oracle(drawing, points, triangles, edges), step=0.3)
    assert len(box_lines((3, 5, 3), (21, 7, 19))) == 12
    if view == (0.2, -1, 0.1):
        picture(drawing, "checkerboard")
