"""Creases of meshes that fade out: where two pipes of one size meet, the fold falls from 90 degrees to nothing.

Below the crease angle, the fold alone does not tell a crease from the facets of a curved face. It is a crease still
where it goes straight on from one, is not much smaller than the fold before, and far larger than every fold beside it.
The last bit, where nothing tells it from a facet, is drawn if two creases run into one another there.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from itertools import combinations

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr._kernel import MeshFacts
from hlr.common.types import Floats, Ints
from hlr.tables.line_classes import INTERIOR, EdgeClass

LEAST_FOLD = 4.0
"""Degrees: a crease is not followed below this fold."""

STANDS_OUT = 2.0
"""A fold on the way is at least this many times each other fold at the corners of its two triangles."""

FADES = 0.5
"""A fold on the way is at least this share of the fold before it: a crease fades, and does not break off."""

STRAIGHT = 15.0
"""Degrees: from edge to edge, a crease that fades turns by no more than this."""

ALONG = math.cos(math.radians(30.0))
"""Edges whose directions differ by less run along one another."""

LONG_ENOUGH = 4
"""Only creases of at least this many edges are followed: the direction of a shorter one may be chance."""

GAP = 0.2
"""Creases that run into one another are joined across a gap of up to this share of the shorter one's length."""

GAP_EDGES = 6
"""From its end, a crease goes on into a gap for at most as many edges."""

LONGER = 3.0
"""No edge in a gap is longer than so many times the last edge before it, whose direction it follows."""

MEETING = 8
"""Of the creases that meet in one point at most so many are looked at."""

Kinds = npt.NDArray[np.uint8]


@dataclass
class _End:
    """The open end of a crease: the vertex before it, the vertex it ends at, and its fold there in degrees."""

    before: int
    vertex: int
    fold: float = 0.0
    length: float = 0.0
    """Of the whole crease, in model units."""
    way: list[int] = field(default_factory=list)
    """The edges on which it goes on."""

    def step(self, edge: int, other: int, fold: float) -> None:
        self.before, self.vertex, self.fold = self.vertex, other, fold
        self.way.append(edge)


@dataclass(frozen=True)
class _Way:
    """The way from an end to a vertex. length: model units."""

    end: _End
    vertex: int
    edges: tuple[int, ...]
    length: float


class _Around:
    """Edges around each vertex, of those that were chosen."""

    def __init__(self, chosen: Ints, edges: Ints, points: Floats) -> None:
        ends = edges[chosen]
        vertex = ends.ravel(order="F")
        order = np.argsort(vertex, kind="stable")
        self._points = points
        self._first = np.concatenate([[0], np.cumsum(np.bincount(vertex, minlength=len(points)))])
        self._edge = np.tile(chosen, 2)[order]
        self._other = ends[:, ::-1].ravel(order="F")[order]

    def at(self, vertex: int) -> tuple[Ints, Ints]:
        """The edges at a vertex, and their other vertices."""
        first, last = self._first[vertex : vertex + 2]
        return self._edge[first:last], self._other[first:last]

    def between(self, one: int, other: int) -> list[int]:
        """The edge between two vertices, if it is one of these."""
        edges, others = self.at(one)
        return list(edges[others == other].tolist())

    def straight_on(self, end: _End) -> tuple[int, int] | None:
        """The edge that goes on most nearly straight, and its other vertex."""
        edges, others = self.at(end.vertex)
        if not len(edges):
            return None
        turns = np.where(others == end.before, 180.0, self.turns(end, others))
        best = int(np.argmin(turns))
        return (int(edges[best]), int(others[best])) if turns[best] <= STRAIGHT else None

    def turns(self, end: _End, to: Ints) -> Floats:
        """(k,) degrees by which the ways to the vertices `to` (k,) turn from the crease."""
        a = self._points[end.vertex] - self._points[end.before]
        b = self._points[to] - self._points[end.vertex]
        (x, y, z), (u, v, w) = a, b.T
        # `np.cross` takes ten times as long for so few.
        across = np.linalg.norm([y * w - z * v, z * u - x * w, x * v - y * u], axis=0)
        return np.asarray(np.degrees(np.arctan2(across, b @ a)))


def fading_edges(kind: Kinds, mesh: MeshFacts, triangles: Ints, fold: Floats, points: Floats) -> list[int]:
    """Edges on which the creases go on below the crease angle, each once.

    kind (e,): INTERIOR where an edge is no crease; triangles (t, 3) of `mesh`; fold (e,): cosines; points (n, 3).
    """
    ends = _open_ends(kind, mesh.edges, fold, points)
    if not ends:
        return []
    found = _followed(ends, kind, mesh, triangles, fold, points)
    return sorted({*found, *_joined(ends, kind, mesh.edges, points)})


def _open_ends(kind: Kinds, edges: Ints, fold: Floats, points: Floats) -> list[_End]:
    chosen = np.flatnonzero(kind != INTERIOR)
    if not len(chosen):
        return []
    ends = edges[chosen]
    degree = np.bincount(ends.ravel(), minlength=len(points))
    at_end = np.flatnonzero((degree[ends] == 1).any(axis=1) & (kind[chosen] == EdgeClass.SHARP))
    if not len(at_end):
        return []
    crease = _kernel.edge_components(np.ascontiguousarray(ends), len(points))
    ways = points[ends[:, 1]] - points[ends[:, 0]]
    length = np.bincount(crease, weights=np.sqrt((ways * ways).sum(axis=1)))
    count = np.bincount(crease)
    found = []
    for i in at_end[count[crease[at_end]] >= LONG_ENOUGH].tolist():
        a, b = ends[i].tolist()
        angle = _degrees(float(fold[chosen[i]]))
        for before, end in ((a, b), (b, a)):
            if degree[end] == 1:
                found.append(_End(before, end, angle, float(length[crease[i]])))
    return found


def _followed(
    ends: list[_End], kind: Kinds, mesh: MeshFacts, triangles: Ints, fold: Floats, points: Floats
) -> list[int]:
    """Follows each crease while its fold stands out. The ends move on."""
    folded = np.flatnonzero(fold < math.cos(math.radians(LEAST_FOLD / STANDS_OUT))).astype(np.int32)
    around, on_from = (_Around(some, mesh.edges, points) for some in (folded, folded[kind[folded] == INTERIOR]))
    taken: set[int] = set()
    for end in ends:
        # An edge is walked once: so all walks together are no longer than the mesh has edges.
        while (on := on_from.straight_on(end)) is not None and on[0] not in taken:
            edge, other = on
            own = _degrees(float(fold[edge]))
            if own < max(LEAST_FOLD, FADES * end.fold):
                break
            ahead = around.straight_on(_End(end.vertex, other))
            along = [edge, *around.between(end.before, end.vertex), *(ahead or ())[:1]]
            corners = np.unique(triangles[mesh.incident[mesh.offsets[edge] : mesh.offsets[edge + 1]]])
            near = np.concatenate([around.at(vertex)[0] for vertex in corners.tolist()])
            near = near[~np.isin(near, along)]
            # Creases that run across are no facets beside this one: the rim at which its triangles end.
            beside = fold[near[(kind[near] == INTERIOR) | _parallel(near, edge, mesh.edges, points)]].min(initial=1.0)
            if own < STANDS_OUT * _degrees(float(beside)):
                break
            taken.add(edge)
            end.step(edge, other, own)
    return [edge for end in ends for edge in end.way]


def _parallel(near: Ints, edge: int, edges: Ints, points: Floats) -> npt.NDArray[np.bool_]:
    """(k,) which of the edges `near` (k,) run along an edge rather than across it."""
    ways = points[edges[near, 1]] - points[edges[near, 0]]
    way = points[edges[edge, 1]] - points[edges[edge, 0]]
    return np.asarray(abs(ways @ way) >= ALONG * np.linalg.norm(ways, axis=1) * np.linalg.norm(way))


def _joined(ends: list[_End], kind: Kinds, edges: Ints, points: Floats) -> list[int]:
    """Edges of the gaps between ends that meet in one vertex, each straight on: head to head, or as a V."""
    reached = np.zeros(len(points), bool)
    reached[[end.vertex for end in ends]] = True
    for _ in range(GAP_EDGES):
        reached[edges[reached[edges].any(axis=1)]] = True
    inside = np.flatnonzero(reached[edges].all(axis=1) & (kind == INTERIOR)).astype(np.int32)
    around = _Around(inside, edges, points)
    passing: dict[int, list[_Way]] = {}
    for end in ends:
        for way in _ways(end, around, points):
            passing.setdefault(way.vertex, []).append(way)
    found: list[int] = []
    for ways in passing.values():
        for one, other in combinations(ways[:MEETING], 2):
            if one.end is not other.end and one.length + other.length <= GAP * min(one.end.length, other.end.length):
                found += (*one.edges, *other.edges)
    return found


def _ways(end: _End, around: _Around, points: Floats) -> Iterator[_Way]:
    """From an end to each vertex straight on, as far as a gap may reach; the first is the end itself."""
    at, length = replace(end, way=[]), 0.0
    last = math.dist(points[end.before], points[end.vertex])
    yield _Way(end, end.vertex, (), 0.0)
    while len(at.way) < GAP_EDGES and (on := around.straight_on(at)) is not None:
        step = math.dist(points[at.vertex], points[on[1]])
        if step > LONGER * last:
            break
        length += step
        at.step(*on, 0.0)
        yield _Way(end, at.vertex, tuple(at.way), length)


def _degrees(cosine: float) -> float:
    return math.degrees(math.acos(min(max(cosine, -1.0), 1.0)))
