"""What is asked of shapes to make parts of them: of OpenCASCADE's, and of those that the kernel has read itself."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any, NamedTuple, Protocol

from hlr.common.types import Floats
from hlr.source.cad.prototypes import DividedPrototypes, LivePrototypes, Prototypes, divided_by_kernel
from hlr.source.transforms import MatrixRows, compose, matrices4


class Piece(NamedTuple):
    """A solid of a shape, or all that lies outside its solids.

    prototype  its index among the prototypes
    shape      without placement; None where the kernel alone has it
    """

    prototype: int
    solid: bool
    shape: Any


@dataclass(frozen=True, slots=True)
class Division:
    """The pieces of each of several shapes; (n, 4, 4) where all of them stand; the distinct shapes of the pieces."""

    pieces: list[list[Piece]]
    places: Floats
    prototypes: Prototypes


class PartShapes(Protocol):
    """Shapes of one kind."""

    def is_null(self, shape: Any) -> bool:
        """Whether it has no geometry at all."""

    def underlying(self, shape: Any) -> Hashable:
        """What instances of it have in common, however they are placed and oriented: colours are kept by this."""

    def orientation(self, shape: Any) -> Hashable:
        """Whether it is turned inside out."""

    def place(self, shape: Any) -> MatrixRows:
        """Its placement."""

    def unplaced(self, shape: Any) -> Any:
        """The shape without its placement."""

    def pieces(self, shape: Any) -> list[tuple[Any, bool]]:
        """The solids of an unplaced shape, then all that lies outside solids as one piece; and which are solids."""

    def faces(self, shape: Any) -> list[Hashable]:
        """Its underlying faces, in the order of an explorer."""

    def divided(self, shapes: Sequence[Any]) -> Division:
        """The pieces of shapes; equal ones share a prototype."""


def divided_one_by_one(
    kind: PartShapes, shapes: Sequence[Any], prototypes: Callable[[list[Any]], Prototypes]
) -> Division:
    """The pieces of shapes, each asked for its own. prototypes: makes them of the distinct pieces."""
    numbers: dict[Hashable, int] = {}
    distinct: list[Any] = []
    known: dict[Hashable, list[tuple[Piece, MatrixRows]]] = {}
    pieces, places = [], []

    def name(shape: Any) -> Hashable:
        return kind.underlying(shape), kind.orientation(shape)

    def of(shape: Any, solid: bool) -> tuple[Piece, MatrixRows]:
        number = numbers.setdefault(name(shape), len(distinct))
        if number == len(distinct):
            distinct.append(kind.unplaced(shape))
        return Piece(number, solid, distinct[number]), kind.place(shape)

    for shape in shapes:
        key = name(shape)
        if key not in known:
            known[key] = [of(*piece) for piece in kind.pieces(kind.unplaced(shape))]
        outer = kind.place(shape)
        pieces.append([piece for piece, _ in known[key]])
        places += [compose(outer, inner) for _, inner in known[key]]
    return Division(pieces, matrices4(places), prototypes(distinct))


@cache
def _origin() -> Any:
    """The placement of what has none: made where a shape is asked for without its own."""
    from OCP.TopLoc import TopLoc_Location

    return TopLoc_Location()


class OcctShapes:
    """TopoDS_Shape."""

    def is_null(self, shape: Any) -> bool:
        """As of `PartShapes`."""
        return shape is None or bool(shape.IsNull())

    def underlying(self, shape: Any) -> Hashable:
        """As of `PartShapes`."""
        found: Hashable = shape.TShape()
        return found

    def orientation(self, shape: Any) -> Hashable:
        """As of `PartShapes`."""
        found: Hashable = shape.Orientation()
        return found

    def place(self, shape: Any) -> MatrixRows:
        """As of `PartShapes`."""
        from hlr.source.cad.shapes import location_matrix

        return location_matrix(shape.Location())

    def unplaced(self, shape: Any) -> Any:
        """As of `PartShapes`."""
        return shape.Located(_origin(), False)

    def pieces(self, shape: Any) -> list[tuple[Any, bool]]:
        """As of `PartShapes`."""
        from OCP.TopAbs import TopAbs_ShapeEnum as Kind

        from hlr.source.cad.shapes import make_compound, sub_shapes

        if shape.ShapeType() in (Kind.TopAbs_SOLID, Kind.TopAbs_SHELL, Kind.TopAbs_FACE):
            return [(shape, shape.ShapeType() == Kind.TopAbs_SOLID)]
        solids = sub_shapes(shape, Kind.TopAbs_SOLID)
        shells = sub_shapes(shape, Kind.TopAbs_SHELL, Kind.TopAbs_SOLID)
        faces = sub_shapes(shape, Kind.TopAbs_FACE, Kind.TopAbs_SHELL)
        edges = sub_shapes(shape, Kind.TopAbs_EDGE, Kind.TopAbs_FACE)
        loose = shells + faces + edges
        found = [(solid, True) for solid in solids]
        return [*found, (make_compound(loose) if solids else shape, False)] if loose else found

    def faces(self, shape: Any) -> list[Hashable]:
        """As of `PartShapes`."""
        from OCP.TopAbs import TopAbs_ShapeEnum as Kind

        from hlr.source.cad.shapes import sub_shapes

        return [face.TShape() for face in sub_shapes(shape, Kind.TopAbs_FACE)]

    def divided(self, shapes: Sequence[Any]) -> Division:
        """As of `PartShapes`."""
        return divided_one_by_one(self, shapes, LivePrototypes)


class LiveShapes(OcctShapes):
    """Shapes of a caller, without colours of their own: the kernel divides them, in one call.

    A walk through OpenCASCADE's bindings takes longer than some steps of a drawing.
    """

    def divided(self, shapes: Sequence[Any]) -> Division:
        """As of `PartShapes`."""
        found = divided_by_kernel(shapes)
        if found is None:
            return super().divided(shapes)
        model, (pieces, places) = found
        of = [[Piece(part, solid, None) for part, solid in each] for each in pieces]
        prototypes = DividedPrototypes(model, lambda: OcctShapes.divided(self, shapes).prototypes.shapes)
        return Division(of, places, prototypes)
