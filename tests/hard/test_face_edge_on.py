"""A view exactly in the plane of a face, and 1e-12 off it: the face is a line, and hides nothing.

Its area in the image is zero or the rounding of zero, of either sign; as a divisor it sends depths to infinity.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import agrees, expect
from support.meshes import as_parts, box, box_lines, face, merged, moved, rotation

SHEET = [(-10, -10, 0), (10, -10, 0), (10, 10, 0), (-10, 10, 0)]
OFF = [0.0, 1e-15, 1e-12, 1e-9, -1e-12, -1e-9, 1e-7]
TURNS = [np.eye(3), rotation((1, 2, 3), 0.7)]


@pytest.mark.parametrize("off", OFF)
@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("how", [merged, as_parts])
def test_a_sheet_on_edge_is_one_line_and_hides_nothing(picture, off, turn, how):
    # Behind it a block, above and below the sheet's plane: the sheet's line crosses its face, in front.
    low, high = (-4, 20, -5), (4, 28, 5)
    model = how(*(moved(m, lambda p: p @ turn.T) for m in (face(*SHEET), box(low, high))))
    drawing = hlr.draw(model, tuple(turn @ (0, -1, off)), up=tuple(turn @ (0, 0, 1)), **AT_SIZE)
    front = [line for line in box_lines(low, high) if line[0][1] == line[1][1] == 20]
    wanted = [*front, ((-10, -10, 0), (10, -10, 0))]
    agrees(drawing, expect(drawing, [tuple(turn @ p for p in line) for line in wanted]))
    if off == 1e-12 and turn is TURNS[0]:
        picture(drawing)


@pytest.mark.parametrize("off", OFF)
@pytest.mark.parametrize("turn", TURNS)
def test_behind_a_block_the_line_is_hidden(off, turn):
    low, high = (-4, -28, -5), (4, -20, 5)
    model = merged(*(moved(m, lambda p: p @ turn.T) for m in (face(*SHEET), box(low, high))))
    drawing = hlr.draw(model, tuple(turn @ (0, -1, off)), up=tuple(turn @ (0, 0, 1)), **AT_SIZE)
    front = [line for line in box_lines(low, high) if line[0][1] == line[1][1] == -28]
    seen = [*front, ((-10, -10, 0), (-4, -10, 0)), ((4, -10, 0), (10, -10, 0))]
    place = lambda lines: [tuple(turn @ p for p in line) for line in lines]  # noqa: E731
    agrees(drawing, expect(drawing, place(seen), place([((-4, -10, 0), (4, -10, 0))])))


@pytest.mark.parametrize("off", OFF)
def test_a_stack_of_sheets_on_edge_and_a_line_through_all_of_them(off):
    # Parallel sheets seen on edge, and a needle that points at the viewer: it is a point, and nothing on paper.
    sheets = [face(*((x, y, z) for x, y, _ in SHEET)) for z in (-3.0, 0.0, 3.0)]
    needle = face((1, -15, 1), (1, 15, 1), (1, 0, 1 + 1e-9))
    drawing = hlr.draw(merged(*sheets, needle), (0, -1, off), **AT_SIZE)
    agrees(drawing, expect(drawing, [((-10, 0, z), (10, 0, z)) for z in (-3, 0, 3)]))
