"""Faces that OpenCASCADE's mesher leaves empty, or fills wrongly: meshed on a copy with a mended outline.

Most of them have sound curves and surfaces, but the curves of their edges in (u, v) do not make a closed outline: one
lies a whole period beside the others, or is not the edge's at all. What is tried, the cheap first:

1. the same curves in (u, v), each moved by whole periods to where the one before it ends;
2. curves in (u, v) found anew, from the edges in space;
3. OpenCASCADE's own repair of a face.

A copy counts only where its triangles fill its outline, in (u, v) and in space, and every edge of the face is on it.
Then the face gets the copy's triangles. Nothing else of the caller's shape is touched.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import Any

import numpy as np

from hlr.source.dump import DumpError, read_dump
from hlr.source.filled import unfilled
from hlr.source.mesher import run_mesher
from hlr.source.outlines import chained, periods, projected_anew
from hlr.source.parts import compound, explored
from hlr.source.refine import evaluated

LEAST_AREA, MOST_AREA = 0.75, 1.05
"""Triangles' area over that of the surface above them: chords of half a radian take away two hundredths."""

Copied = tuple[Any, Callable[[Any], Any]]
"""A face, and which edge of it stands for an edge of the original."""


def rescue(face: Any, deflection: float, angle: float) -> bool:
    """Give a TopoDS_Face a triangulation from a mended copy of it; whether one could be had."""
    from OCP.TopLoc import TopLoc_Location
    from OCP.TopoDS import TopoDS

    # The triangulation lies in the frame of the face before its placement.
    here = TopoDS.Face(face.Located(TopLoc_Location(), False))
    for copied in _copies(here):
        with suppress(Exception):  # OpenCASCADE's exceptions derive from Exception alone; the next way is tried
            copy, counterpart = copied()
            run_mesher(copy, deflection, angle, delabella=False)
            if _sound(copy, deflection) and _taken_over(here, copy, counterpart):
                return True
    return False


def _copies(face: Any) -> Iterator[Callable[[], Copied]]:
    def copied() -> Copied:
        from OCP.BRepBuilderAPI import BRepBuilderAPI_Copy
        from OCP.TopAbs import TopAbs_Orientation
        from OCP.TopoDS import TopoDS

        forward = face.Oriented(TopAbs_Orientation.TopAbs_FORWARD)
        copier = BRepBuilderAPI_Copy(forward, True, False)
        return TopoDS.Face(copier.Shape()), copier.ModifiedShape

    def same_curves() -> Copied:
        copy, counterpart = copied()
        chained(copy)
        return copy, counterpart

    def new_curves() -> Copied:
        copy, counterpart = copied()
        projected_anew(copy)
        chained(copy)
        return copy, counterpart

    def repaired() -> Copied:
        from OCP.ShapeFix import ShapeFix_Face
        from OCP.TopoDS import TopoDS

        copy, counterpart = copied()
        fixer = ShapeFix_Face(copy)
        fixer.Perform()
        context = fixer.Context()
        return TopoDS.Face(fixer.Result()), lambda edge: context.Apply(counterpart(edge))

    yield same_curves
    yield new_curves
    yield repaired


def _sound(face: Any, deflection: float) -> bool:
    """Whether a face's triangles fill its outline, and lie on its surface."""
    from OCP.BRepAdaptor import BRepAdaptor_Surface

    try:
        tables = read_dump(compound([compound([]), face]))
    except DumpError:
        from hlr.source.walk import walk

        tables = walk(compound([compound([]), face]))
    if len(tables.tri_start) != 2 or len(unfilled(tables, deflection, np.array([periods(face)]))):
        return False
    p, q, r = (tables.nodes[tables.triangles[:, k]] for k in range(3))
    area = 0.5 * np.sqrt((np.cross(q - p, r - p) ** 2).sum(axis=1)).sum()
    a, b, c = (tables.uv[tables.triangles[:, k]] for k in range(3))
    _, along, across = evaluated(BRepAdaptor_Surface(face, False), (a + b + c) / 3.0)
    spread = np.sqrt((np.cross(along, across) ** 2).sum(axis=1))
    below = 0.5 * np.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    exact = (spread * below).sum()
    return bool(exact > 0.0 and LEAST_AREA < area / exact < MOST_AREA)


def _taken_over(face: Any, copy: Any, counterpart: Callable[[Any], Any]) -> bool:
    """Move the triangulation of the copy, and the polygons of its edges, to the face; unless an edge has no polygon."""
    from OCP.BRep import BRep_Builder, BRep_Tool
    from OCP.BRepTools import BRepTools
    from OCP.TopAbs import TopAbs_Orientation
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopLoc import TopLoc_Location
    from OCP.TopoDS import TopoDS

    place = TopLoc_Location()
    triangulation = BRep_Tool.Triangulation_s(copy, place)
    found = []
    for shape in explored(face, Kind.TopAbs_EDGE):
        edge = TopoDS.Edge(shape)
        twin = TopoDS.Edge(counterpart(edge))
        one, two = (
            BRep_Tool.PolygonOnTriangulation_s(TopoDS.Edge(twin.Oriented(way)), triangulation, place)
            for way in (TopAbs_Orientation.TopAbs_FORWARD, TopAbs_Orientation.TopAbs_REVERSED)
        )
        if one is None or BRep_Tool.Degenerated_s(twin) != BRep_Tool.Degenerated_s(edge):
            return False
        found.append((edge, one, two if BRep_Tool.IsClosed_s(twin, triangulation, place) else None))
    builder = BRep_Builder()
    BRepTools.Clean_s(face)
    builder.UpdateFace(face, triangulation)
    for edge, one, two in found:
        if two is None:
            builder.UpdateEdge(edge, one, triangulation)
        else:
            builder.UpdateEdge(edge, one, two, triangulation)
    return True
