"""Whether OpenCASCADE kept the chord error it was asked for.

Delabella now and then joins far-apart nodes of a curved face by long slivers, tens of deflections off the surface. The
surface normals at the nodes tell:

    ::

         n1 \\      / n2        chord c between nodes with normals n1, n2:
             \\____/            its height above the surface is about c . (n2 - n1) / 8
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from hlr.source.model import Ints
from hlr.source.tables import FACE, Tables

EXCESS = 4.0
"""How many deflections a chord may be off before its face is meshed again. Sound faces stay below 2 (measured over some
3,000 faces of real models), the others lie far beyond."""


def coarse_faces(tables: Tables, deflection: float) -> Ints:
    """Numbers, among the faces of `tables`, of those with a chord far beyond the deflection."""
    counts = np.diff(tables.tri_start)
    owner = np.repeat(np.arange(len(counts)), counts)
    corner = tables.triangles + tables.node_start[owner][:, None]
    worst = np.zeros(len(counts))
    for a, b in ((0, 1), (1, 2), (2, 0)):
        p, q = corner[:, a], corner[:, b]
        chord = tables.nodes[p] - tables.nodes[q]
        turn = tables.normals[p] - tables.normals[q]
        # Nodes without a normal (poles, planar faces) say nothing.
        known = tables.normals[p].any(axis=1) & tables.normals[q].any(axis=1)
        height = np.abs((chord * turn).sum(axis=1)) / 8.0
        np.maximum.at(worst, owner[known], height[known])
    face = np.flatnonzero(tables.kind == FACE)
    tri = tables.face_tri[face]
    coarse = (tri >= 0) & (worst[np.maximum(tri, 0)] > EXCESS * deflection)
    return np.flatnonzero(coarse).astype(np.int32)


@contextmanager
def tightened(faces: list[Any]) -> Iterator[list[Any]]:
    """The faces with the least tolerance that OpenCASCADE knows, for as long as this lasts.

    The mesher refines nothing below the tolerance of a face's vertices, and sewn faces have generous ones.
    """
    from OCP.BRep import BRep_Builder, BRep_Tool
    from OCP.Precision import Precision
    from OCP.ShapeFix import ShapeFix_ShapeTolerance
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopExp import TopExp
    from OCP.TopoDS import TopoDS
    from OCP.TopTools import TopTools_IndexedMapOfShape

    builder, tool = BRep_Builder(), ShapeFix_ShapeTolerance()
    restore = []
    for kind, cast, update in (
        (Kind.TopAbs_VERTEX, TopoDS.Vertex_s, builder.UpdateVertex),
        (Kind.TopAbs_EDGE, TopoDS.Edge_s, builder.UpdateEdge),
    ):
        found = TopTools_IndexedMapOfShape()
        for face in faces:
            TopExp.MapShapes_s(face, kind, found)
        for i in range(1, found.Extent() + 1):
            shape = cast(found.FindKey(i))
            restore.append((update, shape, BRep_Tool.Tolerance_s(shape)))
    for face in faces:
        tool.SetTolerance(face, Precision.Confusion_s())
    try:
        yield faces
    finally:
        for update, shape, tolerance in restore:
            # Updating only ever raises a tolerance: this brings back what was there.
            update(shape, tolerance)
