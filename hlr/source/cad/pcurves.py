"""Repair of pcurves (the curves of a face's edges in (u, v)), so that each wire is a closed loop."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from hlr.common.types import Floats
from hlr.source.cad.shapes import sub_shapes


@dataclass(slots=True)
class _Use:
    """A use of an edge by a wire: its pcurve, the start and end of that (2, 2) in (u, v), and its shift (2,)."""

    edge: Any
    backward: bool
    curve: Any
    ends: Floats
    vertices: tuple[Any, Any]
    shift: Floats


def close_loops(face: Any) -> None:
    """Move the pcurves of a forward TopoDS_Face by whole periods, so that each begins where the one before it ends.

    The pcurves are replaced in place: pass a copy of the face that shares no edge with another.
    """
    from OCP.BRep import BRep_Tool
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    low_u, _, low_v, _ = BRep_Tool.Surface_s(face).Bounds()
    period = np.array(periods(face))
    if not np.isfinite(period).any():
        return
    uses = []
    for wire in sub_shapes(face, Kind.TopAbs_WIRE):
        loop = _in_order(_uses(wire, face), period)
        for before, use in pairwise(loop):
            use.shift = _whole_periods(before.ends[1] + before.shift - use.ends[0], period)
        if loop:
            # The whole loop moves to the first period of the surface.
            least = np.min([use.ends + use.shift for use in loop], axis=(0, 1))
            corner = np.where(np.isfinite(period), [low_u, low_v], least)
            back = _whole_periods(corner - least, period, round_up=True)
            for use in loop:
                use.shift = use.shift + back
        uses += loop
    _apply_shifts(uses, face)


def periods(face: Any) -> tuple[float, float]:
    """Periods of the surface of a TopoDS_Face in u and v; infinite where it is not periodic."""
    from OCP.BRep import BRep_Tool
    from OCP.TopLoc import TopLoc_Location

    surface = BRep_Tool.Surface_s(face, TopLoc_Location())
    if surface is None:
        return math.inf, math.inf
    return (
        surface.UPeriod() if surface.IsUPeriodic() else math.inf,
        surface.VPeriod() if surface.IsVPeriodic() else math.inf,
    )


def project_pcurves(face: Any) -> None:
    """Replace each pcurve by the projection of the edge's 3-D curve; degenerated edges have none and stay."""
    from OCP.BRep import BRep_Tool
    from OCP.ShapeBuild import ShapeBuild_Edge
    from OCP.ShapeFix import ShapeFix_Edge
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopoDS import TopoDS

    tool, fixer = ShapeBuild_Edge(), ShapeFix_Edge()
    for shape in sub_shapes(face, Kind.TopAbs_EDGE):
        edge = TopoDS.Edge(shape)
        if BRep_Tool.Degenerated_s(edge):
            continue
        seam = BRep_Tool.IsClosed_s(edge, face)
        tool.RemovePCurve(edge, face)
        fixer.FixAddPCurve(edge, face, seam)


def _whole_periods(offset: Floats, period: Floats, round_up: bool = False) -> Floats:
    """(2,) whole periods nearest to an offset; round_up: the least that reach it."""
    with np.errstate(invalid="ignore"):
        turns = offset / period
        whole = (np.ceil(turns - 1e-6) if round_up else np.round(turns)) * period
    result: Floats = np.where(np.isfinite(period), whole, 0.0)
    return result


def _uses(wire: Any, face: Any) -> list[_Use]:
    from OCP.BRepAdaptor import BRepAdaptor_Curve2d
    from OCP.TopAbs import TopAbs_Orientation
    from OCP.TopExp import TopExp
    from OCP.TopoDS import TopoDS, TopoDS_Iterator

    found = []
    iterator = TopoDS_Iterator(wire)
    while iterator.More():
        edge = TopoDS.Edge(iterator.Value())
        iterator.Next()
        if edge.Orientation() not in (TopAbs_Orientation.TopAbs_FORWARD, TopAbs_Orientation.TopAbs_REVERSED):
            continue
        backward = edge.Orientation() == TopAbs_Orientation.TopAbs_REVERSED
        curve = BRepAdaptor_Curve2d(edge, face)
        if curve.Curve() is None:
            raise ValueError("an edge has no curve in (u, v) of its face")  # to evaluate it would crash OpenCASCADE
        values = [curve.Value(t) for t in (curve.FirstParameter(), curve.LastParameter())]
        ends = np.array([(p.X(), p.Y()) for p in (reversed(values) if backward else values)])
        vertices = (TopExp.FirstVertex_s(edge, True), TopExp.LastVertex_s(edge, True))
        found.append(_Use(edge, backward, curve.Curve(), ends, vertices, np.zeros(2)))
    return found


def _in_order(uses: list[_Use], period: Floats) -> list[_Use]:
    """The uses in order around the wire: each begins in the vertex where the one before it ends.

    Where several do, the nearest in (u, v) comes next.
    """
    if not uses:
        return []
    loop, left = [uses[0]], uses[1:]
    while left:
        last = loop[-1]

        def distance(use: _Use, last: _Use = last) -> tuple[bool, float]:
            gap = last.ends[1] - use.ends[0]
            gap = gap - _whole_periods(gap, period)
            same = use.edge.TShape() == last.edge.TShape()
            return same or not use.vertices[0].IsSame(last.vertices[1]), float(np.hypot(*gap))

        best = min(range(len(left)), key=lambda i: distance(left[i]))
        loop.append(left.pop(best))
    return loop


def _apply_shifts(uses: list[_Use], face: Any) -> None:
    from OCP.BRep import BRep_Builder, BRep_Tool
    from OCP.gp import gp_Vec2d

    builder = BRep_Builder()
    by_edge: dict[Any, list[_Use]] = {}
    for use in uses:
        by_edge.setdefault(use.edge.TShape(), []).append(use)
    for group in by_edge.values():
        if not any(use.shift.any() for use in group):
            continue
        curves = []
        for use in sorted(group, key=lambda use: use.backward):
            curve = use.curve.Copy()
            curve.Translate(gp_Vec2d(*use.shift.tolist()))
            curves.append(curve)
        edge = group[0].edge
        builder.UpdateEdge(edge, *curves[:2], face, BRep_Tool.Tolerance_s(edge))
