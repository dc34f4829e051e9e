"""Parts of a B-rep model: one per solid of a leaf; equal shapes share one prototype."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from hlr.common.types import Color, Floats, Rgba
from hlr.drawing.notes import Note
from hlr.source.cad.part_shapes import PartShapes, Piece
from hlr.source.model import DEFAULT_COLOR, Appearance, rgba


@dataclass(slots=True)
class Leaf:
    """A named shape of an assembly, a file or a caller, which is not an assembly itself.

    shape      with its placement: a TopoDS_Shape, or a `hlr.source.cad.kernel_shapes.KernelShape`
    color      of the leaf; opacity: of that colour, 0 to 1
    colors     of solids and faces, by what underlies them, where a file has them; opacities: of those that have one
    above      names of the assemblies that it is in, and of its place in them, where its own name does not say them
    """

    shape: Any
    name: str
    color: Color | None = None
    colors: dict[Any, Color] = field(default_factory=dict)
    opacity: float = 1.0
    opacities: dict[Any, float] = field(default_factory=dict)
    above: tuple[str, ...] = ()


@dataclass(slots=True)
class Part:
    """A part to draw: an instance of a prototype (a shape without placement).

    name         unique
    product      name of its leaf, which several parts may share
    prototype    index of its prototype
    transform    (4, 4) placement
    transparent  some of it may be transparent
    appearance   returns its colours; they are gathered only when asked for
    above        as of its leaf
    """

    name: str
    product: str
    color: Color | None
    prototype: int
    transform: Floats
    transparent: bool
    appearance: Callable[[], Appearance]
    above: tuple[str, ...] = ()


class PartCollector:
    """Splits leaves into `parts`, instances of distinct `prototypes`. `notes` names leaves that were left out.

    A leaf without a shape becomes a note, for its geometry is missing. A leaf without faces and edges does not: such
    products carry annotation only, often under the name of the part that they annotate.
    """

    def __init__(self, shapes: PartShapes, leaves: Sequence[Leaf]) -> None:
        """Args: shapes: knows the shapes of the leaves, which are all of one kind."""
        self._shapes = shapes
        self.notes: list[Note] = []
        self._colors: dict[tuple[int, int], Color | None] = {}
        self._names: set[str] = set()
        self._counts: dict[str, int] = {}
        kept = []
        for leaf in leaves:
            if shapes.is_null(leaf.shape):
                self.notes.append(Note("part-left-out", f'Part "{leaf.name}" is empty and was left out.'))
            else:
                kept.append(leaf)
        division = shapes.divided([leaf.shape for leaf in kept])
        self.prototypes = division.prototypes
        named: list[tuple[Leaf, str, Piece]] = []
        for leaf, pieces in zip(kept, division.pieces, strict=True):
            self._name(leaf, pieces, named)
        self.parts = [
            Part(
                name=name,
                product=leaf.name,
                color=self._piece_color(leaf, piece) or leaf.color,
                prototype=piece.prototype,
                transform=transform,
                transparent=leaf.opacity < 1.0 or bool(leaf.opacities),
                appearance=partial(_appearance, leaf, piece.shape, shapes),
                above=leaf.above,
            )
            for (leaf, name, piece), transform in zip(named, division.places, strict=True)
        ]

    def _name(self, leaf: Leaf, pieces: Sequence[Piece], named: list[tuple[Leaf, str, Piece]]) -> None:
        """Give the pieces of a leaf their names."""
        if len(pieces) == 1:
            named.append((leaf, self._unique(leaf.name, False), pieces[0]))
            return
        several = sum([piece.solid for piece in pieces]) > 1
        for piece in pieces:
            suffix = "" if piece.solid else ":loose"
            named.append((leaf, self._unique(leaf.name + suffix, several and piece.solid), piece))

    def _unique(self, name: str, numbered: bool) -> str:
        while True:
            count = self._counts[name] = self._counts.get(name, 0) + 1
            unique = name if count == 1 and not numbered else f"{name}:{count}"
            if unique not in self._names:
                self._names.add(unique)
                return unique

    def _piece_color(self, leaf: Leaf, piece: Piece) -> Color | None:
        """The main colour of a piece, where the leaf has colours of solids and faces; worked out once."""
        if not leaf.colors:
            return None
        key = piece.prototype, id(leaf.colors)
        if key not in self._colors:
            self._colors[key] = _main_color(piece.shape, leaf, self._shapes)
        return self._colors[key]


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
    """Colours of a part of a leaf. prototype: its shape without placement; not asked where the leaf has no `colors`."""
    whole_color, faces = None, {}
    if leaf.colors:
        whole_color = _own_color(leaf, shapes.underlying(prototype))
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
