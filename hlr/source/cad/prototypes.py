"""Prototypes: the distinct shapes without placement of which the parts of a model are instances."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from functools import cached_property
from typing import Any

import numpy as np

from hlr import _kernel
from hlr.common.types import Floats, Ints
from hlr.source.cad.occt_collections import new_collection


class Prototypes:
    """Prototypes as a binary dump. OpenCASCADE is loaded only where `shapes` is asked for.

    dump    OpenCASCADE's binary dump of a compound of all prototypes
    counts  (r, 3) int32: faces, edges and solids in the index maps of each
    boxes   (r, 2, 3) lower and upper corner of each; the lower is beyond the upper where it has no extent
    """

    def __init__(self, dump: bytes, counts: Ints, boxes: Floats) -> None:
        self.dump, self.counts, self.boxes = dump, counts, boxes

    @cached_property
    def has_faces(self) -> list[bool]:
        """(r,) whether each has faces."""
        found: list[bool] = (self.counts[:, 0] > 0).tolist()
        return found

    @cached_property
    def model(self) -> _kernel.BrepModel:
        """The kernel's model of all prototypes. Raises ValueError where the dump is damaged."""
        return _kernel.BrepModel(self.dump)

    def model_of(self, indices: Sequence[int]) -> _kernel.BrepModel:
        """The kernel's model of the prototypes with these indices, ascending."""
        if len(indices) == len(self.has_faces):
            return self.model
        return _kernel.BrepModel(self.dump, indices)

    @cached_property
    def shapes_from_dump(self) -> list[Any]:
        """The shapes read from the dump: the same for a model from a file and one from the cache."""
        from hlr.source.cad.occt_import import load_occt

        load_occt()
        from OCP.BinTools import BinTools
        from OCP.TopoDS import TopoDS_Iterator, TopoDS_Shape

        whole = TopoDS_Shape()
        BinTools.Read_s(whole, io.BytesIO(self.dump))
        found, children = [], TopoDS_Iterator(whole)
        while children.More():
            found.append(children.Value())
            children.Next()
        return found

    @property
    def shapes(self) -> list[Any]:
        """(r,) TopoDS_Shape of each."""
        return self.shapes_from_dump


class LivePrototypes(Prototypes):
    """Prototypes as shapes in memory, which are not changed: counts, boxes and dump are made on first use."""

    def __init__(self, shapes: Sequence[Any]) -> None:
        self._shapes = list(shapes)

    @cached_property
    def counts(self) -> Ints:  # type: ignore[override]
        """(r, 3) faces, edges and solids in the index maps of each."""
        return np.array(_counts(self._shapes), np.int32).reshape(-1, 3)

    @cached_property
    def has_faces(self) -> list[bool]:
        """(r,) whether each has faces."""
        from OCP.TopAbs import TopAbs_ShapeEnum as Kind
        from OCP.TopExp import TopExp_Explorer

        face = Kind.TopAbs_FACE
        return [bool(TopExp_Explorer(shape, face).More()) for shape in self._shapes]

    @property
    def shapes(self) -> list[Any]:
        """(r,) TopoDS_Shape of each: the caller's own."""
        return self._shapes

    @cached_property
    def model(self) -> _kernel.BrepModel:
        """The kernel's model of all prototypes. The dump is released, and written again where it is needed again."""
        made = _kernel.BrepModel(self.dump)
        self.__dict__.pop("dump")
        return made

    @cached_property
    def dump(self) -> bytes:  # type: ignore[override]
        """OpenCASCADE's binary dump, without triangles except where they are all there is."""
        return binary_dump(self._shapes)

    @cached_property
    def boxes(self) -> Floats:  # type: ignore[override]
        """(r, 2, 3) lower and upper corner of each; the lower is beyond the upper where it has no extent."""
        return np.array(_boxes(self._shapes)).reshape(-1, 2, 3)

    def without_shapes(self) -> Prototypes:
        """The same as a dump alone, so that the shapes can be released."""
        return Prototypes(self.dump, self.counts, self.boxes)


Corner = tuple[float, float, float]

EMPTY_BOX: tuple[Corner, Corner] = ((math.inf,) * 3, (-math.inf,) * 3)
"""Lower and upper corner of the box of a shape without extent."""


def binary_dump(shapes: Sequence[Any]) -> bytes:
    """OpenCASCADE's binary dump of a compound of the shapes, without triangles except where they are all there is."""
    from OCP.BinTools import BinTools, BinTools_FormatVersion

    from hlr.source.cad.shapes import make_compound

    stream = io.BytesIO()
    version = BinTools_FormatVersion.BinTools_FormatVersion_VERSION_4
    BinTools.Write_s(make_compound(list(shapes)), stream, False, False, version)
    return stream.getvalue()


def _counts(shapes: Sequence[Any]) -> list[list[int]]:
    """[faces, edges, solids] of the index maps of each shape."""
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopExp import TopExp

    def count(shape: Any, kind: Any) -> int:
        found = new_collection("shape_map")
        TopExp.MapShapes_s(shape, kind, found)
        number: int = found.Extent()
        return number

    kinds = Kind.TopAbs_FACE, Kind.TopAbs_EDGE, Kind.TopAbs_SOLID
    return [[count(shape, kind) for kind in kinds] for shape in shapes]


def _boxes(shapes: Sequence[Any]) -> list[tuple[Corner, Corner]]:
    """Lower and upper corner of each shape's box; the lower is beyond the upper where it has no extent."""
    from OCP.Bnd import Bnd_Box
    from OCP.BRepBndLib import BRepBndLib

    box, add, out = Bnd_Box(), BRepBndLib.Add_s, []
    for shape in shapes:
        box.SetVoid()
        # From the geometry, not from a triangulation that an earlier drawing may have left: the accuracy depends on it,
        # and the same shape is to give the same drawing twice. Faces that are nothing but a triangulation have only
        # that.
        add(shape, box, False)
        if box.IsVoid():
            add(shape, box, True)
        out.append(EMPTY_BOX if box.IsVoid() else (box.CornerMin().Coord(), box.CornerMax().Coord()))
    return out
