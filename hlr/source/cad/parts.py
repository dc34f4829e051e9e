"""Parts of a B-rep model: one per solid of a leaf; equal shapes share one prototype."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from hlr.common.types import Color, Floats, Rgba
from hlr.drawing.notes import Note
from hlr.source.cad.part_shapes import PartShapes
from hlr.source.model import DEFAULT_COLOR, Appearance, rgba
from hlr.source.transforms import MatrixRows, compose, matrix4


@dataclass(slots=True)
class Leaf:
    """A named shape of an assembly, a file or a caller, which is not an assembly itself.

    shape      with its placement: a TopoDS_Shape, or a `hlr.source.cad.kernel_shapes.KernelShape`
    color      of the leaf; opacity: of that colour, 0 to 1
    colors     of solids and faces, by what underlies them, where a file has them; opacities: of those that have one
    """

    shape: Any
    name: str
    color: Color | None = None
    colors: dict[Any, Color] = field(default_factory=dict)
    opacity: float = 1.0
    opacities: dict[Any, float] = field(default_factory=dict)


@dataclass(slots=True)
class Part:
    """A part to draw: an instance of a prototype (a shape without placement).

    name         unique
    product      name of its leaf, which several parts may share
    prototype    index of its prototype
    transform    (4, 4) placement
    transparent  some of it may be transparent
    appearance   returns its colours; they are gathered only when asked for
    """

    name: str
    product: str
    color: Color | None
    prototype: int
    transform: Floats
    transparent: bool
    appearance: Callable[[], Appearance]


@dataclass(slots=True)
class _Piece:
    """A part of a leaf, in the leaf's own coordinates."""

    prototype: int
    place: MatrixRows
    solid: bool
    color: Color | None


class PartCollector:
    """Splits leaves into `parts`, instances of distinct `prototypes`. `notes` names leaves that were left out.

    shapes: knows the shapes of the leaves, which are all of one kind.
    """

    def __init__(self, shapes: PartShapes) -> None:
        self._shapes = shapes
        self.parts: list[Part] = []
        self.prototypes: list[Any] = []
        self.notes: list[Note] = []
        self._numbers: dict[Any, int] = {}
        self._pieces: dict[Any, list[_Piece]] = {}
        self._names: set[str] = set()
        self._counts: dict[str, int] = {}

    def add(self, leaf: Leaf) -> None:
        """Split a leaf into parts.

        A leaf without a shape becomes a note, for its geometry is missing. A leaf without faces and edges does not:
        such products carry annotation only, often under the name of the part that they annotate.
        """
        if self._shapes.is_null(leaf.shape):
            self.notes.append(Note("part-left-out", f'Part "{leaf.name}" is empty and was left out.'))
            return
        key = (*self._key(leaf.shape), id(leaf.colors) if leaf.colors else 0)
        pieces = self._pieces.get(key)
        if pieces is None:
            pieces = self._pieces[key] = [
                self._piece(shape, leaf, solid)
                for shape, solid in self._shapes.pieces(self._shapes.unplaced(leaf.shape))
            ]
        place = self._shapes.place(leaf.shape)
        several = sum(piece.solid for piece in pieces) > 1
        for piece in pieces:
            suffix = "" if piece.solid or len(pieces) == 1 else ":loose"
            self.parts.append(
                Part(
                    name=self._unique(leaf.name + suffix, several and piece.solid),
                    product=leaf.name,
                    color=piece.color or leaf.color,
                    prototype=piece.prototype,
                    transform=matrix4(compose(place, piece.place)),
                    transparent=leaf.opacity < 1.0 or bool(leaf.opacities),
                    appearance=partial(_appearance, leaf, self.prototypes[piece.prototype], self._shapes),
                )
            )

    def _key(self, shape: Any) -> tuple[Hashable, Hashable]:
        return self._shapes.underlying(shape), self._shapes.orientation(shape)

    def _unique(self, name: str, numbered: bool) -> str:
        while True:
            count = self._counts[name] = self._counts.get(name, 0) + 1
            unique = name if count == 1 and not numbered else f"{name}:{count}"
            if unique not in self._names:
                self._names.add(unique)
                return unique

    def _piece(self, shape: Any, leaf: Leaf, solid: bool) -> _Piece:
        key = self._key(shape)
        number = self._numbers.get(key)
        if number is None:
            number = self._numbers[key] = len(self.prototypes)
            self.prototypes.append(self._shapes.unplaced(shape))
        color = _main_color(shape, leaf, self._shapes) if leaf.colors else None
        return _Piece(number, self._shapes.place(shape), solid, color)


def _main_color(shape: Any, leaf: Leaf, shapes: PartShapes) -> Color | None:
    """The colour of a solid in the file, else the most frequent colour of its faces."""
    whole_color = leaf.colors.get(shapes.underlying(shape))
    if whole_color is not None:
        return whole_color
    counts: dict[Color | None, int] = {}
    for face in shapes.faces(shape):
        color = leaf.colors.get(face, leaf.color)
        counts[color] = counts.get(color, 0) + 1
    return max(counts, key=lambda color: counts[color]) if counts else None


def _appearance(leaf: Leaf, prototype: Any, shapes: PartShapes) -> Appearance:
    """Colours of a part of a leaf. prototype: its shape without placement."""
    whole_color = _own_color(leaf, shapes.underlying(prototype))
    faces = {}
    if leaf.colors:
        for i, face in enumerate(shapes.faces(prototype)):
            color = _own_color(leaf, face)
            if color is not None and color != whole_color:
                faces[i] = color
    whole = whole_color or rgba(leaf.color, leaf.opacity)
    if whole is None and leaf.opacity < 1.0:
        whole = (*DEFAULT_COLOR[:3], leaf.opacity)
    return Appearance(whole, faces)


def _own_color(leaf: Leaf, key: Hashable) -> Rgba | None:
    return rgba(leaf.colors.get(key), leaf.opacities.get(key, 1.0))
