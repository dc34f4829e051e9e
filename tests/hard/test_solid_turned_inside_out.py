"""A solid whose faces all look inward, and one with a single face that does: mistakes of export, valid to look at.

Culling by orientation would draw the far side. The drawing must not depend on it; `hlr info` names the defect.
"""

from __future__ import annotations

import cadquery as cq
import pytest
from hard.brep import faultless, same

import hlr
from support.at_size import AT_SIZE
from support.expected import defects

VIEWS = ["iso", "front", (0.3, -1, -0.4)]


def model():
    return cq.Workplane().box(30, 20, 10).faces(">Z").workplane().hole(8).edges("|Z").fillet(3).val()


def inverted():
    return cq.Shape.cast(model().wrapped.Reversed())


def one_face_turned():
    """Its topmost face has its orientation reversed, so its edges are used twice in one direction."""
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Shell, TopoDS_Solid

    shell, solid, builder = TopoDS_Shell(), TopoDS_Solid(), BRep_Builder()
    builder.MakeShell(shell)
    whole = model()
    top = max(whole.Faces(), key=lambda face: face.Center().z)
    for face in whole.Faces():
        builder.Add(shell, face.wrapped.Reversed() if face.isSame(top) else face.wrapped)
    builder.MakeSolid(solid)
    builder.Add(solid, shell)
    return cq.Shape.cast(solid)


@pytest.mark.slow
@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("broken", [inverted, one_face_turned])
def test_it_is_drawn_like_the_sound_one(view, broken, picture):
    drawing = hlr.draw(broken(), view, **AT_SIZE)
    same(hlr.draw(model(), view, **AT_SIZE), drawing)
    if view == "iso" and broken is inverted:
        picture(drawing, twice=1.0)


@pytest.mark.slow
def test_by_rays():
    for drawing in faultless(inverted(), model(), VIEWS):
        assert drawing.lines


def test_the_defect_is_named():
    assert defects(model()) == []
    assert defects(inverted()) == ["the solid is turned inside out"]
    (defect,) = defects(one_face_turned())
    assert defect.endswith("edges between faces of opposite orientation")
