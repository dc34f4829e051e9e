"""From the tables of a meshed B-rep to conforming part meshes with classified edges, all parts at once.

1. Expand the tree of every part into faces, edges and their uses (`explore`).
2. Lay out one block of nodes per face and join the nodes that faces share (`conform`).
3. Drop the triangles that collapse, and read each edge's polyline off one of its polygons (`edges`).
4. Classify the edges by the faces they bound and by the surface normals on both sides: at their nodes (`edges`), those
   of free-form faces along their whole length (`tangency`), in pieces where that changes.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from hlr.source.conform import edge_polygons, join_nodes
from hlr.source.edges import Laid, classify, edge_lines, in_pieces
from hlr.source.explore import explore
from hlr.source.locations import determinant_sign, moved_each
from hlr.source.model import Floats, Ints
from hlr.source.tables import FACE, Bools, Bytes, Tables, ranges, starts
from hlr.source.tangency import Tangency


@dataclass(slots=True)
class Meshes:
    """Part meshes one after another: part p owns points[point_start[p]:point_start[p+1]] and so on.

    triangles and edge_nodes count from the beginning of all points. edge_index is local to the part.

    Of faces and their parameters: corner (m, 3) counts nodes of faces, into uv (k, 2); node_start per part, as
    point_start; face_shape, face_place and face_reversed per face: number of the underlying face among those with
    `kind` FACE, (3, 4) where it stands in the part, whether its surface's normal points inward.
    """

    point_start: Ints
    points: Floats
    triangle_start: Ints
    triangles: Ints
    triangle_face: Ints
    face_start: Ints
    face_planar: Bools
    edge_start: Ints
    edge_offsets: Ints
    edge_nodes: Ints
    edge_index: Ints
    edge_class: Bytes
    node_start: Ints
    corner: Ints
    uv: Floats
    face_shape: Ints
    face_place: Floats
    face_reversed: Bools


def build(tables: Tables, planar: Bools, judged: Mapping[tuple[int, int], Tangency] | None = None) -> Meshes:
    """All four steps. `planar`: (n,) bool per underlying shape, meaningful for faces.

    judged: by part and index in its edge map, edges of which it is known how their faces meet.
    """
    topo = explore(tables)
    parts = int(tables.sub_start[-1] - tables.sub_start[-2]) - 1
    tri = tables.face_tri[topo.face_shape]
    meshed = tri >= 0
    node_counts = np.where(meshed, np.append(np.diff(tables.node_start), 0)[tri], 0).astype(np.int32)
    node_base = starts(node_counts)
    source = ranges(np.where(meshed, tables.node_start[tri], 0), node_counts)
    face_of_node = np.repeat(np.arange(len(tri), dtype=np.int32), node_counts)
    positions = tables.nodes[source]
    loc = topo.face_loc[face_of_node]
    away = np.flatnonzero(loc)
    if len(away):
        positions[away] = moved_each(positions[away], tables.locations.matrices(loc[away]))
    polygons = edge_polygons(tables, topo, node_base)
    label = join_nodes(tables, topo, polygons, positions)

    tri_counts = np.where(meshed, np.append(np.diff(tables.tri_start), 0)[tri], 0).astype(np.int32)
    face_of_triangle = np.repeat(np.arange(len(tri), dtype=np.int32), tri_counts)
    raw = tables.triangles[ranges(np.where(meshed, tables.tri_start[tri], 0), tri_counts)]
    raw = raw + node_base[face_of_triangle][:, None]
    flip = topo.face_reversed ^ _mirrored(tables, topo.face_loc)
    turned = flip[face_of_triangle]
    raw[turned] = raw[turned][:, [0, 2, 1]]
    triangles = label[raw]
    a, b, c = triangles.T
    whole = (a != b) & (b != c) & (c != a)
    triangles, face_of_triangle, raw = triangles[whole], face_of_triangle[whole], raw[whole]

    laid = Laid(tables, topo, planar, polygons, positions, label, raw, face_of_triangle)
    edge_start = np.searchsorted(topo.edge_part, np.arange(parts + 1)).astype(np.int32)
    known = {int(edge_start[part]) + edge: found for (part, edge), found in (judged or {}).items()}
    lines = edge_lines(laid)
    lines, line_class = in_pieces(lines, classify(laid, known), np.concatenate((positions, lines.free_points)), known)

    # Compress: used nodes, part after part; nodes of free edges follow those of the part's faces.
    node_part = np.concatenate((topo.face_part[face_of_node], topo.edge_part[lines.free_edge]))
    everything = np.concatenate((positions, lines.free_points))
    used = np.zeros(len(everything), dtype=bool)
    used[triangles] = True
    used[lines.nodes] = True
    kept = np.flatnonzero(used)
    kept = kept[np.argsort(node_part[kept], kind="stable")]
    number = np.empty(len(everything), dtype=np.int32)
    number[kept] = np.arange(len(kept), dtype=np.int32)
    face_start = np.searchsorted(topo.face_part, np.arange(parts + 1)).astype(np.int32)
    drawn_part = topo.edge_part[lines.edge]
    of_faces = np.flatnonzero(tables.kind == FACE)
    return Meshes(
        point_start=np.searchsorted(node_part[kept], np.arange(parts + 1)).astype(np.int32),
        points=everything[kept],
        triangle_start=np.searchsorted(topo.face_part[face_of_triangle], np.arange(parts + 1)).astype(np.int32),
        triangles=number[triangles],
        triangle_face=face_of_triangle - face_start[topo.face_part[face_of_triangle]],
        face_start=face_start,
        face_planar=planar[topo.face_shape],
        edge_start=np.searchsorted(drawn_part, np.arange(parts + 1)).astype(np.int32),
        edge_offsets=lines.start,
        edge_nodes=number[lines.nodes],
        edge_index=lines.edge - edge_start[drawn_part],
        edge_class=line_class,
        node_start=np.searchsorted(topo.face_part[face_of_node], np.arange(parts + 1)).astype(np.int32),
        corner=raw,
        uv=tables.uv[source],
        face_shape=np.searchsorted(of_faces, topo.face_shape).astype(np.int32),
        face_place=tables.locations.matrices(topo.face_loc),
        face_reversed=topo.face_reversed,
    )


def _mirrored(tables: Tables, locs: Ints) -> Bools:
    unique, inverse = np.unique(locs, return_inverse=True)
    return np.array([determinant_sign(tables.locations.matrix(int(n))) < 0 for n in unique], dtype=bool)[inverse]
