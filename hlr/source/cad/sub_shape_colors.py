"""Colours that a document gives to pieces of a product: compounds, solids, shells and faces."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from hlr.common.types import Color, Rgba
from hlr.source.cad.shapes import sub_shapes

SubShapeColors = tuple[dict[Any, Color], dict[Any, float]]
"""Colours, and opacities below one, of solids and faces, by TShape."""


def of_solids_and_faces(colored: Iterable[tuple[Any, Rgba | None]]) -> SubShapeColors:
    """The colours of solids and faces, from those of any pieces of a product; None: a piece has none.

    Of the pieces that a face is in, the smallest one that has a colour decides: its shell, then its solid.
    """
    found: dict[Any, Rgba] = {}
    for shape, color in sorted(((s, c) for s, c in colored if c is not None), key=lambda piece: _extent(piece[0])):
        for piece in _solids_and_faces(shape):
            found.setdefault(piece.TShape(), color)
    return (
        {piece: color[:3] for piece, color in found.items()},
        {piece: color[3] for piece, color in found.items() if color[3] < 1.0},
    )


def _extent(shape: Any) -> tuple[int, int]:
    """It is smaller for a shape than for another one that contains it."""
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    kind = shape.ShapeType()
    if kind == Kind.TopAbs_SHELL:
        return 1, 0
    if kind == Kind.TopAbs_SOLID:
        return 2, 0
    if kind in (Kind.TopAbs_COMPSOLID, Kind.TopAbs_COMPOUND):
        return 3, len(sub_shapes(shape, Kind.TopAbs_FACE))
    return 0, 0


def _solids_and_faces(shape: Any) -> list[Any]:
    """A solid or a face itself; the faces of a shell; the solids of a compound, and its faces outside them."""
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    if shape.ShapeType() in (Kind.TopAbs_SHELL, Kind.TopAbs_COMPSOLID, Kind.TopAbs_COMPOUND):
        return [*sub_shapes(shape, Kind.TopAbs_SOLID), *sub_shapes(shape, Kind.TopAbs_FACE, Kind.TopAbs_SOLID)]
    return [shape]
