"""The edges of laid-out parts: their polylines and their classes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from hlr.source import tables as t
from hlr.source.conform import Polygons
from hlr.source.explore import Topology
from hlr.source.locations import moved_each
from hlr.source.model import EdgeClass, Floats, Ints
from hlr.source.tables import Bools, Bytes, Tables, ranges, starts
from hlr.source.tangency import MOSTLY_TANGENT, NEARLY_TANGENT, TANGENT, WAVERING, Tangency


@dataclass(slots=True)
class Laid:
    """All faces of all parts laid out, one block of nodes after another.

    positions     (n, 3) of the nodes; label (n,): the node each one was joined into
    triangles     (m, 3) nodes before joining, outward; face_of_triangle (m,)
    """

    tables: Tables
    topo: Topology
    planar: Bools
    polygons: Polygons
    positions: Floats
    label: Ints
    triangles: Ints
    face_of_triangle: Ints


@dataclass(slots=True)
class Lines:
    """Polylines of edges in edge order; free edges bring nodes of their own."""

    edge: Ints
    start: Ints
    nodes: Ints
    free_edge: Ints
    free_points: Floats


def edge_lines(laid: Laid) -> Lines:
    """Each edge once; an edge without polygon on a face falls back to its polygon in space."""
    tables, topo, polygons, positions = laid.tables, laid.topo, laid.polygons, laid.positions
    fresh = np.ones(len(polygons.edge), dtype=bool)
    fresh[1:] = polygons.edge[1:] != polygons.edge[:-1]
    chosen = np.flatnonzero(fresh & ~tables.degenerated[topo.edge_shape[polygons.edge]])
    edge = polygons.edge[chosen]
    counts = np.diff(polygons.start)[chosen]
    nodes = laid.label[polygons.nodes[ranges(polygons.start[chosen], counts)]]

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
    return Lines(
        edge=edge[order],
        start=starts(counts[order]),
        nodes=nodes[ranges(begin[order], counts[order])],
        free_edge=np.repeat(lone, free_counts),
        free_points=free_points,
    )


def in_pieces(lines: Lines, edge_class: Bytes, points: Floats, judged: Mapping[int, Tangency]) -> tuple[Lines, Bytes]:
    """The lines, edges that change their class cut where they do, and the EdgeClass of each; points: of all nodes."""
    cut: dict[int, tuple[list[int], list[int]]] = {}
    for edge, tangency in judged.items():
        line = int(np.searchsorted(lines.edge, edge))
        if len(tangency.smooth) == 1 or line == len(lines.edge) or lines.edge[line] != edge:
            continue
        nodes = points[lines.nodes[lines.start[line] : lines.start[line + 1]]]
        at = [int(((nodes - p) ** 2).sum(axis=1).argmin()) for p in tangency.points]
        classes = np.where(tangency.smooth, EdgeClass.SMOOTH, EdgeClass.SHARP).tolist()
        bounds = [0, *at, len(nodes) - 1]
        kept = [k for k in range(len(classes)) if bounds[k] < bounds[k + 1]]
        cut[line] = [bounds[k] for k in kept[1:]], [classes[k] for k in kept]
    result = edge_class[lines.edge]
    if not cut:
        return lines, result
    rows = []
    for line, count in enumerate(np.diff(lines.start).tolist()):
        inner, classes = cut.get(line, ([], [int(result[line])]))
        bounds = [0, *inner, count - 1]
        rows += [
            (line, kind, low, high - low + 1) for kind, low, high in zip(classes, bounds[:-1], bounds[1:], strict=True)
        ]
    line_of, kinds, first, sizes = np.array(rows, np.int32).T
    pieces = Lines(
        edge=lines.edge[line_of],
        start=starts(sizes),
        nodes=lines.nodes[ranges(lines.start[line_of] + first, sizes)],
        free_edge=lines.free_edge,
        free_points=lines.free_points,
    )
    return pieces, kinds.astype(np.uint8)


def classify(laid: Laid, judged: Mapping[int, Tangency]) -> Bytes:
    """EdgeClass of every edge; judged: how the faces meet at those that were compared along their whole length.

    An edge of two faces is SMOOTH where the surface normals agree along it; a seam whose normals do not agree is a
    crease. Edges of more than two faces, and edges of none, are SHARP; those of one face are its BOUNDARY.
    """
    tables, topo = laid.tables, laid.topo
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
    worst, least, mean = _bends(laid)
    result[seam & (worst > _squared_sine(NEARLY_TANGENT))] = EdgeClass.SHARP
    recorded = tables.smooth[topo.edge_shape] >= t.G1
    tangent = (worst <= _squared_sine(TANGENT)) | (recorded & (least <= _squared_sine(NEARLY_TANGENT)))
    tangent |= (worst <= _squared_sine(WAVERING)) & (mean <= _squared_sine(MOSTLY_TANGENT))
    for edge, tangency in judged.items():
        tangent[edge] = tangency.smooth.all()
    result[(faces == 2) & tangent] = EdgeClass.SMOOTH
    return result


def _squared_sine(angle: float) -> float:
    return float(np.sin(angle) ** 2)


def _bends(laid: Laid) -> tuple[Floats, Floats, Floats]:
    """(edges,) largest, least and mean squared sine between the normals of the two sides; 4 beyond a right angle.

    Edges without exactly two polygons of equal length, and edges without any usable normal, get 0 where they are
    recorded as tangent and 4 otherwise.
    """
    tables, topo, polygons = laid.tables, laid.topo, laid.polygons
    count = len(topo.edge_shape)
    bend = np.where(tables.smooth[topo.edge_shape] >= t.G1, 0.0, 4.0)
    sizes = np.diff(polygons.start)
    begin = np.searchsorted(polygons.edge, np.arange(count + 1))
    pair = np.flatnonzero(np.diff(begin) == 2)
    one, two = begin[pair], begin[pair] + 1
    even = sizes[one] == sizes[two]
    pair, one, two = pair[even], one[even], two[even]
    if not len(pair):
        return bend, bend, bend
    lengths = sizes[one]
    normals = _normals(laid)
    left_node = polygons.nodes[ranges(polygons.start[one], lengths)]
    right_node = polygons.nodes[ranges(polygons.start[two], lengths)]
    left = normals.at(left_node, np.repeat(polygons.face[one], lengths))
    right = normals.at(right_node, np.repeat(polygons.face[two], lengths))
    squares = _dot(left, left) * _dot(right, right)
    cross = np.stack(
        [left[:, i - 2] * right[:, i - 1] - left[:, i - 1] * right[:, i - 2] for i in range(3)],
        axis=1,
    )
    # At a pole, the apex of a cone above all, a surface has no normal, and what stands there is a guess.
    pole = np.zeros(len(laid.positions), dtype=bool)
    pole[polygons.nodes[np.repeat(tables.degenerated[topo.edge_shape[polygons.edge]], sizes)]] = True
    usable = (squares > 1e-60) & ~pole[left_node] & ~pole[right_node]
    ratio = np.zeros(len(squares))
    np.divide(_dot(cross, cross), squares, out=ratio, where=usable)
    ratio[_dot(left, right) < 0] = 4.0
    first = starts(lengths)[:-1]
    worst, least = bend.copy(), bend
    for result, reduce, unknown in ((worst, np.maximum, -1.0), (least, np.minimum, 5.0)):
        ratio[~usable] = unknown
        extreme = reduce.reduceat(ratio, first)
        known = extreme != unknown
        result[pair[known]] = extreme[known]
    mean, some = worst.copy(), np.add.reduceat(usable.astype(float), first)
    known = some > 0.0
    mean[pair[known]] = np.add.reduceat(np.where(usable, ratio, 0.0), first)[known] / some[known]
    return worst, least, mean


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


def _normals(laid: Laid) -> _Normals:
    tables, topo = laid.tables, laid.topo
    faces = len(topo.face_shape)
    a, b, c = (laid.positions[laid.triangles[:, k]] for k in range(3))
    u, v = b - a, c - a
    area = np.stack([u[:, i - 2] * v[:, i - 1] - u[:, i - 1] * v[:, i - 2] for i in range(3)], axis=1)
    of_face: Floats = np.stack(
        [np.bincount(laid.face_of_triangle, area[:, i], minlength=faces) for i in range(3)], axis=1
    )
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
    return _Normals(laid.planar[topo.face_shape], of_face, sign, of_node)
