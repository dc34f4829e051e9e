"""Faces on surfaces that a program fitted to points or to a border."""

from __future__ import annotations

import math

import cadquery as cq
import numpy as np

from hlr.source.cad.occt_collections import new_collection


def filled():
    """A face between two arcs and a line, filled by OpenCASCADE; it is meshed in several rounds."""
    a, b, c = (cq.Vector(*p) for p in ((0, 0, 0), (20, 0, 0), (20, 20, 0)))
    arcs = [((a, b), (10, 0, 6)), ((b, c), (24, 10, -5))]
    border = [cq.Edge.makeThreePointArc(start, cq.Vector(*by), end) for (start, end), by in arcs]
    return cq.Face.makeNSidedSurface([*border, cq.Edge.makeLine(c, a)], [])


def ripple(count=24, wide=20.0, high=8.0, long=2.5):
    """sin(r) / r fitted to a net of points; beside its border it runs out into spikes."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.GeomAPI import GeomAPI_PointsToBSplineSurface
    from OCP.gp import gp_Pnt

    net = new_collection("point_net", 1, count, 1, count)
    places = np.linspace(-wide, wide, count)
    for i, x in enumerate(places, 1):
        for j, y in enumerate(places, 1):
            net.SetValue(i, j, gp_Pnt(x, y, high * np.sinc(math.hypot(x, y) / long / math.pi)))
    return cq.Face(BRepBuilderAPI_MakeFace(GeomAPI_PointsToBSplineSurface(net).Surface(), 1e-6).Face())
