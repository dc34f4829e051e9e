"""A wall without thickness: two faces in one place that look away from each other, closed like a solid.

Half the thickness is nothing, so no contact tolerance is left; culling keeps one of the two, and turned obliquely each
lies before the other somewhere.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import agrees, expect
from support.meshes import BOX_QUADS, as_parts, box, box_lines, merged, moved, ring, rotation, split

TURNS = [np.eye(3), rotation((1, 2, 3), 0.7), rotation((3, -1, 1), 2.0)]
WALL = (np.array([(x, 0.0, z) for x in (-10, 10) for z in (-8, 8)]), split([[0, 2, 3, 1], [0, 1, 3, 2]]))
CORNERS = [(-10, 0, -8), (10, 0, -8), (10, 0, 8), (-10, 0, 8)]
LOW, HIGH = (-4, 5, -3), (3, 11, 4)


def flat_box():
    """The same as a box whose depth is 0: six faces, four of them without area."""
    points, _ = box((-10, 0, -8), (10, 0, 8))
    return points, split(BOX_QUADS)


@pytest.mark.parametrize("how", [merged, as_parts])
@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("wall", [WALL, flat_box()])
def test_it_hides_what_is_behind_it_and_not_itself(picture, how, turn, wall):
    place = lambda lines: [tuple(turn @ p for p in line) for line in lines]  # noqa: E731
    model = how(*(moved(m, lambda p: p @ turn.T) for m in (wall, box(LOW, HIGH))))
    drawing = hlr.draw(model, tuple(turn @ (0.1, -1, 0.2)), up=tuple(turn @ (0, 0, 1)), **AT_SIZE)
    agrees(drawing, expect(drawing, place(ring(CORNERS)), place(box_lines(LOW, HIGH))))
    if turn is TURNS[0] and how is merged:
        picture(drawing)
    # From the other side the block stands before it, and covers nothing of its border.
    back = hlr.draw(model, tuple(turn @ (0, 1, 0)), up=tuple(turn @ (0, 0, 1)), **AT_SIZE)
    front = [line for line in box_lines(LOW, HIGH) if line[0][1] == line[1][1] == HIGH[1]]
    agrees(back, expect(back, place([*ring(CORNERS), *front])))
