"""Strips that overlap in a cycle: each lies over the next one and under the one before.

No order from back to front exists, so a painter's algorithm must cut (Newell, Newell and Sancha 1972), and one that
sorts by one depth per face draws one of the crossings wrong.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import agrees, by_oracle, expect
from support.meshes import as_parts, face, merged, moved, rotation

NEAR, FAR, END = 6.0, 10.0, 20.0
"""A strip runs between these distances from the centre, this far each way, and climbs by a quarter of its way."""


def strips(count):
    low, high = -END / 4, END / 4
    one = face((-END, -NEAR, low), (-END, -FAR, low), (END, -FAR, high), (END, -NEAR, high))
    return [moved(one, lambda p, k=k: p @ rotation((0, 0, 1), 2 * np.pi * k / count).T) for k in range(count)]


def by_hand():
    """A strip dives under the one before near its low end, from NEAR to FAR along that one's normal."""
    visible, hidden = [], []
    for k in range(3):
        turn = rotation((0, 0, 1), 2 * np.pi * k / 3)
        for c in (NEAR, FAR):
            # On the line y = -c the distance along the other strip's normal is -x sin 60 + c cos 120.
            cuts = [-END, *(-(d + c / 2) / np.sin(np.pi / 3) for d in (FAR, NEAR)), END]
            at = [turn @ (x, -c, x / 4) for x in cuts]
            visible += [(at[0], at[1]), (at[2], at[3])]
            hidden += [(at[1], at[2])]
        visible += [(turn @ (x, -NEAR, x / 4), turn @ (x, -FAR, x / 4)) for x in (-END, END)]
    return visible, hidden


@pytest.mark.parametrize("model", [merged, as_parts])
def test_each_strip_is_hidden_where_it_dives_under_one_other(picture, model):
    drawing = hlr.draw(model(*strips(3)), "top", **AT_SIZE)
    agrees(drawing, expect(drawing, *by_hand()))
    picture(drawing)


@pytest.mark.parametrize("view", ["bottom", (0.1, -0.2, 1), (1, 1, 3)])
@pytest.mark.parametrize("count", [3, 7])
def test_cycles_from_other_sides(view, count):
    points, triangles = merged(*strips(count))
    drawing = hlr.draw((points, triangles), view, **AT_SIZE)
    sides = [(4 * k + i, 4 * k + (i + 1) % 4) for k in range(count) for i in range(4)]
    agrees(drawing, by_oracle(drawing, points, triangles, sides))
