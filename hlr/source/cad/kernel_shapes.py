"""Shapes of BREP files that the kernel has read itself: OpenCASCADE is not needed to make parts of them."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeVar

from hlr import _kernel
from hlr.source.cad.occt_import import load_occt
from hlr.source.cad.part_shapes import Division, divided_one_by_one
from hlr.source.cad.prototypes import Prototypes
from hlr.source.transforms import IDENTITY, MatrixRows

T = TypeVar("T")


class NeedsOpenCascadeError(Exception):
    """A model that the kernel cannot take alone."""


def without_opencascade(make: Callable[[bool], T]) -> T:
    """What `make` makes without OpenCASCADE; where that cannot be, with it. It is told whether OpenCASCADE is there.

    Raises:
        SourceError: OpenCASCADE is needed and missing.
    """
    try:
        return make(False)
    except NeedsOpenCascadeError:
        load_occt()
        return make(True)


@dataclass(frozen=True, slots=True, eq=False)
class KernelShape:
    """The shape of a BREP file, or a piece of it, at a placement.

    piece      its number among the pieces of the file; None: all of it
    one        number and orientation of the one shape that it is; None: it is several, as one piece
    place      its placement
    """

    file: _kernel.BrepFile
    piece: int | None
    one: tuple[int, int] | None
    place: MatrixRows


def read_shape(data: bytes) -> KernelShape:
    """The shape of a BREP file's content, text or binary, with its own placement.

    Raises:
        ValueError: it is broken; the message says how.
        NeedsOpenCascadeError: it has what only OpenCASCADE may read.
    """
    try:
        file = _kernel.BrepFile(data)
    except NotImplementedError as error:
        raise NeedsOpenCascadeError(str(error)) from None
    return KernelShape(file, None, file.root, _rows(file.place))


def moved(shape: KernelShape, rows: MatrixRows) -> KernelShape:
    """The shape at this placement, a turn and a shift, instead of its own. Its turn is made one without rounding."""
    return replace(shape, place=rows if rows is IDENTITY else _rows(_kernel.square_placement(rows)))


def _rows(numbers: Sequence[float]) -> MatrixRows:
    rows = tuple(numbers)
    return IDENTITY if rows == IDENTITY else rows


class KernelShapes:
    """`KernelShape` as `hlr.source.cad.part_shapes.PartShapes`."""

    def is_null(self, shape: KernelShape | None) -> bool:
        """As of `PartShapes`."""
        return shape is None

    def underlying(self, shape: KernelShape) -> Hashable:
        """As of `PartShapes`."""
        return (shape.file, shape.piece) if shape.one is None else (shape.file, shape.one[0])

    def orientation(self, shape: KernelShape) -> Hashable:
        """As of `PartShapes`."""
        return None if shape.one is None else shape.one[1]

    def place(self, shape: KernelShape) -> MatrixRows:
        """As of `PartShapes`."""
        return shape.place

    def unplaced(self, shape: KernelShape) -> KernelShape:
        """As of `PartShapes`."""
        return replace(shape, place=IDENTITY)

    def pieces(self, shape: KernelShape) -> list[tuple[KernelShape, bool]]:
        """As of `PartShapes`."""
        return [
            (KernelShape(shape.file, number, one, _rows(place)), solid)
            for number, (solid, one, place) in enumerate(shape.file.pieces)
        ]

    def faces(self, shape: KernelShape) -> list[Hashable]:
        """As of `PartShapes`."""
        return [(shape.file, face) for face in shape.file.faces(shape.piece)]

    def divided(self, shapes: Sequence[KernelShape]) -> Division:
        """As of `PartShapes`."""
        return divided_one_by_one(self, shapes, _prototypes)


def _prototypes(shapes: Sequence[KernelShape]) -> Prototypes:
    files = list(dict.fromkeys(shape.file for shape in shapes))
    number = {file: i for i, file in enumerate(files)}
    roots: list[tuple[int, Any]] = [(number[shape.file], shape.piece) for shape in shapes]
    return Prototypes(_kernel.dump_of_pieces(files, roots))
