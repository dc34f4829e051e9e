"""Creases of meshes without B-rep, from the fold (dihedral) angle with hysteresis.

A single limit breaks lines where the fold is near it. As in Canny's edge detector there are two limits: a gap in a
crease is closed where the fold stays near the crease angle; a chain that exceeds it nowhere clearly, and ends within
smooth surfaces, is dropped.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr._kernel import MeshFacts
from hlr.common.types import Floats, Ints
from hlr.scene.fading_creases import fading_edges
from hlr.scene.walks import STRAIGHT_ON
from hlr.tables.line_classes import INTERIOR, EdgeClass

Bools = npt.NDArray[np.bool_]
Kinds = npt.NDArray[np.uint8]

SLACK = 0.05
"""Degrees: with rounded coordinates, a fold of exactly the crease angle is still a crease."""

NEAR_FOLD = 0.8
"""Share of the crease angle: edges with a larger fold close a gap between two creases."""

CLEAR_FOLD = 1.5
"""Multiple of the crease angle: an edge with a larger fold is clear, and stays wherever its chain ends."""

LONE_EDGES = 4
"""A closed chain of fewer edges, none of them clear, is noise of a scan."""


LONG_CREASE = 12
"""A chain of this many edges is a crease even if none is clear and both ends lie in smooth surfaces.

Measured: noise of scans makes chains of eleven edges at most (a skull, a bunny, a turbine blade), faint creases of
parts of fourteen or more.
"""


LONG_EDGE = 0.2
"""Of the size of its part: an edge at least this long is no noise of a scan, whose edges are short.

A crease of a part that was meshed coarsely may be a single edge, clear nowhere: it is drawn on all sides of the part.
"""


def creases(
    mesh: MeshFacts,
    triangles: Ints,
    fold: Floats,
    edge_part: Ints,
    without_brep: Bools,
    crease: float,
    points: Floats,
    sizes: Floats,
) -> Kinds:
    """(e,) the class, SHARP or BOUNDARY, of the edges of parts without B-rep; INTERIOR where an edge is no crease.

    triangles (t, 3) of `mesh`; fold (e,): cosines of its folds, as far as the coordinates support any; edge_part (e,);
    without_brep (p,): the parts that are looked at; crease: degrees; sizes (p,): diagonals of the boxes of parts.
    """
    sharp, near_fold = _cosine(crease - SLACK), _cosine(NEAR_FOLD * crease)
    kind, near = mesh.edge_kinds(fold, edge_part, without_brep, sharp, near_fold)
    kind[_gap_edges(kind, mesh.edges, near, points)] = EdgeClass.SHARP
    lone, figure = _noise_edges(kind, mesh.edges, fold, _cosine(CLEAR_FOLD * crease), len(points))
    if len(lone):
        ways = points[mesh.edges[lone, 1]] - points[mesh.edges[lone, 0]]
        long = (ways * ways).sum(axis=1) >= (LONG_EDGE * sizes[edge_part[lone]]) ** 2
        lone = lone[~np.isin(figure, figure[long])]
    kind[lone] = INTERIOR
    kind[fading_edges(kind, mesh, triangles, fold, points)] = EdgeClass.SHARP
    return kind


def _cosine(degrees: float) -> float:
    return math.cos(math.radians(min(max(degrees, 0.0), 180.0)))


def _gap_edges(kind: Kinds, edges: Ints, near: npt.NDArray[np.intp], points: Floats) -> list[int]:
    """Edges of `near` that close the gaps: straight on from the end of one crease to the end of another.

    A gap has at most as many edges as the longer of its two creases. A crease that fades out ends there: continuing it
    would draw the facets of a smooth surface. An edge that branches off a crease is not part of it: the sides of a
    prism of 14 faces end at its rims, and stay smooth.
    """
    chosen = np.flatnonzero(kind != INTERIOR)
    if not len(chosen) or not len(near):
        return []
    degree = np.bincount(edges[chosen].ravel(), minlength=len(points))
    at_end = (degree[edges[chosen]] == 1).any(axis=1)
    ends = [
        (before, end) for a, b in edges[chosen[at_end]].tolist() for before, end in ((a, b), (b, a)) if degree[end] == 1
    ]
    around: dict[int, list[int]] = {}
    for e, (a, b) in zip(near.tolist(), edges[near].tolist(), strict=True):
        around.setdefault(a, []).append(e)
        around.setdefault(b, []).append(e)
    straight = math.cos(math.radians(STRAIGHT_ON))
    figure = _kernel.edge_components(np.ascontiguousarray(edges[chosen]), len(points))
    size = np.zeros(len(points), np.int64)
    size[edges[chosen]] = np.bincount(figure)[figure][:, None]
    longest = size.max(initial=0)
    found: list[int] = []
    taken: set[int] = set()
    for first, last in ends:
        before, end = first, last
        way: list[int] = []
        while degree[last] == 1 and len(way) < longest:
            ahead = _unit(points[end] - points[before])
            on = [(e, int(edges[e].sum()) - end) for e in around.get(end, []) if e not in taken and e not in way]
            turns = [float((ahead * _unit(points[other] - points[end])).sum()) for _, other in on]
            if not turns or max(turns) < straight:
                break
            edge, other = on[int(np.argmax(turns))]
            way.append(edge)
            before, end = end, other
            if degree[end] > 0:
                if len(way) > max(size[last], size[end]):
                    break
                taken.update(way)
                found += way
                np.add.at(degree, edges[way], 1)
                break
    return found


def _noise_edges(kind: Kinds, edges: Ints, fold: Floats, clear_fold: float, n: int) -> tuple[Ints, Ints]:
    """Edges of connected sets without a clear edge that are of few edges, or end within smooth surfaces.

    Returns the edges, and the number of the set of each.
    """
    chosen = np.flatnonzero(kind != INTERIOR).astype(np.int32)
    if len(chosen) == 0:
        return chosen, chosen
    ends = edges[chosen]
    # An edge without a fold, at a border, is clear as well.
    clear = ~(fold[chosen] >= clear_fold)
    figure = _kernel.edge_components(np.ascontiguousarray(ends), n)
    single = (np.bincount(ends.ravel(), minlength=n) == 1)[ends].sum(axis=1)
    long = np.bincount(figure)
    open_ended = np.bincount(figure, weights=single) >= 2
    few = long < np.where(open_ended, LONG_CREASE, LONE_EDGES)
    slight = few & (np.bincount(figure, weights=clear) == 0)
    lone = slight[figure]
    return chosen[lone], figure[lone]


def _unit(v: Floats) -> Floats:
    return np.asarray(v / (math.sqrt(float((v * v).sum())) or 1.0))
