"""A face of no area between two arcs that are copies of one another, as boolean operations leave them: it is not seen,
and the faces beside it meet as if it were not there."""

from __future__ import annotations

import math

import cadquery as cq
import numpy as np
import pytest
from OCP.BRep import BRep_Builder
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakeVertex
from OCP.BRepLib import BRepLib
from OCP.Geom import Geom_CylindricalSurface, Geom_Plane
from OCP.gp import gp_Ax2, gp_Ax3, gp_Circ, gp_Dir, gp_Pnt
from OCP.ShapeFix import ShapeFix_Shell
from OCP.TopoDS import TopoDS_Shell, TopoDS_Solid, TopoDS_Wire

import hlr

HEIGHTS = (0.0, 5.0, 10.0)


def half_cylinder(copies: int) -> cq.Solid:
    """Radius 4, on z = 0, 10 high, in two pieces that meet at z = 5 along one arc, or in one arc and its copy."""
    up = gp_Dir(0, 0, 1)
    right, left = ([BRepBuilderAPI_MakeVertex(gp_Pnt(x, 0, z)).Vertex() for z in HEIGHTS] for x in (4, -4))

    def arc(k):
        circle = gp_Circ(gp_Ax2(gp_Pnt(0, 0, HEIGHTS[k]), up), 4)
        return BRepBuilderAPI_MakeEdge(circle, right[k], left[k]).Edge()

    def line(a, b):
        return BRepBuilderAPI_MakeEdge(a, b).Edge()

    arcs = [arc(0), *(arc(1) for _ in range(copies)), arc(2)]
    low, high = arcs[1], arcs[copies]
    across = [line(right[k], left[k]) for k in (0, 2)]
    sides = [[line(side[k], side[k + 1]) for k in (0, 1)] for side in (right, left)]
    level = [Geom_Plane(gp_Ax3(gp_Pnt(0, 0, z), up)) for z in HEIGHTS]
    round_, back = (
        Geom_CylindricalSurface(gp_Ax3(gp_Pnt(), up, gp_Dir(0, -1, 0)), 4),
        Geom_Plane(gp_Ax3(gp_Pnt(), gp_Dir(0, 1, 0))),
    )
    borders = [
        (level[0], [arcs[0], across[0].Reversed()]),
        (level[2], [arcs[-1], across[1].Reversed()]),
        (round_, [arcs[0], sides[1][0], low.Reversed(), sides[0][0].Reversed()]),
        (round_, [high, sides[1][1], arcs[-1].Reversed(), sides[0][1].Reversed()]),
        (back, [across[0], *sides[1], across[1].Reversed(), sides[0][1].Reversed(), sides[0][0].Reversed()]),
        *[(level[1], [low, high.Reversed()])] * (copies - 1),
    ]
    builder, shell, solid = BRep_Builder(), TopoDS_Shell(), TopoDS_Solid()
    builder.MakeShell(shell)
    for surface, edges in borders:
        wire = TopoDS_Wire()
        builder.MakeWire(wire)
        for edge in edges:
            builder.Add(wire, edge)
        builder.Add(shell, BRepBuilderAPI_MakeFace(surface, wire, False).Face())
    fixed = ShapeFix_Shell()
    fixed.FixFaceOrientation(shell)
    builder.MakeSolid(solid)
    builder.Add(solid, fixed.Shell())
    BRepLib.OrientClosedSolid_s(solid)
    return cq.Solid(solid)


def length(line):
    return float(np.hypot(*np.diff(line.points, axis=0).T).sum())


def drawn(copies, view):
    drawing = hlr.draw(half_cylinder(copies), view, hidden=True, scale=1.0)
    return drawing, sorted((line.kind, line.visible, round(length(line), 6)) for line in drawing.lines)


@pytest.mark.parametrize("view", ["front", "iso", "back", (3, -1, 2)])
def test_it_is_drawn_as_without_the_face(view):
    drawing, lines = drawn(2, view)
    assert drawing.notes == ()
    assert drawing.counters["rescued_faces"] == drawing.counters["lost_faces"] == 0
    assert lines == drawn(1, view)[1]


def test_the_arc_between_two_pieces_of_one_cylinder_is_not_seen():
    drawing, _ = drawn(2, "top")
    assert [length(line) for line in drawing.lines if line.visible] == pytest.approx([8.0, 4.0 * math.pi], abs=2e-3)
