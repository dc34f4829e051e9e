"""Solids of faces that close a body, as surface models and IGES files have them, and of solids turned inside out."""

from __future__ import annotations

from typing import Any

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
    shells = [TopoDS.Shell(shell) for shell in sub_shapes(sewn, Kind.TopAbs_SHELL)]
    if not all(shell.Closed() for shell in shells):
        return []
    # A whole sphere or torus is one face, which sewing puts into no shell.
    shells += map(_shell_of, sub_shapes(sewn, Kind.TopAbs_FACE, Kind.TopAbs_SHELL))
    solids = [BRepBuilderAPI_MakeSolid(shell).Solid() for shell in shells]
    return [solid.Reversed() if is_inside_out(solid) else solid for solid in solids]


def _shell_of(face: Any) -> Any:
    """A closed shell of one face."""
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Shell

    shell, builder = TopoDS_Shell(), BRep_Builder()
    builder.MakeShell(shell)
    builder.Add(shell, face)
    shell.Closed(True)
    return shell
