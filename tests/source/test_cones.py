"""Cones, with and without an edge at the apex, keep their chord error."""

from __future__ import annotations

import math

import numpy as np
import pytest
from source.samples import samples

from hlr.source import open_source

cq = pytest.importorskip("cadquery")

ANGLE = math.pi / 6
HEIGHT = 20.0


def half_cone():
    """Half the side of a cone with apex at the origin, opening upwards; no edge marks its apex, as in many files."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakeWire
    from OCP.GC import GC_MakeArcOfCircle
    from OCP.Geom import Geom_ConicalSurface
    from OCP.gp import gp_Ax3, gp_Dir, gp_Pnt
    from OCP.ShapeFix import ShapeFix_Edge

    radius = HEIGHT * math.tan(ANGLE)
    apex, a, b = gp_Pnt(0, 0, 0), gp_Pnt(radius, 0, HEIGHT), gp_Pnt(-radius, 0, HEIGHT)
    arc = GC_MakeArcOfCircle(a, gp_Pnt(0, radius, HEIGHT), b).Value()
    wire = BRepBuilderAPI_MakeWire(
        BRepBuilderAPI_MakeEdge(apex, a).Edge(),
        BRepBuilderAPI_MakeEdge(arc).Edge(),
        BRepBuilderAPI_MakeEdge(b, apex).Edge(),
    ).Wire()
    surface = Geom_ConicalSurface(gp_Ax3(apex, gp_Dir(0, 0, 1)), ANGLE, 0.0)
    face = BRepBuilderAPI_MakeFace(surface, wire, True).Face()
    for edge in cq.Shape(face).Edges():
        ShapeFix_Edge().FixAddPCurve(edge.wrapped, face, False, 1e-6)
    return face


def off_cone(points):
    """Distance of points from the cone of `half_cone`."""
    radius = np.hypot(points[:, 0], points[:, 1])
    return np.abs(radius * math.cos(ANGLE) - points[:, 2] * math.sin(ANGLE))


@pytest.mark.parametrize("deflection", [0.2, 0.05, 0.01, 0.002])
def test_a_cone_without_a_marked_apex_keeps_its_chord_error(deflection):
    (part,) = open_source(half_cone()).mesh(deflection, 0.5).parts
    assert off_cone(samples(part.points, part.triangles)).max() <= deflection * (1 + 1e-9)


@pytest.mark.parametrize("radius", [0.0, 2.0])
def test_a_whole_cone_keeps_its_chord_error(radius):
    source = open_source(cq.Solid.makeCone(10, radius, 20))
    slope = math.hypot(20, 10 - radius)
    for deflection in (0.5, 0.02, 0.005):
        (part,) = source.mesh(deflection, 0.5).parts
        points = samples(part.points, part.triangles[~part.face_planar[part.triangle_face]])
        off = np.abs(np.hypot(points[:, 0], points[:, 1]) - 10 + (10 - radius) * points[:, 2] / 20) * 20 / slope
        assert off.max() <= deflection * (1 + 1e-9)
