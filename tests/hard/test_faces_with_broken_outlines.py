"""A cylinder whose curves in (u, v) lie a whole period beside one another: sound in space, no outline in (u, v).

(A sensor of SparkFun's KiCad libraries, which are CC-BY-4.0, has sixteen solder balls like that.) OpenCASCADE's mesher
leaves such a face empty, or pulls the ends of its polygons together right round the cylinder.
"""

from __future__ import annotations

import math

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.source import open_source


def cylinder(*moved):
    """Of diameter 6, height 10; of its side, the named curves in (u, v) are moved by a period."""
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


def curves(solid):
    """The curves in (u, v) of the edges of a solid's faces: where they begin and end."""
    from OCP.BRepAdaptor import BRepAdaptor_Curve2d

    ends = []
    for face in solid.Faces():
        for edge in face.Edges():
            curve = BRepAdaptor_Curve2d(edge.wrapped, face.wrapped)
            for t in (curve.FirstParameter(), curve.LastParameter()):
                ends += [curve.Value(t).X(), curve.Value(t).Y()]
    return ends


BROKEN = [("top",), ("bottom",), ("seam", "top"), ("seam", "bottom")]


@pytest.mark.parametrize("moved", BROKEN)
def test_it_is_drawn_like_a_sound_one(moved):
    sound, drawing = hlr.draw(cylinder(), "iso"), hlr.draw(cylinder(*moved), "iso")
    assert drawing.notes == ()
    assert sorted((line.kind, line.visible) for line in drawing.lines) == sorted(
        (line.kind, line.visible) for line in sound.lines
    )


@pytest.mark.parametrize("moved", BROKEN)
def test_it_becomes_a_closed_mesh_and_stays_what_it_was(moved):
    solid = cylinder(*moved)
    before = curves(solid)
    (part,) = open_source(solid).mesh(0.01, 0.2).parts
    a, b, c = (part.points[part.triangles[:, k]] for k in range(3))
    assert (a * np.cross(b, c)).sum() / 6 == pytest.approx(math.pi * 90, rel=0.01)
    assert np.bincount(part.edge_class).tolist() == [2, 0, 1]
    assert curves(solid) == before
