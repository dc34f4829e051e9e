"""Whether OpenCASCADE has cut a shape at planes as it should: it may leave all of it, lose it, or leave it open."""

from __future__ import annotations

from typing import Any

import numpy as np

from hlr.common.types import Floats
from hlr.source.cad.occt_collections import new_collection
from hlr.source.cad.shapes import sub_shapes
from hlr.source.stepped import Stepped

NEAR = 1e-6
"""Of the size of a shape: what lies so close to the plane may lie on either side of it."""

OFF = 10.0
"""Tolerances of the shape: how far vertices that a cut has made may lie off the plane."""

MOST_OFF = 0.01
"""Of the size of a shape: what is left farther before the plane was not cut, whatever its tolerance."""


class CutCheck:
    """What a cut must do to a shape. planes: before which nothing stays; size: of the shape."""

    def __init__(self, shape: Any, planes: Stepped, size: float) -> None:
        self._shape, self._planes = shape, planes
        self._near = NEAR * size + min(OFF * _tolerance(shape), MOST_OFF * size)
        self._closed = is_closed(shape)
        heights = self._heights(shape)
        self._low, self._high = (float(heights.min()), float(heights.max())) if len(heights) else (0.0, 0.0)

    def is_cut(self, left: Any | None, unchanged: bool) -> bool:
        """Whether what is left, None for nothing, lies behind the plane and is all that lay there.

        unchanged: no face of the shape was cut or taken away
        """
        behind, before = self._low < -self._near, self._high > self._near
        if left is None:
            return not behind
        if unchanged:
            return not before
        heights = self._heights(left)
        if not len(heights):
            return True
        return bool(heights.max() <= self._near and (not behind or heights.min() <= self._low + self._near))

    def is_sound(self, left: Any | None) -> bool:
        """Whether what is left is closed where the shape was."""
        return left is None or not self._closed or is_closed(left)

    def is_piece(self, left: Any | None) -> bool:
        """Whether what is left is a body, as the shape was, and a smaller one."""
        return left is not None and self._closed and is_closed(left) and 0.0 < volume(left) < volume(self._shape)

    def _heights(self, shape: Any) -> Floats:
        return self._planes.heights(_points(shape), self._near)


def has_surfaces(shape: Any) -> bool:
    """Whether each face has one; those of tessellated STEP are triangles alone, at which OpenCASCADE's cut crashes."""
    from OCP.BRep import BRep_Tool
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopoDS import TopoDS

    faces = sub_shapes(shape, Kind.TopAbs_FACE)
    return all(BRep_Tool.Surface_s(TopoDS.Face(face)) is not None for face in faces)


def is_closed(shape: Any) -> bool:
    """Whether each edge of a shape lies between two faces, or twice on one."""
    from OCP.BRep import BRep_Tool
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopExp import TopExp
    from OCP.TopoDS import TopoDS

    faces = new_collection("ancestor_map")
    TopExp.MapShapesAndAncestors_s(shape, Kind.TopAbs_EDGE, Kind.TopAbs_FACE, faces)
    alone = [faces.FindKey(i) for i in range(1, faces.Extent() + 1) if faces.FindFromIndex(i).Size() < 2]
    return faces.Extent() > 0 and all(BRep_Tool.Degenerated_s(TopoDS.Edge(edge)) for edge in alone)


def volume(shape: Any) -> float:
    """That its faces enclose; negative where they look inward."""
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    found = GProp_GProps()
    BRepGProp.VolumeProperties_s(shape, found)
    return float(found.Mass())


def _points(shape: Any) -> Floats:
    """(n, 3) its vertices and the middles of its edges; a ball has but two vertices."""
    from OCP.BRep import BRep_Tool
    from OCP.BRepAdaptor import BRepAdaptor_Curve
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopoDS import TopoDS

    found = [BRep_Tool.Pnt_s(TopoDS.Vertex(vertex)) for vertex in sub_shapes(shape, Kind.TopAbs_VERTEX)]
    for each in sub_shapes(shape, Kind.TopAbs_EDGE):
        edge = TopoDS.Edge(each)
        if not BRep_Tool.Degenerated_s(edge):
            curve = BRepAdaptor_Curve(edge)
            found.append(curve.Value(0.5 * (curve.FirstParameter() + curve.LastParameter())))
    return np.array([(point.X(), point.Y(), point.Z()) for point in found]).reshape(-1, 3)


def _tolerance(shape: Any) -> float:
    """The largest of its vertices, edges and faces."""
    from OCP.ShapeAnalysis import ShapeAnalysis_ShapeTolerance

    return float(ShapeAnalysis_ShapeTolerance().Tolerance(shape, 1))
