"""Shapes of a FreeCAD document: read once each, and placed, scaled and coloured as leaves of an assembly."""

from __future__ import annotations

import io
import math
import struct
from collections.abc import Hashable
from typing import Any

import numpy as np

from hlr.common.types import Color, Floats
from hlr.source.cad.brep_file import is_binary, read_brep, read_lean
from hlr.source.cad.kernel_shapes import KernelShapes, NeedsOpenCascadeError, moved
from hlr.source.cad.part_shapes import OcctShapes
from hlr.source.cad.parts import Leaf
from hlr.source.freecad.colors import Look
from hlr.source.freecad.document import Object
from hlr.source.transforms import IDENTITY, MatrixRows, compose

Colors = tuple[dict[Any, Color], dict[Any, float]]
"""Colours of faces, and opacities below one, by what underlies them."""


class Shapes:
    """The shapes of a document. What several instances have in common is one shape: read, scaled and coloured once.

    opencascade: it reads them, and not the kernel, which scales none.
    """

    def __init__(self, opencascade: bool) -> None:
        self._opencascade = opencascade
        self._read: dict[str, Any] = {}
        self._scaled: dict[tuple[str, bytes], Any] = {}
        self._colors: dict[tuple[str, bytes], Colors] = {}

    def of(self, thing: Object) -> Any:
        """The shape of an object, with its own placement; None where it has none.

        A TopoDS_Shape, or without OpenCASCADE a `KernelShape`.

        Raises:
            ValueError: it is broken; the message says why.
            NeedsOpenCascadeError: the kernel cannot take it.
        """
        if thing.name not in self._read:
            data = thing.values.content("Shape")
            if data is None:
                raise ValueError("is missing in the document")
            self._read[thing.name] = self._shape(data) if data else None
        return self._read[thing.name]

    def _shape(self, data: bytes) -> Any:
        if self._opencascade:
            return (read_binary if is_binary(data) else read_brep)(data)
        return read_lean(data)

    def leaf(self, thing: Object, name: str, place: MatrixRows, placed: bool, look: Look | None) -> Leaf:
        """An instance of an object's shape. placed: by its own placement as well, inside `place`.

        Raises:
            ValueError, NeedsOpenCascadeError: as of `of`.
        """
        shape, shapes = self.of(thing), OcctShapes() if self._opencascade else KernelShapes()
        whole = compose(place, shapes.place(shape) if placed else IDENTITY)
        scale, rest = split_scale(whole)
        key = (thing.name, b"" if scale is None else scale.tobytes())
        if key not in self._scaled:
            if scale is not None and not self._opencascade:
                raise NeedsOpenCascadeError("a scaled shape")
            bare = shapes.unplaced(shape)
            self._scaled[key] = bare if scale is None else _scaled(bare, scale)
        bare = self._scaled[key]
        leaf = Leaf((_moved if self._opencascade else moved)(bare, rest), name)
        if look is not None:
            leaf.color, leaf.opacity = look.whole[:3], look.whole[3]
            if look.faces:
                leaf.colors, leaf.opacities = self._face_colors(key, shapes.faces(bare), look)
        return leaf

    def _face_colors(self, key: tuple[str, bytes], faces: list[Hashable], look: Look) -> Colors:
        if key not in self._colors:
            # A list of another length is of an earlier shape: FreeCAD does not show it either.
            pairs = list(zip(faces, look.faces, strict=True)) if len(faces) == len(look.faces) else []
            self._colors[key] = (
                {face: rgba[:3] for face, rgba in pairs},
                {face: rgba[3] for face, rgba in pairs if rgba[3] < 1.0},
            )
        return self._colors[key]


def read_binary(data: bytes) -> Any:
    """The TopoDS_Shape of a binary BREP file of FreeCAD's: after the tables it names shape, location and orientation.

    Raises:
        ValueError: it is broken; the message says why.
    """
    from OCP.BinTools import BinTools_ShapeSet
    from OCP.TopAbs import TopAbs_Orientation

    from hlr.source.cad.occt_import import load_occt, silence_stdout

    load_occt()
    tables = BinTools_ShapeSet()
    number, place, orientation = struct.unpack("<3i", data[-12:]) if len(data) > 12 else (0, 0, 0)
    try:
        with silence_stdout():
            tables.Read(io.BytesIO(data))
            if not 1 <= number <= tables.NbShapes() or not 0 <= place <= tables.Locations().NbLocations():
                raise ValueError("its root is missing")
            shape = tables.Shape(number)
            shape.Location(tables.Locations().Location(place), False)
            shape.Orientation(list(TopAbs_Orientation.__members__.values())[orientation])
    except Exception as error:  # OpenCASCADE's exceptions derive from Exception alone
        raise ValueError(f"cannot be read as BREP ({type(error).__name__}): the file is broken") from None
    return shape


def split_scale(rows: MatrixRows) -> tuple[Floats | None, MatrixRows]:
    """A placement as a scaling (3, 3) of the shape, None where there is none, and what is left: a turn and a shift."""
    if rows is IDENTITY:
        return None, rows
    matrix = np.array(rows).reshape(3, 4)
    linear, shift = matrix[:, :3], matrix[:, 3]
    with np.errstate(over="ignore"):
        volume = float(np.linalg.det(linear))
    if not math.isfinite(volume):
        raise ValueError("is larger than numbers can be at its scale")
    size = math.copysign(abs(volume) ** (1 / 3), volume)
    if size == 0.0:
        raise ValueError("has no volume at a scale of zero")
    turn = linear / size
    if np.abs(turn @ turn.T - np.eye(3)).max() < 1e-9:
        if abs(size - 1.0) < 1e-9:
            return None, rows
        return np.eye(3) * round(size, 12), _rows(turn, shift)
    # Scaled differently along its axes: what is left is a shift alone.
    return np.round(linear, 12), _rows(np.eye(3), shift)


def _rows(linear: Floats, shift: Floats) -> MatrixRows:
    return tuple(np.column_stack((linear, shift)).ravel().tolist())


def _scaled(shape: Any, scale: Floats) -> Any:
    """The shape itself made larger or smaller, and not only placed so: OpenCASCADE's tolerances would not follow."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_GTransform, BRepBuilderAPI_Transform
    from OCP.gp import gp_GTrsf, gp_Trsf

    if np.array_equal(scale, np.eye(3) * scale[0, 0]):
        even = gp_Trsf()
        even.SetScaleFactor(float(scale[0, 0]))
        return BRepBuilderAPI_Transform(shape, even, True).Shape()
    uneven = gp_GTrsf()
    for i in range(3):
        for j in range(3):
            uneven.SetValue(i + 1, j + 1, float(scale[i, j]))
    return BRepBuilderAPI_GTransform(shape, uneven, True).Shape()


def _moved(shape: Any, rows: MatrixRows) -> Any:
    """The shape at this placement, a turn and a shift, instead of its own."""
    from OCP.gp import gp_Trsf
    from OCP.TopLoc import TopLoc_Location

    if rows is IDENTITY:
        return shape.Located(TopLoc_Location(), False)
    move = gp_Trsf()
    move.SetValues(*rows)
    return shape.Located(TopLoc_Location(move), False)
