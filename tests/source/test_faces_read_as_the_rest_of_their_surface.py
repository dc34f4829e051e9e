"""A loop around a sphere bounds a face on either side of it. A reader that takes the wrong side makes a face that lies
on its neighbour, and hides what lies inside: that is named, and a neighbour that is merely turned around is not.
"""

from __future__ import annotations

from math import pi

import pytest

import hlr

CODE = "faces-folded"
SIDES = {"as it should be": (0.5 * pi, pi), "the rest": (pi, 2.5 * pi)}
"""The extent of the second face around the axis. Both have the same edges; the first face has the quarter before it."""


def sphere_face(first: float, last: float):
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.gp import gp_Ax3, gp_Sphere

    return BRepBuilderAPI_MakeFace(gp_Sphere(gp_Ax3(), 10), first, last, -0.5 * pi, 0.5 * pi).Face()


def cylinder_face(first: float, last: float):
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.gp import gp_Ax3, gp_Cylinder

    return BRepBuilderAPI_MakeFace(gp_Cylinder(gp_Ax3(), 10), first, last, 0, 30).Face()


def sewn(*faces):
    """The faces with common edges, and turned so that neighbours agree which side is outside."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_Sewing

    sewing = BRepBuilderAPI_Sewing(1e-6)
    for face in faces:
        sewing.Add(face)
    sewing.Perform()
    return sewing.SewedShape()


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize("make", [sphere_face, cylinder_face])
def test_a_face_that_lies_on_its_neighbour_is_named(make, side):
    notes = hlr.draw(sewn(make(0, 0.5 * pi), make(*SIDES[side])), "iso").notes
    found = [note.text for note in notes if note.code == CODE]
    assert len(found) == (1 if side == "the rest" else 0), notes
    assert all("2 of 2 faces lie on one another" in text and "(faces 0 and 1)" in text for text in found)


def test_neighbours_that_disagree_about_the_outside_do_not_lie_on_one_another():
    from OCP.BRep import BRep_Builder
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS_Compound

    shell = sewn(cylinder_face(0, 0.5 * pi), cylinder_face(0.5 * pi, pi))
    explorer = TopExp_Explorer(shell, TopAbs_ShapeEnum.TopAbs_FACE)
    one = explorer.Current()
    explorer.Next()
    both, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(both)
    builder.Add(both, one)
    builder.Add(both, explorer.Current().Reversed())
    assert CODE not in {note.code for note in hlr.draw(both, "iso").notes}
