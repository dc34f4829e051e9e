"""What is true at points of a drawing: whether a line of the model runs there, and whether the viewer sees it.

From the nearest point of each line of the model two rays go to the viewer on either side of it, and two more farther
off. A line is seen where nothing is in front of it on one side; it is hidden where something is on both::

              viewer
        |  |       |  |
        |  |       |  |         free on the left: the edge is seen,
        |  |     --+--+---      though a face lies in front of it on the right
        o  o   x   o  o

A face that itself ends in the line is not in front of it, however steeply it rises: its plane meets the line. Where the
rays of one side disagree, or what they meet is in front by less than the mesh is sure of, nothing is said.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.types import Floats, Ints
from hlr.compare.lines.pieces import Index, Pieces
from hlr.compare.matching.near import pairs
from hlr.compare.verdict.true_lines import Bools, TrueLines
from hlr.tables.line_classes import by_number

NOTHING, UNCLEAR, HIDDEN, VISIBLE = -1, 0, 1, 2
"""What is known of a line at a point: no line runs there; it cannot be said; it is hidden, or visible."""

ASIDE = (3.0, 9.0)
"""Errors of the mesh by which rays are beside the line."""

_SURE = 2.0
"""Errors of the mesh, across a surface: what meets a line is no farther from it."""

_DOUBTFUL = 5.0
"""Times that: what is in front by less may be in front or not."""

_STEEPEST = 0.02
"""Cosine between a surface and the view: what is seen still more obliquely says nothing."""

_WIDER = 0.3
"""Of the tolerance: lines no farther from a point than its nearest one and this count as well."""

_FRONTMOST = 6
"""Lines at a point that rays are cast from: those nearest to the viewer."""

_LONGEST_MM = 2.0
"""Of the pieces among which lines near a point are looked for."""


@dataclass(frozen=True, slots=True, eq=False)
class Truth:
    """What is true at n points.

    always    (n,) of lines that every drawing shows: NOTHING, UNCLEAR, HIDDEN or VISIBLE
    optional  (n,) the same of lines that a drawing may show or leave out, such as smooth edges and seams
    hidden    (n,) whether any line there is hidden, though a visible one may run there as well
    covered   (n,) whether a visible line runs within reach, which every drawing shows
    away      (n,) millimetres on paper to the nearest line; infinite where it is farther than was looked for
    depth     (n,) millimetres in the model by which the nearest face that hides is in front; nan where none does
    by        (n,) number of the part that hides; -1: none
    """

    always: npt.NDArray[np.int8]
    optional: npt.NDArray[np.int8]
    hidden: Bools
    covered: Bools
    away: Floats
    depth: Floats
    by: Ints


def truth(model: TrueLines, points: Floats, ways: Floats, reach_mm: float) -> Truth:
    """What is true at points (n, 2) on paper, where lines run in directions (n, 2).

    reach_mm: how far from a point a line of the model may run
    """
    count = len(points)
    always, optional = (np.full(count, NOTHING, np.int8) for _ in range(2))
    hidden, covered = np.zeros(count, bool), np.zeros(count, bool)
    away, depth, by = np.full(count, np.inf), np.full(count, np.nan), np.full(count, -1, np.int32)
    whose, places, number, off = _beside(model, points, ways, reach_mm)
    np.minimum.at(away, whose, off)
    free_to_choose = np.array([row.option is not None and row.occt != "sharp" for row in by_number()])
    choice = free_to_choose[model.kind[number]]
    close = off <= away[whose] + _WIDER * reach_mm
    for chosen, out in ((~choice, always), (choice, optional)):
        which = np.flatnonzero(chosen)
        # All lines nearby, and those that may be this one; of each the nearest to the viewer.
        which = np.union1d(*(some[_frontmost(whose[some], places[some, 2])] for some in (which, which[close[which]])))
        state, front, triangle = _seen(model, places[which], ways[whose[which]])
        if out is always:
            covered[whose[which[state == VISIBLE]]] = True
        this = close[which]
        which, state, front, triangle = which[this], state[this], front[this], triangle[this]
        np.maximum.at(out, whose[which], state)
        hides = np.flatnonzero(state == HIDDEN)
        hidden[whose[which[hides]]] = True
        for n in hides[np.argsort(-front[hides], kind="stable")].tolist():
            depth[whose[which[n]]], by[whose[which[n]]] = front[n] / model.per_mm, model.part[triangle[n]]
    return Truth(always, optional, hidden, covered, away, depth, by)


def _beside(model: TrueLines, points: Floats, ways: Floats, reach_mm: float) -> tuple[Index, Floats, Index, Floats]:
    """Pairs of a point and a line of the model near it: point (k,), place on the line (k, 3), its number, how far.

    The line has to run about as the drawing's does; outlines of a mesh zigzag and may run in any direction.
    """
    spots = spots_at(points)
    owner = np.arange(len(model.start))
    lines = _as_pieces(model.start[:, :2], model.end[:, :2], owner).divided(_LONGEST_MM)
    found: list[tuple[Index, Floats, Index, Floats]] = []
    outline = np.array([row.occt == "outline" for row in by_number()])[model.kind]
    for i, k in pairs(spots, lines, reach_mm):
        j = lines.line[k]
        a, b = lines.start[k], lines.end[k]
        way = b - a
        size = (way * way).sum(axis=1)
        share = np.clip(((points[i] - a) * way).sum(axis=1) / np.where(size > 0.0, size, 1.0), 0.0, 1.0)
        foot = a + share[:, None] * way
        off = np.hypot(*(points[i] - foot).T)
        cross = np.abs(way[:, 0] * ways[i, 1] - way[:, 1] * ways[i, 0])
        short = size <= (2.0 * model.error_mm) ** 2
        fits = (off <= reach_mm) & (outline[j] | short | (cross <= 0.5 * np.sqrt(size)))
        i, j, off, foot = i[fits], j[fits], off[fits], foot[fits]  # noqa: PLW2901 - the pairs that count
        whole = model.end[j] - model.start[j]
        flat = (whole[:, :2] ** 2).sum(axis=1)
        along = ((foot - model.start[j, :2]) * whole[:, :2]).sum(axis=1) / np.where(flat > 0.0, flat, 1.0)
        # Of a line along the sight the nearer end is what may be seen.
        nearer = np.maximum(model.start[j, 2], model.end[j, 2])
        z = np.where(flat > 0.0, model.start[j, 2] + along * whole[:, 2], nearer)
        found.append((i, np.column_stack([foot, z]), j, off))
    if not found:
        none = np.zeros(0, np.int64)
        return none, np.zeros((0, 3)), none, np.zeros(0)
    whose, places, number, distance = (np.concatenate(each) for each in zip(*found, strict=True))
    return whose, places, number, distance


def spots_at(points: Floats) -> Pieces:
    """Points (n, 2) as pieces without length."""
    return _as_pieces(points, points, np.arange(len(points)))


def _as_pieces(start: Floats, end: Floats, line: Index) -> Pieces:
    unknown = np.full(len(line), -1)
    others = len(fields(Pieces)) - 4
    return Pieces(np.ascontiguousarray(start), np.ascontiguousarray(end), end - start, line, *[unknown] * others)


def _frontmost(whose: Index, z: Floats) -> Index:
    """Of the pairs of each point those nearest to the viewer."""
    order = np.lexsort((-z, whose))
    new = np.append(True, np.diff(whose[order]) > 0)
    first = np.flatnonzero(new)
    rank = np.arange(len(order)) - first[np.cumsum(new) - 1] if len(order) else order
    return np.asarray(order[rank < _FRONTMOST])


def _seen(model: TrueLines, places: Floats, ways: Floats) -> tuple[npt.NDArray[np.int8], Floats, Ints]:
    """(n,) UNCLEAR, HIDDEN or VISIBLE; by how much (n,) the nearest face that hides is in front; its triangle (n,)."""
    normal = np.stack([-ways[:, 1], ways[:, 0]], axis=1) / np.maximum(np.hypot(*ways.T), 1e-300)[:, None]
    aside = model.error_mm * np.array([side * far for side in (1.0, -1.0) for far in ASIDE])
    clear, front, triangle = [], [], []
    for by in aside.tolist():
        spot = places[:, :2] + by * normal
        free, blocked, gap, hit = _one_ray(model, spot, places)
        clear.append(np.where(free, VISIBLE, np.where(blocked, HIDDEN, UNCLEAR)))
        front.append(np.where(blocked, gap, np.inf))
        triangle.append(hit)
    rays, gaps, hits = np.array(clear), np.array(front), np.array(triangle)
    one, other = (rays[:2] == VISIBLE).all(axis=0), (rays[2:] == VISIBLE).all(axis=0)
    hidden = (rays == HIDDEN).all(axis=0)
    state = np.where(one | other, VISIBLE, np.where(hidden, HIDDEN, UNCLEAR)).astype(np.int8)
    best = gaps.argmin(axis=0) if len(places) else np.zeros(0, np.int64)
    columns = np.arange(len(places))
    return state, gaps[best, columns], hits[best, columns].astype(np.int32)


def _one_ray(model: TrueLines, spot: Floats, places: Floats) -> tuple[Bools, Bools, Floats, Ints]:
    """From the viewer through spots (n, 2) beside places (n, 3): whether nothing, or surely something, is in front.

    Also by how much (n,), and the triangle (n,).
    """
    top = float(model.points[:, 2].max(initial=0.0)) + 1.0
    way = places[:, 2] + model.error_mm - top
    none = np.zeros(len(spot))
    origins = np.column_stack([spot, np.full(len(spot), top)])
    ways = np.column_stack([none, none, np.minimum(way, -1e-9)])
    share, hit = _kernel.first_hits(model.points, np.ascontiguousarray(model.triangles), origins, ways)
    met = np.flatnonzero(hit >= 0)
    a, b, c = (model.points[model.triangles[hit[met], k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    size = np.linalg.norm(normal, axis=1)
    facing = np.abs(normal[:, 2]) / np.where(size > 0.0, size, 1.0)
    steep = facing < _STEEPEST
    safe = np.where(normal[:, 2] == 0.0, 1.0, normal[:, 2])
    # The plane of what was met, where the line is.
    z = top + share[met] * ways[met, 2]
    shift = ((places[met, :2] - spot[met]) * normal[:, :2]).sum(axis=1) / safe
    gap = np.where(steep, z, z - shift) - places[met, 2]
    sure = _SURE * model.error_mm / np.maximum(facing, _STEEPEST)
    free, blocked, front = hit < 0, np.zeros(len(spot), bool), np.full(len(spot), np.inf)
    free[met] = ~steep & (gap <= sure)
    blocked[met] = gap > _DOUBTFUL * sure
    front[met] = gap
    return free, blocked, front, hit
