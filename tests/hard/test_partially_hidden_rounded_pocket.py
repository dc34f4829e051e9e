"""Two rounded pockets on opposite faces, of one height and different width: their long edges lie on one line.

Seen through the smaller, the edge of the larger one behind it is hidden but for the part that the smaller one leaves
open; FreeCAD draws all of it once the corners are rounded (FreeCAD#30101). The edges end in tangent lines at the
roundings, which are drawn only when asked for.
"""

from __future__ import annotations

import cadquery as cq
import pytest
from hard.brep import arc, like, walk

import hlr
from support.at_size import AT_SIZE
from support.expected import expect, of_kind

WIDE, TALL, DEEP = 80.0, 40.0, 20.0
SMALL, LARGE, HIGH, ROUND = 15.0, 30.0, 10.0, 4.0
"""Half widths and half height of the pockets, radius of their corners. They meet in the middle."""


def plate():
    body = cq.Workplane().box(WIDE, DEEP, TALL)
    for half, y in ((SMALL, -DEEP / 2), (LARGE, 0)):
        cut = cq.Workplane("XZ", origin=(0, y + DEEP / 2, 0)).rect(2 * half, 2 * HIGH).extrude(DEEP / 2)
        body = body.cut(cut.edges("|Y").fillet(ROUND))
    return body


def rounded(half, y):
    """Straight sides and corners of a pocket's rim."""
    x, z = half - ROUND, HIGH - ROUND
    straight = [((-x, y, s * HIGH), (x, y, s * HIGH)) for s in (1, -1)]
    straight += [((s * half, y, -z), (s * half, y, z)) for s in (1, -1)]
    corners = []
    for cx, cz, start in ((x, z, 0), (-x, z, 90), (-x, -z, 180), (x, -z, 270)):
        corners += arc((cx, y, cz), (ROUND, 0, 0), (0, 0, ROUND), start, start + 90)
    return straight, corners


def frame():
    return walk([(x, -DEEP / 2, z) for x, z in ((-40, -20), (40, -20), (40, 20), (-40, 20), (-40, -20))])


def test_from_the_side_of_the_smaller(picture):
    drawing = hlr.draw(plate(), "front", **AT_SIZE)
    straight, corners = rounded(SMALL, -DEEP / 2)
    behind, behind_corners = rounded(LARGE, 0)
    like(drawing, expect(drawing, frame() + straight + corners, behind + behind_corners))
    # The long edges of the larger one are seen by nobody: under the smaller one's, or behind material.
    for line in drawing.lines:
        assert not line.visible or line.points3[:, 1].max() < DEEP / 2 - 1e-6
    picture(drawing)


def test_from_the_side_of_the_larger():
    """Now the smaller rim is seen on the floor of the larger pocket, and coincides with it above and below."""
    drawing = hlr.draw(plate(), "back", **AT_SIZE)
    straight, corners = rounded(LARGE, DEEP / 2)
    inner, inner_corners = rounded(SMALL, 0)
    like(drawing, expect(drawing, [*frame(), *straight, *corners, *inner, *inner_corners]))


@pytest.mark.parametrize("smooth", [False, True])
def test_tangent_lines_of_a_fillet_partly_behind_a_post(smooth):
    """A rounded edge lies along x; a post before it hides the middle of both of its tangent lines."""
    bar = cq.Workplane().box(80, 20, 20).edges("|X and >Z and <Y").fillet(6)
    post = cq.Workplane().box(10, 4, 60).translate((0, -20, 0))
    view = (0, -1, 0.5)
    drawing = hlr.draw(
        cq.Workplane(obj=cq.Compound.makeCompound([bar.val(), post.val()])), view, smooth=smooth, scale=1.0, hidden=True
    )
    tangent = of_kind(drawing, "smooth")
    if not smooth:
        assert not tangent
        return
    for y, z in ((-10, 4), (-4, 10)):
        mine = [line for line in tangent if abs(line.points3[:, 1:] - (y, z)).max() < 1e-6]
        ends = sorted((*sorted(line.points3[[0, -1], 0].round(6).tolist()), line.visible) for line in mine)
        assert ends == [(-40, -5, True), (-5, 5, False), (5, 40, True)]
