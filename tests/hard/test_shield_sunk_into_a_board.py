"""A shield of thin sheet on the frame of a board, and a roof upside down on a plate, sunk in by hundredths of the
deflection or by several.

Planar faces have no chord error: how far one goes beyond another is known, however narrow the triangles are that they
are cut into, and at whatever angle they meet. A tolerance meant for curved faces made contacts of such crossings, so
that their intersection line was not drawn while the edge below stayed hidden. A line must be there at any depth.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest
from hard.brep import compound

import hlr
from support.at_size import ALL_LINES
from support.expected import differences, expect, ink

ACCURACY = 0.05
DEFLECTION = ACCURACY / 2
LONG, WIDE, HIGH, SHEET, ROUND = 14.0, 13.0, 2.0, 0.1, 2.0
LAND = 0.4
"""How much wider than the sheet the frame is, on either side: its upper face has narrow triangles."""
SHARES = [0.01, 0.03, 0.1, 0.24, 0.26, 0.6, 1.0, 2.0, 4.0]
"""Of the deflection."""


def lost(drawing, edges, tolerance):
    told = differences(expect(drawing, edges), ink(drawing), tolerance)
    return [each for each in told if "visible ink is missing" in each]


def ring(margin, radius, height):
    """A rectangular ring of the sheet's thickness and twice the margin; radius: of one corner, or 0."""
    outer = cq.Workplane().rect(LONG + 2 * margin, WIDE + 2 * margin).extrude(height)
    inner = cq.Workplane().rect(LONG - 2 * (SHEET + margin), WIDE - 2 * (SHEET + margin)).extrude(height)
    if radius:
        outer = outer.edges("|Z and >X and >Y").fillet(radius + margin)
        inner = inner.edges("|Z and >X and >Y").fillet(radius - SHEET - margin)
    return outer.cut(inner).val()


def shield(sunk, radius):
    board = cq.Workplane().box(3 * LONG, 3 * WIDE, 1.6).translate((0, 0, -0.9))
    return compound(
        board.union(ring(LAND, 0, 0.1).translate((0, 0, -0.1))).val(), ring(0, radius, HIGH).translate((0, 0, -sunk))
    )


@pytest.mark.slow
@pytest.mark.parametrize("radius", [0, ROUND], ids=["planar", "one corner round"])
@pytest.mark.parametrize("share", SHARES)
def test_there_is_a_line_around_the_foot_of_a_shield(share, radius, picture):
    sunk = share * DEFLECTION
    x, y = LONG / 2, WIDE / 2
    foot = [((-x, -y, 0), (x, -y, 0)), ((x, -y, 0), (x, y - radius, 0))]
    for view in [(1, -1, 1.5), (1, -2, 1)]:
        drawing = hlr.draw(shield(sunk, radius), view, scale=1, accuracy=ACCURACY, **ALL_LINES)
        assert not lost(drawing, foot, ACCURACY + sunk), view
    if (share, radius) == (2.0, ROUND):
        picture(drawing, twice=0.5)


@pytest.mark.parametrize("degrees", [10, 19])
def test_there_is_a_line_where_a_slight_slope_enters(degrees):
    """The ridge of the roof points down: its slope enters the plate in full view."""
    slope = np.tan(np.radians(degrees))
    plate = cq.Workplane().box(80, 80, 5).translate((0, 0, -2.5)).val()
    for share in (0.3, 1.0, 2.0):
        low, high = -share * DEFLECTION, 10 * slope - share * DEFLECTION
        profile = [(0, low), (10, high), (10, 30), (-10, 30), (-10, high)]
        roof = cq.Workplane("YZ").polyline(profile).close().extrude(10).val()
        drawing = hlr.draw(compound(plate, roof), (0.2, -1, 0.1), scale=1, accuracy=ACCURACY, **ALL_LINES)
        line = [((0, low / slope, 0), (10, low / slope, 0))]
        assert not lost(drawing, line, ACCURACY), share
