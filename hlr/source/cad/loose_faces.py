"""Faces outside solids that a STEP file lists as products without a name: pieces of one surface, and no parts."""

from __future__ import annotations

from collections.abc import Sequence

from hlr.common.types import Color
from hlr.source.cad.parts import Leaf
from hlr.source.cad.shapes import make_compound, sub_shapes


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


def as_one(leaves: Sequence[Leaf], name: str, above: tuple[str, ...]) -> Leaf:
    """One leaf of several. Where their colours differ, its faces have them.

    above: names of the assemblies that it is in
    """
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
    return Leaf(whole, name, color, colors, opacity, opacities, above)
