"""Parts of a B-rep model: one per solid of a leaf; equal shapes share one prototype."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from hlr.common.types import Color, Floats, Rgba
from hlr.drawing.notes import Note
from hlr.source.cad.shapes import location_matrix, make_compound, sub_shapes
from hlr.source.model import DEFAULT_COLOR, Appearance, rgba
from hlr.source.transforms import MatrixRows, compose, matrix4


@dataclass(slots=True)
class Leaf:
    """A named shape of an assembly, a file or a caller, which is not an assembly itself.

    shape      TopoDS_Shape with its placement
    color      of the leaf; opacity: of that colour, 0 to 1
    colors     of solids and faces, by TShape, where a file has them; opacities: of those that are not opaque
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
    """Splits leaves into `parts`, instances of distinct `prototypes`. `notes` names leaves that were left out."""

    def __init__(self) -> None:
        from OCP.TopLoc import TopLoc_Location

        self._origin = TopLoc_Location()
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
        if leaf.shape is None or leaf.shape.IsNull():
            self.notes.append(Note("part-left-out", f'Part "{leaf.name}" is empty and was left out.'))
            return
        key = (leaf.shape.TShape(), leaf.shape.Orientation(), id(leaf.colors) if leaf.colors else 0)
        pieces = self._pieces.get(key)
        if pieces is None:
            pieces = self._pieces[key] = self._split(leaf)
        place = location_matrix(leaf.shape.Location())
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
                    appearance=partial(_appearance, leaf, self.prototypes[piece.prototype]),
                )
            )

    def _unique(self, name: str, numbered: bool) -> str:
        while True:
            count = self._counts[name] = self._counts.get(name, 0) + 1
            unique = name if count == 1 and not numbered else f"{name}:{count}"
            if unique not in self._names:
                self._names.add(unique)
                return unique

    def _split(self, leaf: Leaf) -> list[_Piece]:
        from OCP.TopAbs import TopAbs_ShapeEnum as Kind

        unplaced = leaf.shape.Located(self._origin, False)
        if unplaced.ShapeType() in (Kind.TopAbs_SOLID, Kind.TopAbs_SHELL, Kind.TopAbs_FACE):
            return [self._piece(unplaced, leaf, unplaced.ShapeType() == Kind.TopAbs_SOLID)]
        solids = sub_shapes(unplaced, Kind.TopAbs_SOLID)
        shells = sub_shapes(unplaced, Kind.TopAbs_SHELL, Kind.TopAbs_SOLID)
        faces = sub_shapes(unplaced, Kind.TopAbs_FACE, Kind.TopAbs_SHELL)
        edges = sub_shapes(unplaced, Kind.TopAbs_EDGE, Kind.TopAbs_FACE)
        pieces = [self._piece(solid, leaf, True) for solid in solids]
        loose = shells + faces
        if loose or edges:
            # Faces and edges outside solids become one part.
            pieces.append(self._piece(make_compound(loose + edges) if solids else unplaced, leaf))
        return pieces

    def _piece(self, shape: Any, leaf: Leaf, solid: bool = False) -> _Piece:
        key = (shape.TShape(), shape.Orientation())
        number = self._numbers.get(key)
        if number is None:
            number = self._numbers[key] = len(self.prototypes)
            self.prototypes.append(shape.Located(self._origin, False))
        color = _main_color(shape, leaf) if leaf.colors else None
        return _Piece(number, location_matrix(shape.Location()), solid, color)


def _main_color(shape: Any, leaf: Leaf) -> Color | None:
    """The colour of a solid in the file, else the most frequent colour of its faces."""
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    whole_color = leaf.colors.get(shape.TShape())
    if whole_color is not None:
        return whole_color
    counts: dict[Color | None, int] = {}
    for face in sub_shapes(shape, Kind.TopAbs_FACE):
        color = leaf.colors.get(face.TShape(), leaf.color)
        counts[color] = counts.get(color, 0) + 1
    return max(counts, key=lambda color: counts[color]) if counts else None


def _appearance(leaf: Leaf, prototype: Any) -> Appearance:
    """Colours of a part of a leaf. prototype: its shape without placement."""
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    whole_color = _own_color(leaf, prototype)
    faces = {}
    if leaf.colors:
        for i, face in enumerate(sub_shapes(prototype, Kind.TopAbs_FACE)):
            color = _own_color(leaf, face)
            if color is not None and color != whole_color:
                faces[i] = color
    whole = whole_color or rgba(leaf.color, leaf.opacity)
    if whole is None and leaf.opacity < 1.0:
        whole = (*DEFAULT_COLOR[:3], leaf.opacity)
    return Appearance(whole, faces)


def _own_color(leaf: Leaf, shape: Any) -> Rgba | None:
    key = shape.TShape()
    return rgba(leaf.colors.get(key), leaf.opacities.get(key, 1.0))
