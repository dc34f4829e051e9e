"""Boxes stacked and then turned: faces that coincide, at corners that are rounded each for itself.

Of 1,800 faces of turned boxes hardly any has its four corners in one plane: after rounding to any grid, each of two
faces in contact lies in front of the other somewhere. The joint is seen where both boxes are, and nowhere else.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import agrees, by_oracle, expect
from support.meshes import BOX_EDGES, as_parts, box, box_lines, merged, moved, rotation

LEVELS = [0.0, 7.0, 13.0, 20.0]
TURNS = [rotation(axis, angle) for axis, angle in (((1, 2, 3), 0.4), ((3, -1, 1), 1.3), ((1, 1, 0), 1))]
TOWARDS = [(1, -1, 1), (2, 1, -1), (-1, 3, 0.2), (0, 0, 1), (0, -1, 0)]


def stack(turn, shrink=0.0):
    """Boxes on top of one another, each narrower by `shrink`, in the frame of the turn."""
    low = [(-8 + k * shrink, -6 + k * shrink, LEVELS[k]) for k in range(3)]
    high = [(8 - k * shrink, 6 - k * shrink, LEVELS[k + 1]) for k in range(3)]
    return [moved(box(a, b), lambda p: p @ turn.T) for a, b in zip(low, high, strict=True)]


def stack_lines(shrink):
    """In the upright frame the same, exactly, as the oracle wants it."""
    return merged(*stack(np.eye(3), shrink))


@pytest.mark.slow
@pytest.mark.parametrize("how", [merged, as_parts])
@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("toward", TOWARDS)
@pytest.mark.parametrize("shrink", [0.0, 1.5])
def test_a_turned_stack_is_drawn_like_an_upright_one(picture, how, turn, toward, shrink):
    up = (0, 1, 0) if toward == (0, 0, 1) else (0, 0, 1)
    drawing = hlr.draw(how(*stack(turn, shrink)), tuple(turn @ toward), up=tuple(turn @ up), **AT_SIZE)
    upright = hlr.draw(how(*stack(np.eye(3), shrink)), toward, up=up, **AT_SIZE)
    edges = [(i + 8 * k, j + 8 * k) for k in range(3) for i, j in BOX_EDGES]
    wanted = by_oracle(upright, *stack_lines(shrink), edges)
    agrees(upright, wanted, step=0.3)
    agrees(drawing, wanted, step=0.3)
    if toward == (1, -1, 1) and shrink and turn is TURNS[0] and how is merged:
        picture(drawing)


@pytest.mark.parametrize("turn", TURNS)
def test_the_joints_of_a_straight_stack_by_hand(turn):
    # From (1, -1, 1): the sides x = 8 and y = -6 and the top are seen; each joint is visible along the two and hidden
    # along the other two.
    drawing = hlr.draw(merged(*stack(turn)), tuple(turn @ (1, -1, 1)), up=tuple(turn @ (0, 0, 1)), **AT_SIZE)
    seen, unseen = [], []
    for z in LEVELS[:-1]:
        seen += [((8, -6, z), (8, 6, z)), ((-8, -6, z), (8, -6, z))]
        unseen += [((-8, 6, z), (-8, -6, z)), ((8, 6, z), (-8, 6, z))]
    seen += [line for line in box_lines((-8, -6, 20), (8, 6, 20)) if not np.array_equal(*line)]
    for x, y in ((8, -6), (8, 6), (-8, -6)):
        seen.append(((x, y, 0), (x, y, 20)))
    unseen.append(((-8, 6, 0), (-8, 6, 20)))
    place = lambda lines: [tuple(turn @ p for p in line) for line in lines]  # noqa: E731
    agrees(drawing, expect(drawing, place(seen), place(unseen)))
