"""A comb of a thousand thin plates, one accuracy apart: every tolerance for "touches" is as large as the gaps.

A contact tolerance that is not held below the plates' own thickness lets the second plate show through the first; one
that grows with the model, as an eight-thousandth of it, does so in large models only.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import differences, expect, ink
from support.meshes import as_parts, box, box_lines, face, merged

ACCURACY = 0.05
COUNT = 1000
HIGH = 20.0


def plates(count, thickness):
    """Boxes at x = 0, -0.05, -0.1 and so on, each lower than the one before; without thickness, sheets."""
    for k in range(count):
        x, low, high = -k * ACCURACY, 0.002 * k, HIGH - 0.002 * k
        if thickness:
            yield box((x - thickness, low, low), (x, 30 - low, high))
        else:
            yield face((x, low, low), (x, 30 - low, low), (x, 30 - low, high), (x, low, high))


@pytest.mark.parametrize("how", [merged, as_parts])
@pytest.mark.parametrize("thickness", [0.0, 0.1, 0.5, 0.9])
def test_the_first_plate_hides_all_others(how, thickness):
    count = COUNT if how is merged else 100
    model = how(*plates(count, thickness * ACCURACY))
    drawing = hlr.draw(model, "right", accuracy=ACCURACY, hidden=False, scale=1.0, smooth=False, details=True)
    (first,) = [expect(drawing, [line for line in box_lines((0, 0, 0), (0, 30, HIGH)) if not np.array_equal(*line)])]
    assert differences(first, ink(drawing), ACCURACY) == []


@pytest.mark.parametrize("thickness", [0.1, 0.5, 0.9])
def test_from_the_front_the_edges_lie_one_beside_the_other(picture, thickness):
    count = 50
    t = thickness * ACCURACY
    drawing = hlr.draw(merged(*plates(count, t)), "front", accuracy=ACCURACY, **AT_SIZE)
    lines = []
    for k in range(count):
        low, high = 0.002 * k, HIGH - 0.002 * k
        for x in (-k * ACCURACY, -k * ACCURACY - t):
            lines.append(((x, 0, low), (x, 0, high)))
        lines += [((-k * ACCURACY - t, 0, z), (-k * ACCURACY, 0, z)) for z in (low, high)]
    # Neighbours closer than half the accuracy are drawn as one; no line is farther than the accuracy from a true one.
    assert differences(expect(drawing, lines), ink(drawing), ACCURACY, ends=ACCURACY) == []
    if thickness == 0.5:
        picture(drawing)


@pytest.mark.parametrize("how", [merged, as_parts])
@pytest.mark.parametrize("thickness", [0.0, 0.5])
def test_obliquely_only_steps_at_the_ends_are_seen(how, thickness):
    model = how(*plates(100, thickness * ACCURACY))
    drawing = hlr.draw(model, (1, 0.01, 0.01), accuracy=ACCURACY, hidden=False, scale=1.0, smooth=False, details=True)
    # Seen 0.01 off their normal, the plates shrink by 0.002 and shift by 0.0005 from one to the next: all are hidden.
    (first,) = [expect(drawing, [line for line in box_lines((0, 0, 0), (0, 30, HIGH)) if not np.array_equal(*line)])]
    assert differences(first, ink(drawing), ACCURACY) == []
