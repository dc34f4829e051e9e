"""A mesh that lists each triangle from both sides, and has needles where a vertex lies on an edge of its neighbour.

(KitchenPot.obj of Open3D: 23,288 triangles, 11,650 of them copies, 14 needles.) An edge of such a mesh has four
triangles. Needles stayed, and whether one faced the viewer was a matter of rounding: a line along the wall of the pot.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.needles import prism

VIEW = (0.4, -1.0, 0.3)


def lines(points, triangles, size):
    """The visible and hidden length of each class, and the number of lines."""
    drawing = hlr.draw((points, triangles), VIEW, **{**AT_SIZE, "scale": 1.0 / size})
    classes = sorted({(line.kind, line.visible) for line in drawing.lines})
    length = {of: sum(line.length_mm for line in drawing.lines if (line.kind, line.visible) == of) for of in classes}
    return length, len(drawing.lines)


@pytest.mark.parametrize("size", [0.01, 1.0, 1000.0])
@pytest.mark.parametrize("off", [0.0, 3.0])
@pytest.mark.parametrize("back_first", [False, True])
def test_both_sides_give_the_lines_of_one(size, off, back_first):
    points, front = prism(36, size, off=off)
    back = front[:, ::-1]
    pairs = np.stack([back, front] if back_first else [front, back], axis=1).reshape(-1, 3)
    found, count = lines(points, pairs, size)
    wanted, number = lines(points, front, size)
    assert found == pytest.approx(wanted, abs=0.05)
    assert count == number
