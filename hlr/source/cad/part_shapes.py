"""What is asked of shapes to make parts of them: of OpenCASCADE's, and of those that the kernel has read itself."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from typing import Any, Protocol

from hlr.source.cad.prototypes import LivePrototypes, Prototypes
from hlr.source.transforms import MatrixRows


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

    def prototypes(self, shapes: Sequence[Any]) -> Prototypes:
        """Unplaced shapes as prototypes."""


class OcctShapes:
    """TopoDS_Shape."""

    def __init__(self) -> None:
        from OCP.TopLoc import TopLoc_Location

        self._origin = TopLoc_Location()

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
        return shape.Located(self._origin, False)

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

    def prototypes(self, shapes: Sequence[Any]) -> LivePrototypes:
        """As of `PartShapes`."""
        return LivePrototypes(shapes)
