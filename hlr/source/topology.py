"""From the tables of a meshed B-rep to conforming part meshes with classified edges, all parts at once.

1. Expand the tree of every part into faces, edges and their uses, in the order of TopExp::MapShapes, so that the indices
   in our records are those of a part's index maps.
2. Lay out one block of nodes per face; the polygons of an edge on its faces say which nodes are one and the same, the
   ends of the edge belong to its vertices, and all nodes along a pole to one vertex.
3. Join these nodes, drop the triangles that collapse, and read each edge's polyline off one of its polygons.
4. Classify the edges by the faces they bound and by the surface normals on both sides.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hlr.source import tables as t
from hlr.source.locations import determinant_sign, moved_each
from hlr.source.model import EdgeClass, Floats, Ints
from hlr.source.tables import Bools, Bytes, Tables, ranges, starts

TANGENT = 0.01
"""Radians: surfaces that meet at less are tangent; what STEP and IGES readers assume as well."""

NEARLY_TANGENT = 0.1
"""Radians: an edge recorded as tangent is believed up to here."""


@dataclass(slots=True)
class Topology:
    """Faces and edges of all parts; `face_part` and `edge_part` ascend, so each part is one slice.

    use_edge, use_face: which edge (record) stands in a wire of which face (record), each use once per wire entry.
    """

    face_part: Ints
    face_shape: Ints
    face_loc: Ints
    face_reversed: Bools
    edge_part: Ints
    edge_shape: Ints
    edge_loc: Ints
    use_edge: Ints
    use_face: Ints
    use_orient: Bytes


@dataclass(slots=True)
class Meshes:
    """Part meshes one after another: part p owns points[point_start[p]:point_start[p+1]] and so on.

    triangles and edge_nodes count from the beginning of all points. edge_index is local to the part.
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
    missing_faces: Ints


@dataclass(slots=True)
class _Items:
    """A list of sub-shapes in the order a TopExp_Explorer meets them."""

    part: Ints
    shape: Ints
    loc: Ints
    orient: Bytes
    face: Ints

    def only(self, keep: Bools) -> _Items:
        return _Items(self.part[keep], self.shape[keep], self.loc[keep], self.orient[keep], self.face[keep])


def roots(tables: Tables) -> _Items:
    """The parts: children of the root compound after the first, which only carries normals."""
    first, last = tables.sub_start[-2] + 1, tables.sub_start[-1]
    count = int(last - first)
    return _Items(
        part=np.arange(count, dtype=np.int32),
        shape=tables.sub_shape[first:last].copy(),
        loc=tables.sub_loc[first:last].copy(),
        orient=tables.sub_orient[first:last].copy(),
        face=np.full(count, -1, dtype=np.int32),
    )


def _expand(tables: Tables, items: _Items, expandable: Bools) -> _Items:
    """Replace the expandable items by their children, in place, until none is left."""
    while True:
        open_ = expandable[tables.kind[items.shape]]
        if not open_.any():
            return items
        begin = tables.sub_start[items.shape]
        counts = np.where(open_, tables.sub_start[items.shape + 1] - begin, 1)
        parent = np.repeat(np.arange(len(counts)), counts)
        child = ranges(np.where(open_, begin, 0), counts)
        inside = open_[parent]
        kid = child[inside]
        up = parent[inside]
        result = _Items(
            items.part[parent], items.shape[parent], items.loc[parent], items.orient[parent], items.face[parent]
        )
        result.shape[inside] = tables.sub_shape[kid]
        result.loc[inside] = tables.locations.products(items.loc[up], tables.sub_loc[kid])
        result.orient[inside] = _composed(items.orient[up], tables.sub_orient[kid])
        items = result


def _composed(outer: Bytes, inner: Bytes) -> Bytes:
    """TopAbs::Compose: an internal or external shape stays so, a reversed parent turns the child round."""
    return np.where(outer >= t.INTERNAL, outer, np.where(inner >= t.INTERNAL, inner, inner ^ outer)).astype(np.uint8)


def _first_of(part: Ints, shape: Ints, loc: Ints) -> tuple[Ints, Ints]:
    """(indices of first occurrences, in order; for each item the rank of its first occurrence)."""
    order = np.lexsort((np.arange(len(part)), loc, shape, part))
    same = np.zeros(len(part), dtype=bool)
    a, b = order[1:], order[:-1]
    same[1:] = (part[a] == part[b]) & (shape[a] == shape[b]) & (loc[a] == loc[b])
    group = np.cumsum(~same) - 1
    leader = order[~same]
    rank_of_leader = np.empty(len(leader), dtype=np.int32)
    by_position = np.argsort(leader, kind="stable")
    rank_of_leader[by_position] = np.arange(len(leader), dtype=np.int32)
    rank = np.empty(len(part), dtype=np.int32)
    rank[order] = rank_of_leader[group]
    return leader[by_position].astype(np.int32), rank


def explore(tables: Tables) -> Topology:
    """Step 1."""
    kinds = np.arange(8)
    items = _expand(tables, roots(tables), (kinds < t.FACE) | (kinds == t.WIRE))
    items = items.only(tables.kind[items.shape] != t.VERTEX)
    is_face = tables.kind[items.shape] == t.FACE
    faces = items.only(is_face)
    first, rank = _first_of(faces.part, faces.shape, faces.loc)
    items.face[is_face] = rank
    uses = _expand(tables, items, (kinds == t.FACE) | (kinds == t.WIRE))
    uses = uses.only(tables.kind[uses.shape] == t.EDGE)
    edge_first, edge_rank = _first_of(uses.part, uses.shape, uses.loc)
    in_face = uses.face >= 0
    return Topology(
        face_part=faces.part[first],
        face_shape=faces.shape[first],
        face_loc=faces.loc[first],
        face_reversed=faces.orient[first] == t.REVERSED,
        edge_part=uses.part[edge_first],
        edge_shape=uses.shape[edge_first],
        edge_loc=uses.loc[edge_first],
        use_edge=edge_rank[in_face],
        use_face=uses.face[in_face],
        use_orient=uses.orient[in_face],
    )


@dataclass(slots=True)
class _Polygons:
    """Polygons of edges on faces, ordered by edge, then by face."""

    edge: Ints
    face: Ints
    start: Ints
    nodes: Ints


def _polygons(tables: Tables, topo: Topology, node_base: Ints) -> _Polygons:
    """Every polygon of every edge on every face of its part, as node numbers of the laid-out blocks."""
    pairs = np.unique(topo.use_edge.astype(np.int64) << 32 | topo.use_face)
    edge, face = (pairs >> 32).astype(np.int32), (pairs & 0xFFFFFFFF).astype(np.int32)
    tri = tables.face_tri[topo.face_shape[face]]
    wanted = tri >= 0
    edge, face, tri = edge[wanted], face[wanted], tri[wanted]
    shape = topo.edge_shape[edge]
    rep = _representation(tables, shape, tri, tables.locations.quotients(topo.edge_loc[edge], topo.face_loc[face]))
    edge, face, rep = edge[rep >= 0], face[rep >= 0], rep[rep >= 0]
    second = tables.rep_poly2[rep] >= 0
    poly = np.concatenate((tables.rep_poly[rep], tables.rep_poly2[rep][second]))
    edge, face = np.concatenate((edge, edge[second])), np.concatenate((face, face[second]))
    order = np.lexsort((face, edge))  # stable: a first polygon stays before its second
    edge, face, poly = edge[order], face[order], poly[order]
    counts = tables.poly_start[poly + 1] - tables.poly_start[poly]
    nodes = tables.poly_nodes[ranges(tables.poly_start[poly], counts)] + np.repeat(node_base[face], counts)
    return _Polygons(edge, face, starts(counts), nodes)


def _representation(tables: Tables, shape: Ints, tri: Ints, loc: Ints) -> Ints:
    """Which rep_* entry belongs to an edge's underlying shape on a triangulation seen at a location; -1: none.

    The location matters where one underlying edge bounds one face in several places, as the rims of patterned holes do.
    """
    count = len(tables.rep_edge)
    pairs = np.concatenate((tables.rep_edge, shape)).astype(np.int64) << 32 | np.concatenate((tables.rep_tri, tri))
    _, pair = np.unique(pairs, return_inverse=True)
    exact = pair.astype(np.int64) << 32 | np.concatenate((tables.rep_loc, loc))
    result = _lookup(exact[:count], exact[count:])
    lost = result < 0
    if lost.any():
        result[lost] = _lookup(pairs[:count], pairs[count:][lost])
    return result


def _lookup(keys: npt.NDArray[np.int64], wanted: npt.NDArray[np.int64]) -> Ints:
    """Index of each wanted key's first occurrence in keys, else -1."""
    order = np.argsort(keys, kind="stable")
    at = np.searchsorted(keys, wanted, sorter=order)
    result = np.full(len(wanted), -1, dtype=np.int32)
    inside = np.flatnonzero(at < len(keys))
    hit = inside[keys[order[at[inside]]] == wanted[inside]]
    result[hit] = order[at[hit]]
    return result


def _ends(tables: Tables, topo: Topology) -> tuple[Ints, Ints]:
    """Keys (numbers from 0) of the first and last vertex of every edge; -1 where it has none."""
    count = len(topo.edge_shape)
    subs = tables.sub_start[topo.edge_shape + 1] - tables.sub_start[topo.edge_shape]
    owner = np.repeat(np.arange(count, dtype=np.int32), subs)
    sub = ranges(tables.sub_start[topo.edge_shape], subs)
    keep = tables.sub_orient[sub] <= t.REVERSED
    owner, sub = owner[keep], sub[keep]
    loc = tables.locations.products(topo.edge_loc[owner], tables.sub_loc[sub])
    _, key = _first_of(topo.edge_part[owner], tables.sub_shape[sub], loc)
    ends = np.full((2, count), -1, dtype=np.int32)
    ends[tables.sub_orient[sub], owner] = key
    return ends[0], ends[1]


def join_nodes(tables: Tables, topo: Topology, polygons: _Polygons, positions: Floats) -> Ints:
    """Step 2: for every laid-out node the lowest node it coincides with."""
    first, last = _ends(tables, topo)
    vertices = int(max(first.max(initial=-1), last.max(initial=-1))) + 1
    counts = np.diff(polygons.start)
    edge_of = np.repeat(polygons.edge, counts)
    place = np.arange(len(polygons.nodes), dtype=np.int32) - np.repeat(polygons.start[:-1], counts)
    length = np.repeat(counts, counts)
    # Keys: vertices first, then every place along every edge, as long as its longest polygon.
    longest = np.zeros(len(topo.edge_shape), dtype=np.int32)
    np.maximum.at(longest, polygons.edge, counts)
    shortest = np.full(len(topo.edge_shape), np.iinfo(np.int32).max, dtype=np.int32)
    np.minimum.at(shortest, polygons.edge, counts)
    base = starts(longest)[:-1] + vertices
    key = base[edge_of] + place
    for ends, at in ((first, place == 0), (last, place == length - 1)):
        known = at & (ends[edge_of] >= 0)
        key[known] = ends[edge_of][known]
    # The last place of a polygon without a vertex: the same for all polygons of the edge.
    pole = tables.degenerated[topo.edge_shape]
    end = np.where(first >= 0, first, last)
    collapsed = (pole & (end >= 0))[edge_of]
    key[collapsed] = end[edge_of][collapsed]
    uneven = (longest != shortest)[edge_of] & (key >= vertices)
    if uneven.any():
        total = int(key.max()) + 1
        rows = np.column_stack((edge_of[uneven].astype(np.float64), positions[polygons.nodes[uneven]]))
        _, same = np.unique(rows, axis=0, return_inverse=True)
        key[uneven] = total + same.astype(np.int32).ravel()
    return _lowest(len(positions), polygons.nodes, key)


def _lowest(count: int, node: Ints, key: Ints) -> Ints:
    """Connected components of the bipartite graph node - key: the lowest node of each node's component."""
    label = np.arange(count, dtype=np.int32)
    if not len(key):
        return label
    while True:
        least = np.full(int(key.max()) + 1, count, dtype=np.int32)
        np.minimum.at(least, key, label[node])
        after = label.copy()
        np.minimum.at(after, node, least[key])
        if np.array_equal(after, label):
            return label
        label = after


def build(tables: Tables, planar: Bools) -> Meshes:
    """All four steps. `planar`: (n,) bool per underlying shape, meaningful for faces."""
    topo = explore(tables)
    parts = int(tables.sub_start[-1] - tables.sub_start[-2]) - 1
    tri = tables.face_tri[topo.face_shape]
    meshed = tri >= 0
    node_counts = np.where(meshed, np.diff(tables.node_start)[tri], 0).astype(np.int32)
    node_base = starts(node_counts)
    source = ranges(np.where(meshed, tables.node_start[tri], 0), node_counts)
    face_of_node = np.repeat(np.arange(len(tri), dtype=np.int32), node_counts)
    positions = tables.nodes[source]
    loc = topo.face_loc[face_of_node]
    away = np.flatnonzero(loc)
    if len(away):
        positions[away] = moved_each(positions[away], tables.locations.matrices(loc[away]))
    polygons = _polygons(tables, topo, node_base)
    label = join_nodes(tables, topo, polygons, positions)

    tri_counts = np.where(meshed, np.diff(tables.tri_start)[tri], 0).astype(np.int32)
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

    lines = _lines(tables, topo, polygons, label, positions)
    edge_class = classify(tables, topo, polygons, planar, positions, raw, face_of_triangle)

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
    edge_start = np.searchsorted(topo.edge_part, np.arange(parts + 1)).astype(np.int32)
    drawn_part = topo.edge_part[lines.edge]
    missing = np.bincount(topo.face_part[~meshed], minlength=parts)
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
        edge_class=edge_class[lines.edge],
        missing_faces=missing.astype(np.int32),
    )


def _mirrored(tables: Tables, locs: Ints) -> Bools:
    unique, inverse = np.unique(locs, return_inverse=True)
    return np.array([determinant_sign(tables.locations.matrix(int(n))) < 0 for n in unique], dtype=bool)[inverse]


@dataclass(slots=True)
class _Lines:
    """Polylines of edges in edge order; free edges bring nodes of their own."""

    edge: Ints
    start: Ints
    nodes: Ints
    free_edge: Ints
    free_points: Floats


def _lines(tables: Tables, topo: Topology, polygons: _Polygons, label: Ints, positions: Floats) -> _Lines:
    """Step 3: each edge once; an edge without polygon on a face falls back to its polygon in space."""
    fresh = np.ones(len(polygons.edge), dtype=bool)
    fresh[1:] = polygons.edge[1:] != polygons.edge[:-1]
    chosen = np.flatnonzero(fresh & ~tables.degenerated[topo.edge_shape[polygons.edge]])
    edge = polygons.edge[chosen]
    counts = np.diff(polygons.start)[chosen]
    nodes = label[polygons.nodes[ranges(polygons.start[chosen], counts)]]

    on_face = np.zeros(len(topo.edge_shape), dtype=bool)
    on_face[topo.use_edge] = True
    poly_of = np.full(len(tables.kind), -1, dtype=np.int32)
    poly_of[tables.free_edge[::-1]] = np.arange(len(tables.free_edge), dtype=np.int32)[::-1]
    lone = np.flatnonzero(~on_face & (poly_of[topo.edge_shape] >= 0)).astype(np.int32)
    rep = poly_of[topo.edge_shape[lone]]
    poly = tables.free_poly[rep]
    free_counts = tables.line_start[poly + 1] - tables.line_start[poly]
    free_points = tables.line_points[ranges(tables.line_start[poly], free_counts)]
    loc = np.repeat(tables.locations.products(topo.edge_loc[lone], tables.free_loc[rep]), free_counts)
    away = np.flatnonzero(loc)
    if len(away):
        free_points[away] = moved_each(free_points[away], tables.locations.matrices(loc[away]))
    nodes = np.concatenate((nodes, len(positions) + np.arange(len(free_points), dtype=np.int32)))
    edge, counts = np.concatenate((edge, lone)), np.concatenate((counts, free_counts))

    # Places that were joined stand twice in a row: once is enough, and an edge that vanished is no edge.
    owner = np.repeat(np.arange(len(edge), dtype=np.int32), counts)
    keep = np.ones(len(nodes), dtype=bool)
    keep[1:] = (nodes[1:] != nodes[:-1]) | (owner[1:] != owner[:-1])
    counts = np.bincount(owner[keep], minlength=len(edge)).astype(np.int32)
    keep &= (counts > 1)[owner]
    nodes, owner = nodes[keep], owner[keep]
    order = np.argsort(edge, kind="stable")
    order = order[counts[order] > 1]
    begin = np.searchsorted(owner, np.arange(len(edge))).astype(np.int32)
    return _Lines(
        edge=edge[order],
        start=starts(counts[order]),
        nodes=nodes[ranges(begin[order], counts[order])],
        free_edge=np.repeat(lone, free_counts),
        free_points=free_points,
    )


def classify(
    tables: Tables,
    topo: Topology,
    polygons: _Polygons,
    planar: Bools,
    positions: Floats,
    triangles: Ints,
    face_of_triangle: Ints,
) -> Bytes:
    """Step 4: EdgeClass of every edge.

    An edge of two faces is SMOOTH where the surface normals agree along it; a seam whose normals do not agree is a
    crease. Edges of more than two faces, and edges of none, are SHARP; those of one face are its BOUNDARY.
    """
    count = len(topo.edge_shape)
    keys = topo.use_edge.astype(np.int64) << 32 | topo.use_face
    unique, uses = np.unique(keys, return_counts=True)
    faces = np.bincount((unique >> 32).astype(np.int64), minlength=count)
    twice = np.zeros(count, dtype=bool)
    twice[(unique[uses > 1] >> 32).astype(np.int64)] = True
    inner = np.zeros(count, dtype=bool)
    inner[topo.use_edge[topo.use_orient >= t.INTERNAL]] = True

    result = np.full(count, EdgeClass.SHARP, dtype=np.uint8)
    result[(faces == 1) & ~inner] = EdgeClass.BOUNDARY
    seam = (faces == 1) & twice
    result[seam] = EdgeClass.SEAM
    bend = _bends(tables, topo, polygons, planar, positions, triangles, face_of_triangle)
    result[seam & (bend > _squared_sine(NEARLY_TANGENT))] = EdgeClass.SHARP
    recorded = tables.smooth[topo.edge_shape] >= t.G1
    tangent = (bend <= _squared_sine(TANGENT)) | (recorded & (bend <= _squared_sine(NEARLY_TANGENT)))
    result[(faces == 2) & tangent] = EdgeClass.SMOOTH
    return result


def _squared_sine(angle: float) -> float:
    return float(np.sin(angle) ** 2)


def _bends(
    tables: Tables,
    topo: Topology,
    polygons: _Polygons,
    planar: Bools,
    positions: Floats,
    triangles: Ints,
    face_of_triangle: Ints,
) -> Floats:
    """(edges,) the largest squared sine between the normals of the two sides; 4 beyond a right angle.

    Edges without exactly two polygons of equal length, and edges without any usable normal, get 0 where they are
    recorded as tangent and 4 otherwise.
    """
    count = len(topo.edge_shape)
    bend = np.where(tables.smooth[topo.edge_shape] >= t.G1, 0.0, 4.0)
    sizes = np.diff(polygons.start)
    begin = np.searchsorted(polygons.edge, np.arange(count + 1))
    pair = np.flatnonzero(np.diff(begin) == 2)
    one, two = begin[pair], begin[pair] + 1
    even = sizes[one] == sizes[two]
    pair, one, two = pair[even], one[even], two[even]
    if not len(pair):
        return bend
    lengths = sizes[one]
    normals = _normals(tables, topo, planar, positions, triangles, face_of_triangle)
    left = normals.at(polygons.nodes[ranges(polygons.start[one], lengths)], np.repeat(polygons.face[one], lengths))
    right = normals.at(polygons.nodes[ranges(polygons.start[two], lengths)], np.repeat(polygons.face[two], lengths))
    squares = _dot(left, left) * _dot(right, right)
    cross = np.stack(
        [left[:, i - 2] * right[:, i - 1] - left[:, i - 1] * right[:, i - 2] for i in range(3)],
        axis=1,
    )
    usable = squares > 1e-60
    ratio = np.zeros(len(squares))
    np.divide(_dot(cross, cross), squares, out=ratio, where=usable)
    ratio[_dot(left, right) < 0] = 4.0
    ratio[~usable] = -1.0
    worst = np.maximum.reduceat(ratio, starts(lengths)[:-1])
    known = worst >= 0
    bend[pair[known]] = worst[known]
    return bend


def _dot(a: Floats, b: Floats) -> Floats:
    return a[:, 0] * b[:, 0] + a[:, 1] * b[:, 1] + a[:, 2] * b[:, 2]


@dataclass(slots=True)
class _Normals:
    """Outward normals at laid-out nodes: of the surface where it is curved, of the triangles where it is flat."""

    flat: Bools
    of_face: Floats
    sign: Floats
    of_node: Floats

    def at(self, node: Ints, face: Ints) -> Floats:
        normal = self.of_node[node] * self.sign[face][:, None]
        flat = self.flat[face]
        normal[flat] = self.of_face[face[flat]]
        return normal


def _normals(
    tables: Tables, topo: Topology, planar: Bools, positions: Floats, triangles: Ints, face_of_triangle: Ints
) -> _Normals:
    faces = len(topo.face_shape)
    a, b, c = (positions[triangles[:, k]] for k in range(3))
    u, v = b - a, c - a
    area = np.stack([u[:, i - 2] * v[:, i - 1] - u[:, i - 1] * v[:, i - 2] for i in range(3)], axis=1)
    of_face = np.stack([np.bincount(face_of_triangle, area[:, i], minlength=faces) for i in range(3)], axis=1)
    length = np.sqrt(_dot(of_face, of_face))
    of_face /= np.where(length > 0, length, 1.0)[:, None]
    tri = tables.face_tri[topo.face_shape]
    counts = np.where(tri >= 0, np.diff(tables.node_start)[tri], 0).astype(np.int32)
    of_node = tables.normals[ranges(np.where(tri >= 0, tables.node_start[tri], 0), counts)].astype(np.float64)
    loc = np.repeat(topo.face_loc, counts)
    away = np.flatnonzero(loc)
    if len(away):
        turn = tables.locations.matrices(loc[away])
        turn[:, :, 3] = 0.0
        of_node[away] = moved_each(of_node[away], turn)
    sign = np.where(topo.face_reversed, -1.0, 1.0)
    return _Normals(planar[topo.face_shape], of_face, sign, of_node)
