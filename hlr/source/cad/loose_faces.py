"""Faces outside solids that a STEP file lists as products without a name: pieces of one surface, and no parts."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import replace
from typing import Any

from hlr.common.types import Color
from hlr.source.cad.parts import Leaf
from hlr.source.cad.shapes import location_matrix, make_compound, sub_shapes


def is_loose(leaf: Leaf) -> bool:
    """Whether it has faces outside solids that close no body: some edge has a face on one side alone."""
    from OCP.BRep import BRep_Tool
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    if TopExp_Explorer(leaf.shape, Kind.TopAbs_SOLID).More():
        return False
    borders: set[object] = set()
    for face in sub_shapes(leaf.shape, Kind.TopAbs_FACE):
        edges = TopExp_Explorer(face, Kind.TopAbs_EDGE)
        while edges.More():
            if not BRep_Tool.Degenerated_s(TopoDS.Edge(edges.Current())):
                borders ^= {edges.Current().TShape()}
            edges.Next()
    return bool(borders)


class JoinedLeaves:
    """Leaves made one. Those of an assembly that is there several times are the same ones, which are made one once."""

    def __init__(self) -> None:
        self._known: dict[Hashable, Leaf] = {}

    def as_one(self, leaves: Sequence[Leaf], name: str, above: tuple[str, ...], place: Any) -> Leaf:
        """One leaf of several.

        above: names of the assemblies that it is in; place: TopLoc_Location of the innermost, in which leaves are alike
        """
        back = place.Inverted()
        inside = [replace(leaf, shape=leaf.shape.Moved(back, False)) for leaf in leaves]
        key = tuple(_key(leaf) for leaf in inside)
        if key not in self._known:
            self._known[key] = _as_one(inside)
        known = self._known[key]
        return replace(known, shape=known.shape.Moved(place, False), name=name, above=above)


def _key(leaf: Leaf) -> Hashable:
    """What two leaves have in common that are the same. Leaves of one product have one table of colours."""
    shape = leaf.shape
    where = location_matrix(shape.Location())
    return shape.TShape(), shape.Orientation(), where, leaf.color, leaf.opacity, id(leaf.colors)


def _as_one(leaves: Sequence[Leaf]) -> Leaf:
    """One leaf of several, without a name. Where their colours differ, its faces have them."""
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    whole = make_compound([leaf.shape for leaf in leaves])
    looks = {(leaf.color, leaf.opacity) for leaf in leaves}
    colors: dict[object, Color] = {}
    opacities: dict[object, float] = {}
    for leaf in leaves:
        if len(looks) > 1 and leaf.color is not None:
            for face in sub_shapes(leaf.shape, Kind.TopAbs_FACE):
                colors[face.TShape()] = leaf.color
                if leaf.opacity < 1.0:
                    opacities[face.TShape()] = leaf.opacity
        colors |= leaf.colors
        opacities |= leaf.opacities
    color, opacity = looks.pop() if len(looks) == 1 else (None, 1.0)
    return Leaf(whole, "", color, colors, opacity, opacities)
