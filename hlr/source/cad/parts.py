"""From the leaves of an assembly to parts: one per solid, loose faces together, underlying shapes shared."""

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
    """A shape as an assembly, a file or a caller names it.

    shape: TopoDS_Shape with its placement; colors: by underlying shape of a solid or face, where a file says so.
    opacity: of `color`; opacities: of those `colors` that are not opaque.
    """

    shape: Any
    name: str
    color: Color | None = None
    colors: dict[Any, Color] = field(default_factory=dict)
    opacity: float = 1.0
    opacities: dict[Any, float] = field(default_factory=dict)


@dataclass(slots=True)
class Part:
    """A part to draw: the number of its root (a shape without placement), and where it stands, a (4, 4) matrix.

    name: its own; product: that of its leaf, which several parts may share. transparent: it may be, in part; look: says
    how it looks.
    """

    name: str
    product: str
    color: Color | None
    root: int
    transform: Floats
    transparent: bool
    look: Callable[[], Appearance]


@dataclass(slots=True)
class _Piece:
    root: int
    place: MatrixRows
    solid: bool
    color: Color | None


class PartCollector:
    """Collects leaves into `parts` over distinct `roots`; `notes` says what was left out."""

    def __init__(self) -> None:
        from OCP.TopLoc import TopLoc_Location

        self._origin = TopLoc_Location()
        self.parts: list[Part] = []
        self.roots: list[Any] = []
        self.notes: list[Note] = []
        self.has_edges = False
        self._numbers: dict[Any, int] = {}
        self._pieces: dict[Any, list[_Piece]] = {}
        self._names: set[str] = set()
        self._counts: dict[str, int] = {}

    def add(self, leaf: Leaf) -> None:
        """Split a leaf.

        One without any shape becomes a note: its geometry is missing. One that holds neither faces nor edges does not:
        such products only carry annotation, often under the name of the part that they annotate.
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
                    root=piece.root,
                    transform=matrix4(compose(place, piece.place)),
                    transparent=leaf.opacity < 1.0 or bool(leaf.opacities),
                    look=partial(_look, leaf, self.roots[piece.root]),
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

        bare = leaf.shape.Located(self._origin, False)
        if bare.ShapeType() in (Kind.TopAbs_SOLID, Kind.TopAbs_SHELL, Kind.TopAbs_FACE):
            return [self._piece(bare, leaf, bare.ShapeType() == Kind.TopAbs_SOLID)]
        solids = sub_shapes(bare, Kind.TopAbs_SOLID)
        shells = sub_shapes(bare, Kind.TopAbs_SHELL, Kind.TopAbs_SOLID)
        faces = sub_shapes(bare, Kind.TopAbs_FACE, Kind.TopAbs_SHELL)
        edges = sub_shapes(bare, Kind.TopAbs_EDGE, Kind.TopAbs_FACE)
        self.has_edges |= bool(edges)
        pieces = [self._piece(solid, leaf, True) for solid in solids]
        loose = shells + faces
        if loose or edges:
            # What is not a solid stays together: the leaf itself where it holds nothing else.
            pieces.append(self._piece(make_compound(loose + edges) if solids else bare, leaf))
        return pieces

    def _piece(self, shape: Any, leaf: Leaf, solid: bool = False) -> _Piece:
        key = (shape.TShape(), shape.Orientation())
        number = self._numbers.get(key)
        if number is None:
            number = self._numbers[key] = len(self.roots)
            self.roots.append(shape.Located(self._origin, False))
        color = _majority(shape, leaf) if leaf.colors else None
        return _Piece(number, location_matrix(shape.Location()), solid, color)


def _majority(shape: Any, leaf: Leaf) -> Color | None:
    """The colour a file gives to the solid, else the one most of its faces have."""
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    own = leaf.colors.get(shape.TShape())
    if own is not None:
        return own
    counts: dict[Color | None, int] = {}
    for face in sub_shapes(shape, Kind.TopAbs_FACE):
        color = leaf.colors.get(face.TShape(), leaf.color)
        counts[color] = counts.get(color, 0) + 1
    return max(counts, key=lambda color: counts[color]) if counts else None


def _look(leaf: Leaf, root: Any) -> Appearance:
    """How a part of a leaf looks; root: its shape, without placement."""
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    own = _painted(leaf, root)
    faces = {}
    if leaf.colors:
        for i, face in enumerate(sub_shapes(root, Kind.TopAbs_FACE)):
            color = _painted(leaf, face)
            if color is not None and color != own:
                faces[i] = color
    whole = own or rgba(leaf.color, leaf.opacity)
    if whole is None and leaf.opacity < 1.0:
        whole = (*DEFAULT_COLOR[:3], leaf.opacity)
    return Appearance(whole, faces)


def _painted(leaf: Leaf, shape: Any) -> Rgba | None:
    key = shape.TShape()
    return rgba(leaf.colors.get(key), leaf.opacities.get(key, 1.0))
