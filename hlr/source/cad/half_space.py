"""Shapes cut by planes, by OpenCASCADE: what lies on one side is taken away, and solids are closed there.

It cuts what the kernel does not (`hlr.source.cad.kernel_cut`): open surfaces, by planes that step, hard cases."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np

from hlr.common.types import Floats
from hlr.errors import SourceError
from hlr.source.cad.cut_check import CutCheck, has_surfaces
from hlr.source.cad.flat_faces import flat_heights
from hlr.source.cad.occt_collections import new_collection
from hlr.source.cad.part_shapes import OcctShapes
from hlr.source.cad.parts import Leaf
from hlr.source.cad.shape_measures import ShapeMeasures
from hlr.source.cad.shapes import make_compound, sub_shapes
from hlr.source.stepped import Stepped

NEAR = 1e-9
"""Of the size of a shape: a plane that comes no deeper into it than this only touches it."""

LOOSER = (1e-8, 1e-7, 1e-6)
"""Of the size of a shape: how much looser it is cut again where it was not cut as it should."""


class UncuttableError(SourceError):
    """A shape that cannot be cut. why, cure: what its message says."""

    def __init__(self, name: str, why: str, cure: str) -> None:
        super().__init__(
            f'"{name}" cannot be cut by the plane of a section, because {why}: {cure}, or leave the part out.'
        )
        self.why, self.cure = why, cure

    def of(self, name: str) -> UncuttableError:
        """The same of another part of this shape."""
        return UncuttableError(name, self.why, self.cure)


def bare_error(name: str) -> UncuttableError:
    """That of a part whose faces are triangles alone."""
    return UncuttableError(name, "its faces are triangles without surfaces", "export it as a solid or as a mesh")


def cut_away(leaves: Sequence[Leaf], origin: Floats, normal: Floats) -> list[Leaf]:
    """The leaves without what lies on the side of a plane to which its normal points.

    Leaves that lie there wholly are left out.

    leaves: shapes of OpenCASCADE, which stay as they are; origin, normal (3,). Cut shapes have no colours of faces.

    Raises:
        UncuttableError: OpenCASCADE cannot cut one of them.
    """
    normal = normal / float(np.linalg.norm(normal))
    along, _ = _across(_axes(origin, normal))
    return cut_at(leaves, Stepped(normal, along, np.array([origin @ normal]), np.zeros(0)), origin)


def cut_at(leaves: Sequence[Leaf], planes: Stepped, origin: Floats) -> list[Leaf]:
    """The same, by planes that may step. origin (3,): a point on the first of them."""
    found = []
    for leaf in leaves:
        whole = (piece for piece, _ in OcctShapes().pieces(leaf.shape))
        pieces = [left for piece in whole for left in _cut_pieces(piece, planes, origin, leaf.name)]
        if pieces:
            shape = pieces[0] if len(pieces) == 1 else make_compound(pieces)
            found.append(Leaf(shape, leaf.name, leaf.color, opacity=leaf.opacity, above=leaf.above))
    return found


def put_on_faces(planes: Stepped, shape: Any, near: float) -> Stepped:
    """The planes, each put on the nearest flat face of a shape that it would run beside, no farther off than `near`.

    A film would be left between the two, too thin to be told from either.
    """
    heights = flat_heights(shape, planes.normal)
    if not len(heights):
        return planes
    nearest = heights[np.abs(heights - planes.levels[:, None]).argmin(axis=1)]
    return replace(planes, levels=np.where(np.abs(planes.levels - nearest) <= near, nearest, planes.levels))


def _cut_pieces(shape: Any, planes: Stepped, origin: Floats, name: str) -> list[Any]:
    """What is left of a shape. Faces outside solids that cannot be cut together are cut by shells, or each alone."""
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    try:
        left = _cut(shape, planes, origin, name)
        return [] if left is None else [left]
    except UncuttableError:
        if shape.ShapeType() in (Kind.TopAbs_SOLID, Kind.TopAbs_FACE, Kind.TopAbs_EDGE):
            raise
    shells = [] if shape.ShapeType() == Kind.TopAbs_SHELL else sub_shapes(shape, Kind.TopAbs_SHELL)
    faces = sub_shapes(shape, Kind.TopAbs_FACE, Kind.TopAbs_SHELL if shells else None)
    edges = sub_shapes(shape, Kind.TopAbs_EDGE, Kind.TopAbs_FACE)
    return [left for part in (*shells, *faces, *edges) for left in _cut_pieces(part, planes, origin, name)]


def _cut(shape: Any, planes: Stepped, origin: Floats, name: str) -> Any | None:
    """A shape without what lies beyond the planes; None where that is all of it."""
    box = _box(shape, origin, planes.normal)
    if box is None:
        return None
    size = float(np.linalg.norm(box[1] - box[0]))
    low, high = box[:, 2]
    lowest, highest = float(planes.levels.min() - planes.levels[0]), float(planes.levels.max() - planes.levels[0])
    if high <= lowest + NEAR * size:
        return shape
    if low >= highest - NEAR * size:
        return None
    if not has_surfaces(shape):
        raise bare_error(name)
    check = CutCheck(shape, planes, size)
    left = _cut_by_block(shape, _before(planes, origin, box, size), check, size)
    if left is _FAILED and not len(planes.steps):
        left = _cut_by_half_space(shape, _half_space(origin, planes.normal, 2.0 * size), check)
    if left is _FAILED:
        raise UncuttableError(name, "its shape is not sound", "move the plane a little")
    return left


def _cut_by_block(shape: Any, block: Any, check: CutCheck, size: float) -> Any | None:
    """The shape minus a block: the first cut that is sound, else the tightest that is cut as it should; or `_FAILED`.

    size: of the shape
    """
    found: list[Any | None] = []
    for share in (0.0, *LOOSER):
        left = _without(shape, block, share * size)
        if left is _FAILED or not check.is_cut(left, left is shape):
            continue
        if check.is_sound(left):
            return left
        found.append(left)
    return found[0] if found else _FAILED


def _cut_by_half_space(shape: Any, half_space: Any, check: CutCheck) -> Any | None:
    """The shape minus all that lies beyond a plane, if that leaves a piece of it; else `_FAILED`."""
    left = _without(shape, half_space, 0.0)
    is_piece = left is not _FAILED and check.is_cut(left, left is shape) and check.is_piece(left)
    return left if is_piece else _FAILED


def _box(shape: Any, origin: Floats, normal: Floats) -> Floats | None:
    """(2, 3) the lower and the upper corner of a box around a shape, whose third axis goes from the plane along its
    normal, and whose others are those of `_block`; None where it has no geometry."""
    rows = np.array([*_across(_axes(origin, normal)), normal])
    x, y, z = rows.tolist()
    found = ShapeMeasures(shape).extent(x, y, z)
    return None if found is None else found - rows @ origin


def _axes(origin: Floats, normal: Floats) -> Any:
    from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt

    return gp_Ax2(gp_Pnt(*origin.tolist()), gp_Dir(*normal.tolist()))


def _across(axes: Any) -> tuple[Floats, Floats]:
    """The first and the second direction of axes, (3,) each."""
    x, y = (np.array([way.X(), way.Y(), way.Z()]) for way in (axes.XDirection(), axes.YDirection()))
    return x, y


def _before(planes: Stepped, origin: Floats, box: Floats, size: float) -> Any:
    """What lies before the planes, as far as a shape with this box of `_box` reaches; size: of the shape."""
    middle = 0.5 * (box[0] + box[1])
    if len(planes.steps):
        return _prism(planes, origin, middle, size)
    return _block(origin, planes.normal, middle, 2.0 * size)


def _block(origin: Floats, normal: Floats, middle: Floats, size: float) -> Any:
    """A box that stands on the plane, 2 `size` wide and `size` high, over the middle (3,) of a box of `_box`."""
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox
    from OCP.gp import gp_Pnt

    axes = _axes(origin, normal)
    x, y = _across(axes)
    corner = origin + (middle[0] - size) * x + (middle[1] - size) * y
    axes.SetLocation(gp_Pnt(*corner.tolist()))
    return BRepPrimAPI_MakeBox(axes, 2.0 * size, 2.0 * size, size).Shape()


def _prism(planes: Stepped, origin: Floats, middle: Floats, size: float) -> Any:
    """What lies before planes that step, as far as a shape with this box of `_box` reaches."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakePolygon
    from OCP.BRepPrimAPI import BRepPrimAPI_MakePrism
    from OCP.gp import gp_Pnt, gp_Vec

    axes = _axes(origin, planes.normal)
    x, y = _across(axes)
    centre = origin + middle[0] * x + middle[1] * y + middle[2] * planes.normal
    across = np.cross(planes.normal, planes.along)
    begin, end = (float(centre @ planes.along) + sense * 2.0 * size for sense in (-1.0, 1.0))
    top = max(float(centre @ planes.normal), float(planes.levels.max())) + 2.0 * size
    between = np.flatnonzero((planes.steps > begin) & (planes.steps < end))
    first = int(np.searchsorted(planes.steps, begin))
    profile = [(begin, planes.levels[first])]
    for k in between.tolist():
        profile += [(planes.steps[k], planes.levels[k]), (planes.steps[k], planes.levels[k + 1])]
    profile += [(end, profile[-1][1]), (end, top), (begin, top)]
    polygon = BRepBuilderAPI_MakePolygon()
    for at, level in profile:
        corner = at * planes.along + level * planes.normal + (float(centre @ across) - 2.0 * size) * across
        polygon.Add(gp_Pnt(*corner.tolist()))
    polygon.Close()
    face = BRepBuilderAPI_MakeFace(polygon.Wire(), True).Face()
    return BRepPrimAPI_MakePrism(face, gp_Vec(*(4.0 * size * across).tolist())).Shape()


def _half_space(origin: Floats, normal: Floats, size: float) -> Any:
    """All that lies beyond the plane: it cuts a few shapes that `_block` does not. size: half of its face's width."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeHalfSpace
    from OCP.gp import gp_Ax3, gp_Pln, gp_Pnt

    plane = gp_Pln(gp_Ax3(_axes(origin, normal)))
    face = BRepBuilderAPI_MakeFace(plane, -size, size, -size, size).Face()
    return BRepPrimAPI_MakeHalfSpace(face, gp_Pnt(*(origin + normal).tolist())).Solid()


_FAILED = object()
"""What is left where OpenCASCADE finds no answer."""


def _without(shape: Any, tool: Any, near: float) -> Any | None:
    """The shape minus the tool: itself where no face or edge of it is cut or taken away, None where nothing is left.

    near: what lies so close together counts as one, besides the tolerances of the shape
    """
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    cut = BRepAlgoAPI_Cut()
    for setter, one in ((cut.SetArguments, shape), (cut.SetTools, tool)):
        several = new_collection("shapes")
        several.Append(one)
        setter(several)
    cut.SetNonDestructive(True)
    if near > 0.0:
        cut.SetFuzzyValue(near)
    # OpenCASCADE's exceptions derive from Exception alone.
    with suppress(Exception):
        cut.Build()
    if not cut.IsDone():
        return _FAILED
    left = cut.Shape()
    kept = [each for kind in (Kind.TopAbs_FACE, Kind.TopAbs_EDGE) for each in sub_shapes(shape, kind)]
    if not any(cut.IsDeleted(each) or cut.Modified(each).Size() for each in kept):
        return shape
    return left if any(sub_shapes(left, kind) for kind in (Kind.TopAbs_FACE, Kind.TopAbs_EDGE)) else None
