"""Faces outside solids joined along their borders, as surface models in STEP and IGES files have them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from hlr.common.types import Floats
from hlr.source.cad.parts import Leaf
from hlr.source.cad.shapes import make_compound, sub_shapes, with_location

TOLERANCE_SHARE = 5e-6
"""Share of a leaf's diagonal: borders of two faces that are no further apart than this are sewn into one edge."""

SMALLEST_TOLERANCE = 1e-7
"""Model units."""

_ACROSS = np.array([0.4243, 0.5657, 0.7071])
"""A direction along which few corners of models are at the same place."""


def sewn(leaf: Leaf) -> Leaf:
    """The leaf with neighbouring faces joined, so that an edge has a face on either side.

    Solids stay as they are, and so do faces that are joined already, or of which sewing would lose one.
    """
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    shape = with_location(leaf.shape, None)
    if shape.ShapeType() == Kind.TopAbs_SOLID:
        return leaf
    solids = sub_shapes(shape, Kind.TopAbs_SOLID)
    faces = sub_shapes(shape, Kind.TopAbs_FACE, Kind.TopAbs_SOLID)
    if not faces:
        return leaf
    loose = make_compound(faces) if solids else shape
    tolerance = max(SMALLEST_TOLERANCE, TOLERANCE_SHARE * _diagonal(loose))
    if not any(_is_any_twice(points, tolerance) for points in (_corners(loose), _middles(loose))):
        return leaf
    from OCP.BRepBuilderAPI import BRepBuilderAPI_Sewing

    sewing = BRepBuilderAPI_Sewing(tolerance)
    sewing.Add(loose)
    sewing.Perform()
    joined = sewing.SewedShape()
    if joined is None or joined.IsNull() or len(sub_shapes(joined, Kind.TopAbs_FACE)) != len(faces):
        return leaf

    def made_of(face: Any) -> Any:
        return sewing.ModifiedSubShape(face) if sewing.IsModifiedSubShape(face) else face

    wires = sub_shapes(shape, Kind.TopAbs_EDGE, Kind.TopAbs_FACE)
    others = [*solids, *wires]
    return with_shape(leaf, make_compound([*others, joined]) if others else joined, faces, made_of)


def with_shape(leaf: Leaf, shape: Any, faces: Sequence[Any], made_of: Callable[[Any], Any]) -> Leaf:
    """The leaf with another shape. Each face that was made of one of its `faces` has the colour of that."""
    colors, opacities = dict(leaf.colors), dict(leaf.opacities)
    for face in faces:
        key = face.TShape()
        if key in leaf.colors:
            made = made_of(face).TShape()
            colors[made] = leaf.colors[key]
            if key in leaf.opacities:
                opacities[made] = leaf.opacities[key]
    placed = shape.Moved(leaf.shape.Location(), False)
    return Leaf(placed, leaf.name, leaf.color, colors, leaf.opacity, opacities, leaf.above)


def _diagonal(shape: Any) -> float:
    """Of the box around a shape, model units."""
    from OCP.Bnd import Bnd_Box
    from OCP.BRepBndLib import BRepBndLib

    box = Bnd_Box()
    BRepBndLib.Add_s(shape, box)
    return float(box.SquareExtent() ** 0.5)


def _corners(shape: Any) -> Floats:
    """(n, 3) of a shape, each once however many faces share it, model units."""
    from OCP.BRep import BRep_Tool
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopoDS import TopoDS

    points = [BRep_Tool.Pnt_s(TopoDS.Vertex(vertex)) for vertex in sub_shapes(shape, Kind.TopAbs_VERTEX)]
    return np.array([(p.X(), p.Y(), p.Z()) for p in points]).reshape(-1, 3)


def _middles(shape: Any) -> Floats:
    """(n, 3) of the edges of a shape, each once however many faces share it, model units."""
    from OCP.BRep import BRep_Tool
    from OCP.BRepAdaptor import BRepAdaptor_Curve
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopoDS import TopoDS

    found = []
    for edge in map(TopoDS.Edge, sub_shapes(shape, Kind.TopAbs_EDGE)):
        if BRep_Tool.IsGeometric_s(edge) and not BRep_Tool.Degenerated_s(edge):
            curve = BRepAdaptor_Curve(edge)
            point = curve.Value(0.5 * (curve.FirstParameter() + curve.LastParameter()))
            found.append((point.X(), point.Y(), point.Z()))
    return np.array(found).reshape(-1, 3)


def _is_any_twice(points: Floats, near: float) -> bool:
    """Whether two points lie in one place: corners or edges of faces that are not joined there."""
    points = points[np.argsort(points @ _ACROSS)]
    along = points @ _ACROSS
    for step in range(1, len(points)):
        close = np.flatnonzero(along[step:] - along[:-step] <= near)
        if not len(close):
            return False
        if (np.linalg.norm(points[close + step] - points[close], axis=1) <= near).any():
            return True
    return False
