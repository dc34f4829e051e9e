"""A face of no area between two arcs that are copies of one another, as boolean operations leave them: it is not seen,
and the faces beside it meet as if it were not there."""

from __future__ import annotations

from itertools import pairwise

import cadquery as cq
import pytest
from OCP.BRep import BRep_Builder
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakeVertex
from OCP.BRepLib import BRepLib
from OCP.Geom import Geom_CylindricalSurface, Geom_Plane, Geom_RectangularTrimmedSurface
from OCP.GeomConvert import GeomConvert
from OCP.gp import gp_Ax2, gp_Ax3, gp_Circ, gp_Dir, gp_Pnt
from OCP.ShapeFix import ShapeFix_Edge, ShapeFix_Shell
from OCP.TopoDS import TopoDS, TopoDS_Shell, TopoDS_Solid, TopoDS_Wire

import hlr
from support.measures import length

HEIGHTS = (0.0, 5.0, 10.0)


def half_cylinder(backs: tuple[bool, ...]) -> cq.Solid:
    """Radius 4, on z = 0, 10 high, in two pieces that meet at z = 5 along one arc, or along an arc and copies of it.

    backs: whether each of these arcs runs the other way
    """
    up = gp_Dir(0, 0, 1)
    right, left = ([BRepBuilderAPI_MakeVertex(gp_Pnt(x, 0, z)).Vertex() for z in HEIGHTS] for x in (4, -4))

    def arc(k, back=False):
        """From the right to the left."""
        circle = gp_Circ(gp_Ax2(gp_Pnt(0, 0, HEIGHTS[k]), up.Reversed() if back else up), 4)
        ends = (left[k], right[k]) if back else (right[k], left[k])
        edge = BRepBuilderAPI_MakeEdge(circle, *ends).Edge()
        return edge.Reversed() if back else edge

    def line(a, b):
        return BRepBuilderAPI_MakeEdge(a, b).Edge()

    arcs = [arc(0), *(arc(1, back) for back in backs), arc(2)]
    low, high = arcs[1], arcs[-2]
    across = [line(right[k], left[k]) for k in (0, 2)]
    sides = [[line(side[k], side[k + 1]) for k in (0, 1)] for side in (right, left)]
    level = [Geom_Plane(gp_Ax3(gp_Pnt(0, 0, z), up)) for z in HEIGHTS]
    # The upper piece is a spline surface, so that normals are compared all along the arc.
    tube = Geom_CylindricalSurface(gp_Ax3(gp_Pnt(), up, gp_Dir(0, -1, 0)), 4)
    spline = GeomConvert.SurfaceToBSplineSurface_s(Geom_RectangularTrimmedSurface(tube, 1.0, 5.5, 4.0, 11.0))
    back = Geom_Plane(gp_Ax3(gp_Pnt(), gp_Dir(0, 1, 0)))
    borders = [
        (level[0], [arcs[0], across[0].Reversed()]),
        (level[2], [arcs[-1], across[1].Reversed()]),
        (tube, [arcs[0], sides[1][0], low.Reversed(), sides[0][0].Reversed()]),
        (spline, [high, sides[1][1], arcs[-1].Reversed(), sides[0][1].Reversed()]),
        (back, [across[0], *sides[1], across[1].Reversed(), sides[0][1].Reversed(), sides[0][0].Reversed()]),
        *((level[1], [one, two.Reversed()]) for one, two in pairwise(arcs[1:-1])),
    ]
    builder, shell, solid = BRep_Builder(), TopoDS_Shell(), TopoDS_Solid()
    builder.MakeShell(shell)
    for surface, edges in borders:
        wire = TopoDS_Wire()
        builder.MakeWire(wire)
        for edge in edges:
            builder.Add(wire, edge)
        face = BRepBuilderAPI_MakeFace(surface, wire, False).Face()
        for edge in edges:
            ShapeFix_Edge().FixAddPCurve(TopoDS.Edge(edge), face, False)
        builder.Add(shell, face)
    fixed = ShapeFix_Shell()
    fixed.FixFaceOrientation(shell)
    builder.MakeSolid(solid)
    builder.Add(solid, fixed.Shell())
    BRepLib.OrientClosedSolid_s(solid)
    return cq.Solid(solid)


def drawn(backs, view):
    drawing = hlr.draw(half_cylinder(backs), view, hidden=True, scale=1.0)
    return drawing, sorted((line.kind, line.visible, round(length(line), 3)) for line in drawing.lines)


@pytest.mark.parametrize("backs", [(False, False), (False, True), (True, False), (False, True, False)])
@pytest.mark.parametrize("view", ["front", "iso", "back", (3, -1, 2)])
def test_it_is_drawn_as_without_the_face(view, backs):
    drawing, lines = drawn(backs, view)
    assert drawing.notes == ()
    assert drawing.counters["rescued_faces"] == drawing.counters["lost_faces"] == 0
    assert lines == drawn((False,), view)[1]


@pytest.mark.parametrize("backs", [(False,), (False, False), (False, True), (False, True, False)])
def test_the_arc_between_two_pieces_of_one_surface_is_no_sharp_edge(backs):
    drawing, _ = drawn(backs, "back")
    assert sum(line.visible for line in drawing.lines) > 0
    assert [line for line in drawing.lines if (abs(line.points3[:, 2] - 5.0) < 1e-6).all()] == []
