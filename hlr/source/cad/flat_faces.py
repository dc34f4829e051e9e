"""Flat faces of shapes, and how far along a direction they lie; also those that converters write as free-form faces."""

from __future__ import annotations

from typing import Any

import numpy as np

from hlr.common.types import Floats
from hlr.source.cad.shapes import sub_shapes

PARALLEL = 1e-9
"""Sine of the angle of two planes that count as parallel."""


def flat_heights(shape: Any, normal: Floats) -> Floats:
    """(n,) how far along a direction the flat faces lie that are at right angles to it."""
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopoDS import TopoDS

    surfaces = (BRepAdaptor_Surface(TopoDS.Face(face)) for face in sub_shapes(shape, Kind.TopAbs_FACE))
    found = [_height(surface, normal) for surface in surfaces]
    return np.array([height for height in found if height is not None])


def _height(surface: Any, normal: Floats) -> float | None:
    """How far along a direction a surface lies; None: it is not flat, or not at right angles to it."""
    from OCP.GeomAbs import GeomAbs_SurfaceType as Kind

    kind = surface.GetType()
    if kind == Kind.GeomAbs_Plane:
        axis = surface.Plane().Axis()
        way, at = axis.Direction(), axis.Location()
        if float(np.linalg.norm(np.cross([way.X(), way.Y(), way.Z()], normal))) > PARALLEL:
            return None
        return float(np.array([at.X(), at.Y(), at.Z()]) @ normal)
    if kind == Kind.GeomAbs_BSplineSurface:
        return _height_of_poles(surface.BSpline(), normal)
    if kind == Kind.GeomAbs_BezierSurface:
        return _height_of_poles(surface.Bezier(), normal)
    return None


def _height_of_poles(surface: Any, normal: Floats) -> float | None:
    """That of a free-form surface: it lies between the lowest and the highest of its poles."""
    rows, columns = surface.NbUPoles(), surface.NbVPoles()
    # Four of the corners tell most curved surfaces, which may have very many poles.
    corners = _poles(surface, [(1, 1), (rows, 1), (1, columns), (rows, columns)])
    if not _is_level(corners, normal):
        return None
    poles = _poles(surface, [(i, j) for i in range(1, rows + 1) for j in range(1, columns + 1)])
    return float(np.mean(poles @ normal)) if _is_level(poles, normal) else None


def _poles(surface: Any, places: list[tuple[int, int]]) -> Floats:
    points = [surface.Pole(i, j) for i, j in places]
    return np.array([(point.X(), point.Y(), point.Z()) for point in points])


def _is_level(points: Floats, normal: Floats) -> bool:
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    return float(np.ptp(points @ normal)) <= PARALLEL * size
