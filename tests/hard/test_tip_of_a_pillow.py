"""A low pillow on a plane: two faces that meet in two arcs, and in sharp tips where these end.

The triangles at a tip have their corners on the arcs, and are the same in both faces. They enclose nothing, but hide
what is below them.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE

WIDTH, TIP, EDGE = 4.0, 10.0, 9.6


def pillow() -> Any:
    from OCP.BRepBuilderAPI import (
        BRepBuilderAPI_MakeEdge,
        BRepBuilderAPI_MakeFace,
        BRepBuilderAPI_MakeSolid,
        BRepBuilderAPI_MakeWire,
        BRepBuilderAPI_Sewing,
    )
    from OCP.BRepFill import BRepFill_Filling
    from OCP.GC import GC_MakeArcOfCircle
    from OCP.GeomAbs import GeomAbs_C0
    from OCP.gp import gp_Pnt
    from OCP.TopAbs import TopAbs_SHELL
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    left, right = gp_Pnt(-TIP, 0, 0), gp_Pnt(TIP, 0, 0)
    middles = gp_Pnt(0, WIDTH, 0), gp_Pnt(0, -WIDTH, 0)
    arcs = [BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(left, each, right).Value()).Edge() for each in middles]
    bulge = BRepFill_Filling()
    for arc in arcs:
        bulge.Add(arc, GeomAbs_C0)
    bulge.Add(gp_Pnt(0, 0, 0.3))
    bulge.Build()
    sewing = BRepBuilderAPI_Sewing(1e-3)
    sewing.Add(BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakeWire(*arcs).Wire(), True).Face())
    sewing.Add(bulge.Face())
    sewing.Perform()
    shell = TopoDS.Shell_s(TopExp_Explorer(sewing.SewedShape(), TopAbs_SHELL).Current())
    return BRepBuilderAPI_MakeSolid(shell).Solid()


def bar() -> Any:
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox
    from OCP.gp import gp_Pnt

    return BRepPrimAPI_MakeBox(gp_Pnt(-EDGE, -8, -5), gp_Pnt(30, 8, -2)).Shape()


def test_an_edge_below_the_tip_is_hidden():
    drawing = hlr.draw({"pillow": pillow(), "bar": bar()}, "top", accuracy=0.2, **AT_SIZE)
    hidden = 0.0
    for line in drawing.lines:
        points = np.asarray(line.points3)
        if not line.visible and np.abs(points[:, 0] + EDGE).max() < 1e-6:
            hidden += np.ptp(points[:, 1])
    radius = (TIP**2 + WIDTH**2) / (2 * WIDTH)
    half = np.sqrt(radius**2 - EDGE**2) - (radius - WIDTH)
    assert hidden == pytest.approx(2 * half, abs=0.2)
