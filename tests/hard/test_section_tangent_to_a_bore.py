"""Sections whose plane is tangent to the wall of a bore, or to that of the hole of a ring.

What is left touches itself there: two of its corners meet tip to tip in an edge of four faces. The model has no such
edge and is sound, so nothing is to be said of it.
"""

from __future__ import annotations

import cadquery as cq
import pytest

import hlr
from support.at_size import AT_SIZE
from support.sections import hatched_area


def plate() -> cq.Workplane:
    return cq.Workplane().box(40, 40, 20).cut(cq.Workplane().circle(5).extrude(30, both=True))


@pytest.mark.parametrize("steps", [-5.0, (-5.0, (12.0, -8.0))])
def test_a_bore_that_the_plane_touches_is_no_defect(steps):
    drawing = hlr.draw(plate(), "front", section=steps, **AT_SIZE)
    assert not drawing.notes
    assert hatched_area(drawing, 3.0) == pytest.approx(40 * 20, rel=0.03)


@pytest.mark.parametrize("scale", [1.0, 4.0, 8.0])
def test_a_ring_cut_at_its_saddle_is_none(scale):
    """Where the two loops of the cut nearly meet, the cut face and the ring may have a triangle in common."""
    drawing = hlr.draw(cq.Solid.makeTorus(30, 5), "front", section=-25.0, **{**AT_SIZE, "scale": scale})
    assert not [note for note in drawing.notes if note.code == "defects"]


def test_two_bodies_that_touch_beside_the_plane_are():
    """Two boxes of one part with an edge in common, along the view: the plane has not made it."""
    boxes = cq.Compound.makeCompound(
        [cq.Workplane().box(10, 30, 10).translate((side, 0, side)).val() for side in (5.0, -5.0)]
    )
    mesh = boxes.tessellate(0.1)
    drawing = hlr.draw(([p.toTuple() for p in mesh[0]], mesh[1]), "front", section=0.0, **AT_SIZE)
    assert [note.code for note in drawing.notes] == ["defects"]


def test_picture(picture):
    picture(hlr.draw(plate(), "front", section=-5.0, **AT_SIZE))
