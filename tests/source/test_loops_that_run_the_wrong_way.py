"""Outlines and holes of faces that run the wrong way round: the file's fault, named, and drawn as they are meant."""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE


def face(sound, turned=(), with_curves=True):
    """The face once more; wires whose numbers are in `turned` run the wrong way (0: the outline).

    with_curves: its edges keep their curves in (u, v), which are known by the surface and its location.
    """
    from OCP.BRep import BRep_Builder, BRep_Tool
    from OCP.TopAbs import TopAbs_Orientation
    from OCP.TopLoc import TopLoc_Location
    from OCP.TopoDS import TopoDS_Face

    sound = cq.Face(sound.wrapped.Oriented(TopAbs_Orientation.TopAbs_FORWARD))
    made, builder, place = TopoDS_Face(), BRep_Builder(), TopLoc_Location()
    surface = BRep_Tool.Surface_s(sound.wrapped, place)
    if with_curves:
        builder.MakeFace(made, surface, place, 1e-7)
    else:
        builder.MakeFace(made, surface.Copy(), place, 1e-7)
    for number, wire in enumerate([sound.outerWire(), *sound.innerWires()]):
        builder.Add(made, wire.wrapped.Reversed() if number in turned else wire.wrapped)
    return cq.Face(made)


def plate():
    return cq.Workplane().rect(30, 20).pushPoints([(-8, 0), (8, 0)]).circle(4).extrude(2).faces(">Z").val()


def sleeve():
    """A cylinder's side, its seam in the outline, with a hole cut into it."""
    tube = cq.Workplane().circle(10).extrude(30).cut(cq.Workplane("XZ").center(0, 15).circle(4).extrude(20))
    return max(tube.faces("%CYLINDER").vals(), key=lambda side: side.Area())


def ball():
    """Its poles, its seam, and a hole beside these."""
    return cq.Workplane().sphere(10).cut(cq.Workplane("XZ").circle(4).extrude(20)).faces("%SPHERE").val()


SHAPES = {"plate": plate, "sleeve": sleeve, "ball": ball}


@pytest.mark.slow
@pytest.mark.parametrize("turned", [{0}, {1}, {0, 1}], ids=["outline", "hole", "both"])
@pytest.mark.parametrize("name", SHAPES)
def test_it_is_drawn_as_it_is_meant(name, turned):
    sound = SHAPES[name]()
    right, wrong = hlr.draw(face(sound), "iso", **AT_SIZE), hlr.draw(face(sound, turned), "iso", **AT_SIZE)
    assert not [note for note in right.notes if note.code == "loops-turned"]
    (note,) = [note for note in wrong.notes if note.code == "loops-turned"]
    assert "1 of 1 faces has" in note.text and "wrong way round (face 0)" in note.text
    assert ink(wrong) == ink(right)


def test_poles_without_curves_in_the_parameter_plane_are_no_crash():
    notes = hlr.draw([face(ball(), with_curves=False), cq.Workplane().box(1, 1, 1)], "iso", **AT_SIZE).notes
    assert "not-meshed" in {note.code for note in notes}


def ink(drawing):
    """Each line as what it is and how long it is; ends of closed ones may lie elsewhere."""
    length = [float(np.hypot(*np.diff(line.points, axis=0).T).sum()) for line in drawing.lines]
    return sorted((line.kind, line.visible, round(size, 2)) for line, size in zip(drawing.lines, length, strict=True))
