"""Faces on which OpenCASCADE's Delabella algorithm crashes or never returns, to be known before it sees them.

It grows its first facet while points lie exactly on one circle, nearest to the middle of the face's (u, v) box first,
and where rounding contradicts itself there it follows pointers that were never set. A box that is square and an outline
that mirrors one arc in its diagonal make such points: up to one in fifty quarters of a disc, ring or polygon, depending
on how finely it is meshed (tests/source/test_delabella.py). Other symmetries have normals that are exactly zero in some
coordinate, and did no harm in a hundred thousand tries.
"""

from __future__ import annotations

from collections.abc import Set
from typing import Any

SQUARE = 1e-6
"""Sides of a box that differ by less than this share of their length are equal."""

RECTANGLE = 4
"""An outline of so many straight edges has no arc."""


def treacherous(face: Any) -> bool:
    """Whether the face, which is planar, may crash Delabella.

    A plate with holes, however square, stays with Delabella: it is for such faces that it is many times faster.
    """
    from OCP.BRepTools import BRepTools

    u_min, u_max, v_min, v_max = BRepTools.UVBounds_s(face)
    width, height = u_max - u_min, v_max - v_min
    if abs(width - height) > SQUARE * max(width, height):
        return False
    outline = BRepTools.OuterWire_s(face)
    return outline.IsNull() or not _rectangle_or_loop(outline)


def _rectangle_or_loop(outline: Any) -> bool:
    """Whether a wire is one closed edge, as that of a disc, or four straight ones at most."""
    from OCP.BRepAdaptor import BRepAdaptor_Curve
    from OCP.GeomAbs import GeomAbs_CurveType
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopoDS import TopoDS

    from hlr.source.parts import explored

    edges = explored(outline, Kind.TopAbs_EDGE)
    if len(edges) == 1:
        return True
    line = GeomAbs_CurveType.GeomAbs_Line
    return len(edges) <= RECTANGLE and all(BRepAdaptor_Curve(TopoDS.Edge(e)).GetType() == line for e in edges)


def without(root: Any, faces: Set[Any]) -> Any:
    """The root if it has none of the faces (underlying shapes), else a compound of the faces that are left."""
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    from hlr.source.parts import compound, explored

    everything = explored(root, Kind.TopAbs_FACE)
    left = [face for face in everything if face.TShape() not in faces]
    return root if len(left) == len(everything) else compound(left)
