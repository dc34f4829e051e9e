"""Faulty B-rep shapes that modellers do not make but files contain, built piece by piece with OpenCASCADE."""

from __future__ import annotations

import math

import cadquery as cq
import numpy as np


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


def plate_with_sliver():
    """A box of 30 x 20 x 10 whose seventh face is the sliver."""
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Shell, TopoDS_Solid

    shell, solid, builder = TopoDS_Shell(), TopoDS_Solid(), BRep_Builder()
    builder.MakeShell(shell)
    for face in cq.Workplane().box(30, 20, 10).val().Faces():
        builder.Add(shell, face.wrapped)
    builder.Add(shell, sliver())
    builder.MakeSolid(solid)
    builder.Add(solid, shell)
    return cq.Shape.cast(solid)


def shifted_cylinder(*moved):
    """A cylinder of diameter 6 and height 10; the named (u, v) curves of its side face are shifted by a period."""
    from OCP.BRep import BRep_Builder, BRep_Tool
    from OCP.BRepAdaptor import BRepAdaptor_Curve2d
    from OCP.gp import gp_Vec2d
    from OCP.TopAbs import TopAbs_Orientation
    from OCP.TopoDS import TopoDS

    solid = cq.Workplane().cylinder(10, 3).val()
    (side,) = (face.wrapped for face in solid.Faces() if face.geomType() == "CYLINDER")
    face = TopoDS.Face_s(side.Oriented(TopAbs_Orientation.TopAbs_FORWARD))
    builder, period = BRep_Builder(), gp_Vec2d(2 * math.pi, 0)

    def curve(edge):
        return BRepAdaptor_Curve2d(edge, face).Curve().Copy()

    for item in cq.Shape.cast(side).Edges():
        edge = item.wrapped
        if BRep_Tool.IsClosed_s(edge, face):
            one = curve(TopoDS.Edge_s(edge.Oriented(TopAbs_Orientation.TopAbs_FORWARD)))
            two = curve(TopoDS.Edge_s(edge.Oriented(TopAbs_Orientation.TopAbs_REVERSED)))
            if "seam" in moved:
                one.Translate(period)
            builder.UpdateEdge(edge, one, two, face, 1e-7)
        elif ("top" if item.Center().z > 0 else "bottom") in moved:
            rim = curve(edge)
            rim.Translate(period)
            builder.UpdateEdge(edge, rim, face, 1e-7)
    return solid


def scrawled_cylinder():
    """A cylinder of diameter 6 and height 10 whose (u, v) curve of one rim is a scrawl; and its side face."""
    from OCP.BRep import BRep_Builder
    from OCP.Geom2d import Geom2d_BezierCurve
    from OCP.Geom2dConvert import Geom2dConvert
    from OCP.gp import gp_Pnt2d
    from OCP.TColgp import TColgp_Array1OfPnt2d
    from OCP.TColStd import TColStd_Array1OfReal

    solid = cq.Workplane().cylinder(10, 3).val()
    (side,) = (face.wrapped for face in solid.Faces() if face.geomType() == "CYLINDER")
    poles, knots = TColgp_Array1OfPnt2d(1, 4), TColStd_Array1OfReal(1, 2)
    for i, (u, v) in enumerate([(0, 0), (9, 30), (-7, -30), (2, 5)]):
        poles.SetValue(i + 1, gp_Pnt2d(u, v))
    for i, knot in enumerate((0.0, 2 * math.pi)):
        knots.SetValue(i + 1, knot)
    curve = Geom2dConvert.CurveToBSplineCurve_s(Geom2d_BezierCurve(poles))
    curve.SetKnots(knots)
    rim = next(edge.wrapped for edge in cq.Shape.cast(side).Edges() if edge.geomType() == "CIRCLE")
    BRep_Builder().UpdateEdge(rim, curve, side, 1e-7)
    return solid, side


def height(x, y):
    """The height of `terrain` at (x, y)."""
    return 6 * np.sin(x / 7) * np.cos(y / 9) + 0.05 * x


def terrain(count=14):
    """One B-spline face of hills through a grid of heights: even steps in x and y keep it as flat as the formula."""
    x, y = np.linspace(0, 80, count)[:, None], np.linspace(0, 60, count)
    return _through(height(x, y), 80, 60)


def rough_terrain(count=40):
    """One B-spline face through a grid of random heights from 0 to 1, 1 apart."""
    return _through(np.random.default_rng(1).random((count, count)), count - 1, count - 1)


def _through(z, width, depth):
    """One B-spline face through a grid of heights, which has its first corner at the origin."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.GeomAPI import GeomAPI_PointsToBSplineSurface
    from OCP.TColStd import TColStd_Array2OfReal

    heights = TColStd_Array2OfReal(1, z.shape[0], 1, z.shape[1])
    for (i, j), value in np.ndenumerate(z):
        heights.SetValue(i + 1, j + 1, float(value))
    maker = GeomAPI_PointsToBSplineSurface()
    maker.Interpolate(heights, 0.0, width / (z.shape[0] - 1), 0.0, depth / (z.shape[1] - 1))
    return cq.Face(BRepBuilderAPI_MakeFace(maker.Surface(), 1e-6).Face())


def bare_triangles(shape):
    """The faces of an OpenCASCADE shape as triangles without surfaces, as tessellated STEP has them."""
    from OCP.BRep import BRep_Builder, BRep_Tool
    from OCP.BRepMesh import BRepMesh_IncrementalMesh
    from OCP.TopLoc import TopLoc_Location
    from OCP.TopoDS import TopoDS_Face

    from hlr.source.cad.shapes import make_compound

    BRepMesh_IncrementalMesh(shape, 0.1)
    bare = []
    for face in cq.Shape.cast(shape).Faces():
        bare.append(TopoDS_Face())
        BRep_Builder().MakeFace(bare[-1], BRep_Tool.Triangulation_s(face.wrapped, TopLoc_Location()))
        bare[-1].Orientation(face.wrapped.Orientation())
    return make_compound(bare)
