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

from hlr.source.bindings import collection
from hlr.source.model import Floats, Ints
from hlr.source.tables import FACE, Tables, ranges

EXCESS = 4.0
"""How many deflections a chord may be off before its face is meshed again. Sound faces stay below 2 (measured over some
3,000 faces of real models), the others lie far beyond."""


FINE = 2.0
"""How many deflections a chord may be off before its face is refined in place, which costs little."""


def heights(points: Floats, normals: Floats, p: Ints, q: Ints) -> Floats:
    """Height of the surface above the chords from nodes p to nodes q; 0 where neither end has a normal.

    At a node without one (an apex, a pole) the other end's speaks for both, as on a circle: c . n / 4. A generator that
    ends in the apex of a cone is exact by that, and an arc that ends in the pole of a sphere has its height.
    """
    chord = points[p] - points[q]
    one, other = ((chord * normals[i]).sum(axis=1) for i in (p, q))
    bare, empty = (~normals[i].any(axis=1) for i in (p, q))
    result: Floats = np.abs(np.where(bare, -other, one) - np.where(empty, -one, other)) / 8.0
    return result


def coarse_faces(tables: Tables, deflection: float, excess: float = EXCESS) -> Ints:
    """Numbers, among the faces of `tables`, of those with a chord more than `excess` deflections high."""
    counts = np.diff(tables.tri_start)
    owner = np.repeat(np.arange(len(counts), dtype=np.int32), counts)
    corner = tables.triangles + tables.node_start[owner][:, None]
    normals = tables.normals.astype(np.float64)
    normals[_poles(tables)] = 0.0
    limit = excess * deflection
    coarse = _worst(tables.nodes, normals, corner, owner, len(counts)) > limit
    if coarse.any():
        # A second look, at these only: readers do not always mark an apex.
        among = coarse[owner]
        corner, owner = corner[among], owner[among]
        normals[_apexes(tables.nodes, normals, corner)] = 0.0
        coarse = _worst(tables.nodes, normals, corner, owner, len(counts)) > limit
    tri = tables.face_tri[tables.kind == FACE]
    return np.flatnonzero((tri >= 0) & np.append(coarse, False)[tri]).astype(np.int32)


def lapped_faces(tables: Tables, deflection: float) -> Ints:
    """Numbers, among the faces of `tables`, of those with a triangle turned against the surface.

    Delabella cuts ears off a border that curves in space but hardly in (u, v): three nodes of a fillet's tangent edge
    make a triangle that lies in the plane beyond it, upside down. Slivers thinner than a fifth of the deflection do
    that everywhere and do no harm.
    """
    counts = np.diff(tables.tri_start)
    owner = np.repeat(np.arange(len(counts), dtype=np.int32), counts)
    corner = tables.triangles + tables.node_start[owner][:, None]
    p, q, r = (tables.nodes[corner[:, k]] for k in range(3))
    normal = np.cross(q - p, r - p)
    outward = sum(tables.normals[corner[:, k]].astype(np.float64) for k in range(3))
    longest = np.maximum.reduce([((a - b) ** 2).sum(axis=1) for a, b in ((p, q), (q, r), (r, p))])
    thick = (normal * normal).sum(axis=1) > (0.2 * deflection) ** 2 * longest
    turned = thick & ((normal * outward).sum(axis=1) < 0.0)
    lapped = np.bincount(owner[turned], minlength=len(counts)) > 0
    tri = tables.face_tri[tables.kind == FACE]
    return np.flatnonzero((tri >= 0) & np.append(lapped, False)[tri]).astype(np.int32)


_SIDES = ((0, 1), (1, 2), (2, 0))


def _worst(points: Floats, normals: Floats, corner: Ints, owner: Ints, count: int) -> Floats:
    """The highest chord of every triangulation."""
    worst = np.zeros(count)
    first = np.flatnonzero(np.diff(owner, prepend=-1))  # the triangles of one stand together
    if len(first):
        high = [heights(points, normals, corner[:, a], corner[:, b]) for a, b in _SIDES]
        worst[owner[first]] = np.maximum.reduceat(np.max(high, axis=0), first)
    return worst


def _apexes(points: Floats, normals: Floats, corner: Ints) -> Ints:
    """Nodes whose normal all chords are oblique to, though they are tangent to the surface at their other ends."""
    here, there = np.zeros(len(points)), np.zeros(len(points))
    for a, b in (*_SIDES, *((b, a) for a, b in _SIDES)):
        p, q = corner[:, a], corner[:, b]
        chord = points[p] - points[q]
        here += np.bincount(p, np.abs((chord * normals[p]).sum(axis=1)), len(points))
        there += np.bincount(p, np.abs((chord * normals[q]).sum(axis=1)), len(points))
    # On a circle both are equal; where curvature grows along the chord from nothing, one is half the other.
    return np.flatnonzero(there < 0.2 * here).astype(np.int32)


def _poles(tables: Tables) -> Ints:
    """Nodes on degenerated edges: OpenCASCADE invents a normal for an apex."""
    rep = np.flatnonzero(tables.degenerated[tables.rep_edge])
    poly = tables.rep_poly[rep]
    counts = tables.poly_start[poly + 1] - tables.poly_start[poly]
    nodes = tables.poly_nodes[ranges(tables.poly_start[poly], counts)]
    result: Ints = nodes + np.repeat(tables.node_start[tables.rep_tri[rep]], counts)
    return result


def edge_pairs(tables: Tables, triangulation: int) -> Ints:
    """(n, 2) neighbouring nodes in the polygons of edges on a triangulation, counted from its first node."""
    rep = np.flatnonzero(tables.rep_tri == triangulation)
    poly = np.concatenate((tables.rep_poly[rep], tables.rep_poly2[rep]))
    poly = poly[poly >= 0]
    counts = np.maximum(tables.poly_start[poly + 1] - tables.poly_start[poly] - 1, 0)
    first = ranges(tables.poly_start[poly], counts)
    return np.stack((tables.poly_nodes[first], tables.poly_nodes[first + 1]), axis=1)


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

    builder, tool = BRep_Builder(), ShapeFix_ShapeTolerance()
    restore = []
    for kind, cast, update in (
        (Kind.TopAbs_VERTEX, TopoDS.Vertex, builder.UpdateVertex),
        (Kind.TopAbs_EDGE, TopoDS.Edge, builder.UpdateEdge),
    ):
        found = collection("shape_map")
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
