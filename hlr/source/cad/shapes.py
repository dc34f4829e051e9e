"""Sub-shapes, compounds and placements of OpenCASCADE shapes."""

from __future__ import annotations

from typing import Any

from hlr.source.cad.occt_collections import new_collection
from hlr.source.transforms import IDENTITY, MatrixRows


def sub_shapes(shape: Any, kind: Any, avoid: Any = None) -> list[Any]:
    """Sub-shapes of a kind in TopExp order, each once. avoid: sub-shapes inside this kind are left out."""
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer

    found = new_collection("shape_map")
    explorer = TopExp_Explorer(shape, kind, TopAbs_ShapeEnum.TopAbs_SHAPE if avoid is None else avoid)
    while explorer.More():
        found.Add(explorer.Current())
        explorer.Next()
    return [found.FindKey(i) for i in range(1, found.Extent() + 1)]


def make_compound(shapes: list[Any]) -> Any:
    """A TopoDS_Compound of the shapes, in order."""
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Compound

    result = TopoDS_Compound()
    builder = BRep_Builder()
    builder.MakeCompound(result)
    for shape in shapes:
        builder.Add(result, shape)
    return result


def with_location(shape: Any, location: Any) -> Any:
    """The shape with this TopLoc_Location instead of its own; None: the identity."""
    from OCP.TopLoc import TopLoc_Location

    return shape.Located(TopLoc_Location() if location is None else location, False)


def location_matrix(location: Any) -> MatrixRows:
    """The (3, 4) matrix of a TopLoc_Location, row by row."""
    if location.IsIdentity():
        return IDENTITY
    value = location.Transformation().Value
    return tuple([value(i, j) for i, j in _ROWS_AND_COLUMNS])


_ROWS_AND_COLUMNS = [(i, j) for i in (1, 2, 3) for j in (1, 2, 3, 4)]
"""Row and column of each number, counted from 1 as in OpenCASCADE."""
