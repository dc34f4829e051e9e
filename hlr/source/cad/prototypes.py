"""Prototypes: the distinct shapes without placement of which the parts of a model are instances."""

from __future__ import annotations

import _thread
import io
import math
from collections.abc import Callable, Collection, Sequence
from functools import cached_property
from typing import Any

from hlr import _kernel
from hlr.common.types import Floats, Ints


class Prototypes:
    """Prototypes as a binary dump. OpenCASCADE is loaded only where `shapes` is asked for.

    dump: OpenCASCADE's binary dump of a compound of all prototypes.
    """

    def __init__(self, dump: bytes, counts: Ints | None = None, boxes: Floats | None = None) -> None:
        """Args: counts, boxes: where they are known already."""
        self.dump = dump
        if counts is not None and boxes is not None:
            self.counts, self.boxes = counts, boxes

    @cached_property
    def counts(self) -> Ints:
        """(r, 3) int32: faces, edges and solids in the index maps of each."""
        return self.model.counts()

    @cached_property
    def boxes(self) -> Floats:
        """(r, 2, 3) lower and upper corner of each; the lower is beyond the upper where it has no extent."""
        return self.model.boxes()

    @cached_property
    def has_faces(self) -> list[bool]:
        """(r,) whether each has faces."""
        found: list[bool] = (self.counts[:, 0] > 0).tolist()
        return found

    def without_shapes(self) -> Prototypes:
        """The same as a dump alone, so that shapes in memory can be released."""
        return self

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

    def failed_faces(self, chosen: Sequence[int], failed: Collection[int]) -> dict[int, Any]:
        """By number in the model of the `chosen` prototypes, the TopoDS_Face of each face that failed."""
        from hlr.source.cad.rescue import faces_of

        # Shapes from the dump: a model from the cache has no others, and must give the same triangles.
        shapes = self.shapes_from_dump
        return faces_of([shapes[number] for number in chosen], set(failed))


class LivePrototypes(Prototypes):
    """Prototypes as shapes in memory, which are not changed: the dump is made where it is asked for, and not kept."""

    def __init__(self, shapes: Sequence[Any]) -> None:
        self._shapes = list(shapes)

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

    @property
    def dump(self) -> bytes:  # type: ignore[override]
        """OpenCASCADE's binary dump, without triangles except where they are all there is."""
        return binary_dump(self.shapes)

    def without_shapes(self) -> Prototypes:
        """The same as a dump alone, so that the shapes can be released."""
        return Prototypes(self.dump)


class DividedPrototypes(LivePrototypes):
    """Prototypes that the kernel has made of shapes in memory.

    model: of all prototypes; shapes: finds them with OpenCASCADE, in the same order, where they are asked for.
    """

    def __init__(self, model: _kernel.BrepModel, shapes: Callable[[], list[Any]]) -> None:
        self.model = model
        self._find = shapes

    @cached_property
    def has_faces(self) -> list[bool]:
        """(r,) whether each has faces."""
        found: list[bool] = (self.counts[:, 0] > 0).tolist()
        return found

    @cached_property
    def shapes(self) -> list[Any]:
        """(r,) TopoDS_Shape of each: the caller's own."""
        return self._find()


Corner = tuple[float, float, float]

KernelPieces = tuple[list[list[tuple[int, bool]]], Floats]
"""For each shape its pieces: prototype, and whether a solid; and (n, 4, 4) where all of them stand."""

EMPTY_BOX: tuple[Corner, Corner] = ((math.inf,) * 3, (-math.inf,) * 3)
"""Lower and upper corner of the box of a shape without extent."""


def divided_by_kernel(shapes: Sequence[Any]) -> tuple[_kernel.BrepModel, KernelPieces] | None:
    """The model of all distinct pieces of shapes, as the kernel divides them, and the pieces of each shape.

    None where only OpenCASCADE can: faces are made of triangles alone, or this OpenCASCADE writes no stream.
    """
    stream = shape_stream(shapes)
    if stream is None:
        return None
    try:
        return _kernel.BrepModel.divided(stream, len(shapes) == 1)
    except ValueError:
        # The kernel reads no triangles of a stream: the dump has those that are all there is of a face.
        return None


LONG_STREAM = 1 << 20
"""Bytes of a stream beyond which its writer is released on a thread of its own. A thread takes 0.1 ms to start."""


def shape_stream(shapes: Sequence[Any]) -> bytes | None:
    """OpenCASCADE's stream of a compound of the shapes, or of a single one: written in half the time of a dump.

    It has no triangles, and cannot be read back as the dump can. None where this OpenCASCADE writes none.
    """
    import OCP.BinTools

    from hlr.source.cad.shapes import make_compound

    writer = getattr(OCP.BinTools, "BinTools_ShapeWriter", None)
    if writer is None:
        return None
    stream = io.BytesIO()
    writers = [writer()]
    writers[0].Write(shapes[0] if len(shapes) == 1 else make_compound(list(shapes)), stream)
    found = stream.getvalue()
    if len(found) > LONG_STREAM:
        # That takes a third as long as writing. The kernel reads the stream meanwhile.
        _thread.start_new_thread(writers.clear, ())
    return found


def binary_dump(shapes: Sequence[Any]) -> bytes:
    """OpenCASCADE's binary dump of a compound of the shapes, without triangles except where they are all there is."""
    from OCP.BinTools import BinTools, BinTools_FormatVersion

    from hlr.source.cad.shapes import make_compound

    stream = io.BytesIO()
    version = BinTools_FormatVersion.BinTools_FormatVersion_VERSION_4
    BinTools.Write_s(make_compound(list(shapes)), stream, False, False, version)
    return stream.getvalue()
