"""Sheet and tube with walls of 0.01 mm, thinner than the accuracy of the drawing: they hide like any other.

A tolerance that forgives contacts must stay below half of the wall, or the wall's own back and all behind it show
through.
"""

from __future__ import annotations

import cadquery as cq
import pytest
from hard.brep import box_edges, compound, faultless, kinds, like

import hlr
from support.at_size import AT_SIZE
from support.expected import Ink, expect, ink

THIN = 0.01
SHEET = ((-20, 0, -15), (20, THIN, 15))
BEHIND = ((-8, 1, -6), (9, 5, 7))
VIEWS = ["front", (0.2, -1, 0.1), (-0.3, -1, 0.4)]


def box(low, high):
    return cq.Solid.makeBox(*(b - a for a, b in zip(low, high, strict=True)), cq.Vector(*low))


@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("accuracy", [None, 0.2])
def test_all_behind_a_sheet_is_hidden(view, accuracy, picture):
    drawing = hlr.draw(compound(box(*SHEET), box(*BEHIND)), view, accuracy=accuracy, **AT_SIZE)
    direction = drawing.view.direction
    seen, unseen = box_edges(*SHEET, direction)
    like(drawing, expect(drawing, seen, [*unseen, *(e for edges in box_edges(*BEHIND, direction) for e in edges)]))
    assert not any(line.visible for line in drawing.lines if line.points3[:, 1].max() > 2 * THIN)
    if view != "front" and not accuracy:
        picture(drawing, "oblique" if view[0] > 0 else "")


@pytest.mark.parametrize("gap", [0.001, 0.01, 0.1])
def test_something_close_behind_is_hidden(gap):
    close = ((-8, THIN + gap, -6), (9, 5, 7))
    drawing = hlr.draw(compound(box(*SHEET), box(*close)), (0.2, -1, 0.1), **AT_SIZE)
    assert not any(line.visible for line in drawing.lines if line.points3[:, 1].max() > THIN + gap / 2)
    assert any(not line.visible and line.points3[:, 1].max() > 1 for line in drawing.lines)


@pytest.mark.slow
def test_a_tube_of_foil_hides_what_is_in_it():
    tube = cq.Workplane().circle(10).circle(10 - THIN).extrude(30).val()
    inside = box((-3, -3, 5), (3, 3, 20))
    drawing = hlr.draw(compound(tube, inside), "front", **AT_SIZE)
    alone = hlr.draw(cq.Solid.makeCylinder(10, 30), "front", **AT_SIZE)
    like(drawing, Ink(ink(alone).visible, ink(drawing).hidden))
    assert ("sharp", False) in kinds(drawing)
    for judged in faultless(compound(tube, inside), compound(tube, inside), ["front", (0.3, -1, 0.2)]):
        assert judged.lines
