"""Solids of faces that close a body, as surface models and IGES files have them, and of solids turned inside out."""

from __future__ import annotations

from typing import Any

import numpy as np

from hlr.source.cad.shape_measures import is_inside_out

SEWN = 1e-6
"""Of the size of a shape: borders of faces that lie so close to one another are one edge."""


def as_solid(shape: Any, size: float) -> Any:
    """The solid that the faces of a shape close, turned outward; the shape itself where they leave an opening.

    shape: of OpenCASCADE, which stays as it is; size: of it, in its units
    """
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    if shape.ShapeType() == Kind.TopAbs_SOLID:
        return shape.Reversed() if is_inside_out(shape) else shape
    if shape.ShapeType() not in (Kind.TopAbs_SHELL, Kind.TopAbs_COMPOUND, Kind.TopAbs_FACE):
        return shape
    solids = _sewn_solids(shape, SEWN * size)
    if not solids:
        return shape
    from hlr.source.cad.shapes import make_compound

    return solids[0] if len(solids) == 1 else make_compound(solids)


def _sewn_solids(shape: Any, near: float) -> list[Any]:
    """A solid for each shell that the faces make; none where one of them is open."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeSolid, BRepBuilderAPI_Sewing
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopoDS import TopoDS

    from hlr.source.cad.shapes import sub_shapes

    sewing = BRepBuilderAPI_Sewing(near)
    sewing.Add(shape)
    sewing.Perform()
    sewn = sewing.SewedShape()
    if sewn.IsNull() or sewing.NbFreeEdges():
        return []
    shells = [_oriented(TopoDS.Shell(shell)) for shell in sub_shapes(sewn, Kind.TopAbs_SHELL)]
    if not all(shell.Closed() for shell in shells):
        return []
    # A whole sphere or torus is one face, which sewing puts into no shell.
    shells += map(_shell_of, sub_shapes(sewn, Kind.TopAbs_FACE, Kind.TopAbs_SHELL))
    solids = [BRepBuilderAPI_MakeSolid(shell).Solid() for shell in shells]
    solids = [solid.Reversed() if is_inside_out(solid) else solid for solid in solids]
    return _with_cavities(solids, near)


def _with_cavities(solids: list[Any], near: float) -> list[Any]:
    """The same solids, of one shell each, but those that lie within others as their cavities.

    Of several within one another each second one is a cavity of the one around it.
    """
    from OCP.BRep import BRep_Builder
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    from hlr.source.cad.shapes import sub_shapes

    boxes = np.array([_box(solid) for solid in solids])
    around = []
    for i, (own, (low, high)) in enumerate(zip(solids, boxes, strict=True)):
        beyond = (boxes[:, 0] <= low).all(axis=1) & (boxes[:, 1] >= high).all(axis=1)
        around.append([k for k in np.flatnonzero(beyond).tolist() if k != i and _within(own, solids[k], near)])
    builder, found = BRep_Builder(), {}
    for i, solid in enumerate(solids):
        if len(around[i]) % 2 == 0:
            found[i] = solid.EmptyCopied()
            for shell in sub_shapes(solid, Kind.TopAbs_SHELL):
                builder.Add(found[i], shell)
    for i, solid in enumerate(solids):
        if len(around[i]) % 2 == 1:
            nearest = max(around[i], key=lambda k: len(around[k]))
            for shell in sub_shapes(solid, Kind.TopAbs_SHELL):
                builder.Add(found[nearest], shell.Reversed())
    return list(found.values())


def _box(solid: Any) -> list[tuple[float, float, float]]:
    """Its lowest and its highest corner."""
    from OCP.Bnd import Bnd_Box
    from OCP.BRepBndLib import BRepBndLib

    box = Bnd_Box()
    BRepBndLib.Add_s(solid, box)
    return [(corner.X(), corner.Y(), corner.Z()) for corner in (box.CornerMin(), box.CornerMax())]


def _within(inner: Any, outer: Any, near: float) -> bool:
    """Whether a solid lies within another, which it does not cross."""
    from OCP.BRep import BRep_Tool
    from OCP.BRepClass3d import BRepClass3d_SolidClassifier
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopAbs import TopAbs_State
    from OCP.TopoDS import TopoDS

    from hlr.source.cad.shapes import sub_shapes

    vertex = TopoDS.Vertex(sub_shapes(inner, Kind.TopAbs_VERTEX)[0])
    classifier = BRepClass3d_SolidClassifier(outer, BRep_Tool.Pnt_s(vertex), near)
    return bool(classifier.State() == TopAbs_State.TopAbs_IN)


def _oriented(shell: Any) -> Any:
    """The shell with faces that look the same way as their neighbours; sewing leaves some as they were.

    The shell itself where that would divide it.
    """
    if shell.Closed():
        return shell
    from OCP.ShapeFix import ShapeFix_Shell

    fix = ShapeFix_Shell()
    fix.FixFaceOrientation(shell)
    return fix.Shell() if fix.NbShells() == 1 else shell


def _shell_of(face: Any) -> Any:
    """A closed shell of one face."""
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Shell

    shell, builder = TopoDS_Shell(), BRep_Builder()
    builder.MakeShell(shell)
    builder.Add(shell, face)
    shell.Closed(True)
    return shell
