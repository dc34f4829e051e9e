"""A solid of which one face has a wire that runs back over itself: OpenCASCADE makes no triangles for it.

(Button and sensor of SparkFun's KiCad libraries, which are CC-BY-4.0: planar faces bounded by a line and its own copy,
surfaces of revolution whose wires do not close.) The rest is drawn, the note says how many faces are not there, and the
face's edges are drawn as its neighbours know them.
"""

from __future__ import annotations

import cadquery as cq
import pytest
from hard.brep import box_edges, like
from hard.expected import expect

import hlr
from hlr.drawing.notes import Note

NOTE = Note("not-meshed", 'Part "part": 1 of 7 faces could not be meshed (face 6).')


def sliver():
    """A face without area: from one corner of a box to the next and back again."""
    from OCP.BRep import BRep_Builder
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakeWire
    from OCP.gp import gp_Dir, gp_Pln, gp_Pnt

    there = BRepBuilderAPI_MakeEdge(gp_Pnt(15, -10, 5), gp_Pnt(15, 10, 5)).Edge()
    wire = BRepBuilderAPI_MakeWire(there).Wire()
    BRep_Builder().Add(wire, there.Reversed())
    wire.Closed(True)
    return BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(15, 0, 5), gp_Dir(0, 0, 1)), wire, True).Face()


def box():
    return cq.Workplane().box(30, 20, 10).val()


def with_sliver():
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Shell, TopoDS_Solid

    shell, solid, builder = TopoDS_Shell(), TopoDS_Solid(), BRep_Builder()
    builder.MakeShell(shell)
    for face in box().Faces():
        builder.Add(shell, face.wrapped)
    builder.Add(shell, sliver())
    builder.MakeSolid(solid)
    builder.Add(solid, shell)
    return cq.Shape.cast(solid)


@pytest.mark.parametrize("view", ["iso", "front", (0.3, -1, -0.4)])
def test_the_rest_is_drawn_as_if_it_were_not_there(view, picture):
    drawing = hlr.draw(with_sliver(), view)
    assert NOTE in drawing.notes
    like(drawing, expect(drawing, *box_edges((-15, -10, -5), (15, 10, 5), drawing.view.direction)))
    if view == "iso":
        picture(drawing)


def test_the_report_says_so():
    assert NOTE in hlr.info(with_sliver()).notes


def test_strict_refuses_it():
    with pytest.raises(hlr.StrictError, match="1 of 7 faces could not be meshed"):
        hlr.draw(with_sliver(), strict=True)


def test_nothing_but_such_a_face_is_refused():
    with pytest.raises(hlr.SourceError, match="none of its faces could be meshed"):
        hlr.draw(cq.Shape.cast(sliver()))
