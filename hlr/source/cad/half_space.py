"""Shapes cut by a plane, by OpenCASCADE: what lies on one side of it is taken away, and solids are closed there."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from typing import Any

import numpy as np

from hlr.common.types import Floats
from hlr.errors import SourceError
from hlr.source.cad.occt_collections import new_collection
from hlr.source.cad.part_shapes import OcctShapes
from hlr.source.cad.parts import Leaf
from hlr.source.cad.shapes import make_compound

NEAR = 1e-9
"""Of the size of a shape: a plane that comes no deeper into it than this only touches it."""


def cut_away(leaves: Sequence[Leaf], origin: Floats, normal: Floats) -> list[Leaf]:
    """The leaves without what lies on the side of a plane to which its normal points.

    Leaves that lie there wholly are left out.

    leaves: shapes of OpenCASCADE, which stay as they are; origin, normal (3,). Cut shapes have no colours of faces.

    Raises:
        SourceError: OpenCASCADE cannot cut one of them.
    """
    normal = normal / float(np.linalg.norm(normal))
    found = []
    for leaf in leaves:
        cut = [_cut(piece, origin, normal, leaf.name) for piece, _ in OcctShapes().pieces(leaf.shape)]
        pieces = [piece for piece in cut if piece is not None]
        if pieces:
            shape = pieces[0] if len(pieces) == 1 else make_compound(pieces)
            found.append(Leaf(shape, leaf.name, leaf.color, opacity=leaf.opacity, above=leaf.above))
    return found


def _cut(shape: Any, origin: Floats, normal: Floats, name: str) -> Any | None:
    """A shape without what lies beyond the plane; None where that is all of it."""
    corners = _corners(shape)
    if corners is None:
        return None
    size = float(np.linalg.norm(corners.max(axis=0) - corners.min(axis=0)))
    heights, near = (corners - origin) @ normal, NEAR * size
    if heights.max() <= near:
        return shape
    if heights.min() >= -near:
        return None
    middle = 0.5 * (corners.min(axis=0) + corners.max(axis=0))
    foot = middle - float((middle - origin) @ normal) * normal
    return _without(shape, _block(foot, normal, 2.0 * size), name)


def _corners(shape: Any) -> Floats | None:
    """(8, 3) the corners of a box around a shape; None where it has no geometry."""
    from OCP.Bnd import Bnd_Box
    from OCP.BRepBndLib import BRepBndLib

    box = Bnd_Box()
    BRepBndLib.AddOptimal_s(shape, box, False, False)
    if box.IsVoid():  # of some shapes that are not sound it finds no extent
        BRepBndLib.Add_s(shape, box, False)
    if box.IsVoid():
        return None
    x0, y0, z0, x1, y1, z1 = box.Get()
    return np.array([(x, y, z) for x in (x0, x1) for y in (y0, y1) for z in (z0, z1)])


def _block(foot: Floats, normal: Floats, size: float) -> Any:
    """A box that stands on the plane, its middle over `foot`, 2 `size` wide and `size` high."""
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox
    from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt

    axes = gp_Ax2(gp_Pnt(*foot.tolist()), gp_Dir(*normal.tolist()))
    x, y = (np.array([way.X(), way.Y(), way.Z()]) for way in (axes.XDirection(), axes.YDirection()))
    axes.SetLocation(gp_Pnt(*(foot - size * x - size * y).tolist()))
    return BRepPrimAPI_MakeBox(axes, 2.0 * size, 2.0 * size, size).Shape()


def _without(shape: Any, block: Any, name: str) -> Any | None:
    """The shape minus the block; None where nothing is left."""
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    from hlr.source.cad.shapes import sub_shapes

    cut = BRepAlgoAPI_Cut()
    for setter, one in ((cut.SetArguments, shape), (cut.SetTools, block)):
        several = new_collection("shapes")
        several.Append(one)
        setter(several)
    cut.SetNonDestructive(True)
    # OpenCASCADE's exceptions derive from Exception alone.
    with suppress(Exception):
        cut.Build()
    if not cut.IsDone():
        raise SourceError(f'"{name}" cannot be cut by the plane of a section: its shape is not sound.')
    left = cut.Shape()
    return left if any(sub_shapes(left, kind) for kind in (Kind.TopAbs_FACE, Kind.TopAbs_EDGE)) else None
