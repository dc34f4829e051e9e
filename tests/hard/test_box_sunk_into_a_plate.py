"""A box, and a boss, put down on a plate a little too deep or too high: by hundredths of the accuracy, or by several.

Too deep, its lower edges are hidden, and where it enters the plate there is a line; much less deep it rests on the
plate and shows its own edges. Somewhere one takes over from the other: there must be no depth between at which neither
is drawn, from no direction.
"""

from __future__ import annotations

import cadquery as cq
import pytest
from hard.brep import arc, box_edges, compound

import hlr
from support.at_size import ALL_LINES
from support.expected import differences, expect, ink

ACCURACY = 0.05
HALF, THICK, SIDE, HIGH = 20.0, 10.0, 5.0, 10.0
BESIDE = 11.0
"""Where the axis of the boss stands."""
SHARES = [-2.0, -0.5, -0.1, -1e-3, 0.0, 1e-3, 0.01, 0.03, 0.1, 0.12, 0.13, 0.2, 0.4, 0.6, 1.0, 1.5, 2.5, 4.0]


def model(sunk):
    plate = cq.Workplane().box(2 * HALF, 2 * HALF, THICK).translate((0, 0, -THICK / 2))
    box = cq.Workplane().box(2 * SIDE, 2 * SIDE, HIGH).translate((-BESIDE, 0, HIGH / 2 - sunk))
    boss = cq.Workplane().circle(SIDE).extrude(HIGH).translate((BESIDE, 0, -sunk))
    return compound(plate.val(), box.val(), boss.val())


def visible_edges(sunk, view):
    """Of the box above the plate, and of the boss the front of its rims."""
    seen, _ = box_edges((-BESIDE - SIDE, -SIDE, 0), (-BESIDE + SIDE, SIDE, HIGH - sunk), view)
    bottom = arc((BESIDE, 0, 0), (SIDE, 0, 0), (0, SIDE, 0), 200, 340)
    return seen + bottom + arc((BESIDE, 0, HIGH - sunk), (SIDE, 0, 0), (0, SIDE, 0))


@pytest.mark.slow
@pytest.mark.parametrize("share", SHARES)
@pytest.mark.parametrize("view", [(0, -1, 1), (0.1, -1, 0.4), (0.1, -1, 0.15), (0.1, -0.4, 1)], ids=str)
def test_there_is_a_line_around_its_foot_however_deep(share, view, picture):
    drawing = hlr.draw(model(share * ACCURACY), view, scale=1, accuracy=ACCURACY, **ALL_LINES)
    wanted = expect(drawing, visible_edges(share * ACCURACY, view))
    told = differences(wanted, ink(drawing), ACCURACY * (1 + abs(share)))
    assert not [each for each in told if "visible ink is missing" in each]
    if (share, view) == (1.0, (0.1, -1, 0.4)):
        picture(drawing, twice=1.0)
