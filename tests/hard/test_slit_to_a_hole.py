"""A ring whose hole hangs on its border by a slit: one wire runs around the border, in along the slit, around the hole
and back. It may begin with any of its four edges, and each of the two circles closes by itself.
"""

from __future__ import annotations

from itertools import permutations

import cadquery as cq
import pytest
from OCP.BRep import BRep_Builder
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakeVertex
from OCP.gp import gp_Ax2, gp_Circ, gp_Dir, gp_Pln, gp_Pnt
from OCP.TopoDS import TopoDS_Wire

import hlr


def ring(order: tuple[int, ...]) -> cq.Face:
    """Between the radii 5 and 10, in z = 0."""
    builder = BRep_Builder()
    out, mid = (BRepBuilderAPI_MakeVertex(gp_Pnt(r, 0, 0)).Vertex() for r in (10, 5))

    def circle(radius, vertex):
        return BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2(gp_Pnt(), gp_Dir(0, 0, 1)), radius), vertex, vertex).Edge()

    slit = BRepBuilderAPI_MakeEdge(out, mid).Edge()
    edges = [circle(10, out), slit, circle(5, mid).Reversed(), slit.Reversed()]
    wire = TopoDS_Wire()
    builder.MakeWire(wire)
    for i in order:
        builder.Add(wire, edges[i])
    face = BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(), gp_Dir(0, 0, 1)), wire, True).Face()
    return cq.Face(face)


@pytest.mark.parametrize("order", list(permutations(range(4))))
def test_a_ring_with_a_slit_hides_what_is_under_it_and_nothing_in_its_hole(order):
    under, hole = (cq.Workplane().box(1, 1, 1).translate((0, y, -3)).val() for y in (7.5, 0))
    drawing = hlr.draw(cq.Compound.makeCompound([ring(order), under, hole]), "top", hidden=True)
    assert not {note.code for note in drawing.notes} & {"not-meshed", "faces-mended"}
    boxes = [line for line in drawing.lines if abs(line.points3[0][2]) > 1]
    assert len(boxes) == 8
    assert all(line.visible == (abs(line.points3[0][1]) < 1) for line in boxes)
