"""Nodes of neighbouring faces joined along their common edges: part meshes without gaps.

Every face has a block of nodes of its own. The polygons of an edge on its faces say which nodes are one and the same,
the ends of an edge belong to its vertices, and all nodes along a pole belong to one vertex.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hlr.source import tables as t
from hlr.source.explore import Topology, first_of
from hlr.source.model import Floats, Ints
from hlr.source.tables import Tables, ranges, starts


@dataclass(slots=True)
class Polygons:
    """Polygons of edges on faces, ordered by edge, then by face."""

    edge: Ints
    face: Ints
    start: Ints
    nodes: Ints


def edge_polygons(tables: Tables, topo: Topology, node_base: Ints) -> Polygons:
    """Every polygon of every edge on every face of its part, as node numbers of the laid-out blocks."""
    pairs = np.unique(topo.use_edge.astype(np.int64) << 32 | topo.use_face)
    edge, face = (pairs >> 32).astype(np.int32), (pairs & 0xFFFFFFFF).astype(np.int32)
    tri = tables.face_tri[topo.face_shape[face]]
    wanted = tri >= 0
    edge, face, tri = edge[wanted], face[wanted], tri[wanted]
    shape = topo.edge_shape[edge]
    rep = representation(tables, shape, tri, tables.locations.quotients(topo.edge_loc[edge], topo.face_loc[face]))
    edge, face, rep = edge[rep >= 0], face[rep >= 0], rep[rep >= 0]
    second = tables.rep_poly2[rep] >= 0
    poly = np.concatenate((tables.rep_poly[rep], tables.rep_poly2[rep][second]))
    edge, face = np.concatenate((edge, edge[second])), np.concatenate((face, face[second]))
    order = np.lexsort((face, edge))  # stable: a first polygon stays before its second
    edge, face, poly = edge[order], face[order], poly[order]
    counts = tables.poly_start[poly + 1] - tables.poly_start[poly]
    nodes = tables.poly_nodes[ranges(tables.poly_start[poly], counts)] + np.repeat(node_base[face], counts)
    return Polygons(edge, face, starts(counts), nodes)


def representation(tables: Tables, shape: Ints, tri: Ints, loc: Ints) -> Ints:
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
    _, key = first_of(topo.edge_part[owner], tables.sub_shape[sub], loc)
    ends = np.full((2, count), -1, dtype=np.int32)
    ends[tables.sub_orient[sub], owner] = key
    return ends[0], ends[1]


def join_nodes(tables: Tables, topo: Topology, polygons: Polygons, positions: Floats) -> Ints:
    """For every laid-out node the lowest node it coincides with."""
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
