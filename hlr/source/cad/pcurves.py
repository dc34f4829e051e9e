"""The outline of a face in (u, v), mended: curves moved by whole periods until they make closed loops."""

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
    """An edge as a wire runs through it: its curve in (u, v), where that begins and ends, how far it is to be moved."""

    edge: Any
    backward: bool
    curve: Any
    ends: Floats
    vertices: tuple[Any, Any]
    move: Floats


def close_loops(face: Any) -> None:
    """Move the curves in (u, v) of the edges of a TopoDS_Face, which lies forward, so that they follow one another.

    The curves are replaced: the face and its edges must be nobody else's.
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
            use.move = _whole(before.ends[1] + before.move - use.ends[0], period)
        if loop:
            # All together to where the surface begins.
            least = np.min([use.ends + use.move for use in loop], axis=(0, 1))
            corner = np.where(np.isfinite(period), [low_u, low_v], least)
            back = _whole(corner - least, period, down=True)
            for use in loop:
                use.move = use.move + back
        uses += loop
    _move(uses, face)


def periods(face: Any) -> tuple[float, float]:
    """After how much u and v the surface of a TopoDS_Face comes back to itself; infinite where it does not."""
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
    """Replace the curves in (u, v) of all edges that have a curve in space by the projection of that."""
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


def _whole(offset: Floats, period: Floats, down: bool = False) -> Floats:
    """The whole periods nearest to an offset, or those that reach at least that far: (2,)."""
    with np.errstate(invalid="ignore"):
        turns = offset / period
        whole = (np.ceil(turns - 1e-6) if down else np.round(turns)) * period
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
            raise ValueError("an edge has no curve in (u, v) of its face")  # asked for a point, it would crash
        values = [curve.Value(t) for t in (curve.FirstParameter(), curve.LastParameter())]
        ends = np.array([(p.X(), p.Y()) for p in (reversed(values) if backward else values)])
        vertices = (TopExp.FirstVertex_s(edge, True), TopExp.LastVertex_s(edge, True))
        found.append(_Use(edge, backward, curve.Curve(), ends, vertices, np.zeros(2)))
    return found


def _in_order(uses: list[_Use], period: Floats) -> list[_Use]:
    """The uses, each after one that ends in its first vertex: where several do, the one that is nearest in (u, v)."""
    if not uses:
        return []
    loop, left = [uses[0]], uses[1:]
    while left:
        last = loop[-1]

        def distance(use: _Use, last: _Use = last) -> tuple[bool, float]:
            gap = last.ends[1] - use.ends[0]
            gap = gap - _whole(gap, period)
            same = use.edge.TShape() == last.edge.TShape()
            return same or not use.vertices[0].IsSame(last.vertices[1]), float(np.hypot(*gap))

        best = min(range(len(left)), key=lambda i: distance(left[i]))
        loop.append(left.pop(best))
    return loop


def _move(uses: list[_Use], face: Any) -> None:
    from OCP.BRep import BRep_Builder, BRep_Tool
    from OCP.gp import gp_Vec2d

    builder = BRep_Builder()
    by_edge: dict[Any, list[_Use]] = {}
    for use in uses:
        by_edge.setdefault(use.edge.TShape(), []).append(use)
    for group in by_edge.values():
        if not any(use.move.any() for use in group):
            continue
        curves = []
        for use in sorted(group, key=lambda use: use.backward):
            curve = use.curve.Copy()
            curve.Translate(gp_Vec2d(*use.move.tolist()))
            curves.append(curve)
        edge = group[0].edge
        builder.UpdateEdge(edge, *curves[:2], face, BRep_Tool.Tolerance_s(edge))
