"""Where two faces are tangent along their common edge, from their true surfaces and along the whole of it.

The nodes of an edge's polygon are no fair sample of it: a straight edge has two, however its free-form faces turn
between them, and where a tessellation falls must not decide whether a line is drawn. So the surfaces at every edge of a
free-form face are compared at places of the edge itself, close enough to be sure:

    ::

        knots of the curve in (u, v)   |               |               |
        knots of either surface          |    |    |      |    |    |
        places compared                ........................... ...

Between two breaks surfaces and curve are smooth, and a span has several places. Where the faces are
tangent along one stretch and meet at an angle along another, the edge falls into pieces, each of its own class.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from hlr import _kernel
from hlr.source.geometry import NONE, SPLINE, Record, evaluated, packed
from hlr.source.model import Floats, Ints, SurfaceRecords
from hlr.source.surfaces import FaceSurfaces, SurfaceKind
from hlr.source.tables import Bools, starts

TANGENT = 0.01
"""Radians: surfaces that meet at less are tangent; what STEP and IGES readers assume as well."""

WAVERING, MOSTLY_TANGENT = 0.02, 0.008
"""Radians: surfaces that were fitted to one another waver about TANGENT along an edge. They are tangent where no place
is worse than the one, and the root of the mean square is less than the other."""

NEARLY_TANGENT = 0.1
"""Radians: an edge recorded as tangent is believed where its sides come as close as this somewhere, and faces that meet
at less do not interrupt a tangent edge."""

STEPS, STEPS_OF_SPAN = 16, 2
"""Least parts of an edge, and of a span of its curves in (u, v), in which crossed knots are sought; each is a break."""

PLACES = np.array([1e-6, 0.5, 1.0 - 1e-6])
"""Shares of the way from break to break at which the faces are compared: at a knot, on either side of it."""

MOST_BREAKS = 1000
"""Of one edge; surfaces with more knots across it are compared at fewer."""

SHORT_FOLD = 0.02
"""Of an edge's length: an angle along less says nothing of the edge. Where a face runs out to a point, its surface has
no normal to speak of."""

LONG_REST = 0.1
"""Of an edge's length: along less, faces that meet at an angle elsewhere may come tangent without the line being
interrupted, as where two pipes of one size cross."""


HALVINGS = 24
"""Of the step between two places, to find where faces begin to meet at an angle."""

Closer = Callable[[Floats], tuple[Floats, Floats]]
"""Angles (m,) and places (m, 3) at shares (m,) of one edge."""


@dataclass(frozen=True, slots=True)
class Tangency:
    """How the two faces at an edge meet.

    smooth        (k,) bool of its pieces, from the first vertex to the last
    points        (k-1, 3) where they join, in the root's frame
    parameters    (k-1,) the same on the edge's curve
    """

    smooth: Bools
    points: Floats
    parameters: Floats


@dataclass(frozen=True, slots=True)
class Side:
    """An edge on one of its faces: curve in (u, v), number of the surface, the face's (3, 4) place and sense."""

    curve: Record
    surface: int
    place: Floats
    sign: float


@dataclass(frozen=True, slots=True)
class FreeEdge:
    """An edge between two faces of which one is free-form: its two sides, (first, last) parameter, whether a file or a
    modeller recorded it as tangent."""

    sides: tuple[Side, Side]
    ends: tuple[float, float]
    recorded: bool


def tangencies(edges: Sequence[FreeEdge], surfaces: FaceSurfaces) -> list[Tangency | None]:
    """How the faces meet at each edge; None where their surfaces cannot be asked."""
    result: list[Tangency | None] = [None] * len(edges)
    sides = [side for edge in edges for side in edge.sides]
    if not sides:
        return result
    used, which = np.unique([side.surface for side in sides], return_inverse=True)
    records = surfaces.records(used.tolist())
    known = (records.kind[which] != SurfaceKind.UNKNOWN) & np.array([side.curve[0] != NONE for side in sides])
    judge = _Judge(sides, which.astype(np.int32), records)
    edge, share = judge.places(np.flatnonzero(known.reshape(-1, 2).all(axis=1)).astype(np.int32))
    angle, point = judge.angles(edge, share)
    usable = np.isfinite(angle)
    edge, share, angle, point = edge[usable], share[usable], angle[usable], point[usable]
    first = np.flatnonzero(np.diff(edge, prepend=-1))
    if not len(first):
        return result
    least, most = np.minimum.reduceat(angle, first), np.maximum.reduceat(angle, first)
    for i, low, high, begin, end in zip(
        edge[first].tolist(), least, most, first, np.append(first[1:], len(edge)), strict=True
    ):
        if high <= TANGENT or low > NEARLY_TANGENT:
            result[i] = _whole(bool(high <= TANGENT))
        else:
            closer = partial(judge.angles_of, i)
            result[i] = _pieces(edges[i], share[begin:end], angle[begin:end], point[begin:end], closer)
    return result


class _Judge:
    """Evaluates all sides of all edges together; the sides of edge i are 2 i and 2 i + 1."""

    def __init__(self, sides: list[Side], which: Ints, records: SurfaceRecords) -> None:
        self.sides, self.which, self.records = sides, which, records
        self.curves = packed([side.curve for side in sides])
        self.place = np.array([side.place for side in sides])
        self.sign = np.array([side.sign for side in sides])

    def uv(self, side: Ints, share: Floats) -> Floats:
        """(m, 2) at shares of the ranges of sides' curves."""
        first, last = self.curves.range[side].T
        return evaluated(self.curves, side, first + share * (last - first))[:, 0, :2]

    def places(self, edges: Ints) -> tuple[Ints, Floats]:
        """Edges, ascending, and the shares of their length, ascending, at which their faces are compared."""
        edge, share = self._spans(edges)
        count = np.bincount(edge, minlength=int(edges.max(initial=-1)) + 1)  # one more than it has spans
        parts = np.maximum(STEPS_OF_SPAN, -(-STEPS // np.maximum(count - 1, 1)))[edge]
        edge, share = _divided(edge, share, parts)
        found = [(edge, share)]
        for k in (0, 1):
            side = (2 * edge + k).astype(np.int32)
            uv = self.uv(side, share)
            for surface in np.unique(self.which[side]).tolist():
                begin, end = self.records.offsets[surface : surface + 2]
                mine = np.flatnonzero((self.which[side][:-1] == surface) & (edge[1:] == edge[:-1]))
                knots = _surface_knots(int(self.records.kind[surface]), self.records.data[begin:end])
                for axis in (0, 1):
                    if len(knots[axis]):
                        found.append(_crossings(edge, share, uv[:, axis], mine, knots[axis]))
        edge, share = _ascending(*(np.concatenate(column) for column in zip(*found, strict=True)))
        rank = np.arange(len(edge)) - np.searchsorted(edge, edge)
        most = np.bincount(edge, minlength=1)[edge]
        keep = (rank == most - 1) | (rank % (most // MOST_BREAKS + 1) == 0)
        edge, share = edge[keep], share[keep]
        inner = np.flatnonzero(edge[1:] == edge[:-1])
        step = share[inner + 1] - share[inner]
        return np.repeat(edge[inner], len(PLACES)), (share[inner, None] + PLACES * step[:, None]).ravel()

    def _spans(self, edges: Ints) -> tuple[Ints, Floats]:
        """Edges, and shares of their length between which both of their curves in (u, v) are smooth; the ends too."""
        found = [(edges, np.zeros(len(edges))), (edges, np.ones(len(edges)))]
        curves = self.curves
        for i in edges.tolist():
            for side in (2 * i, 2 * i + 1):
                first, last = curves.range[side]
                if curves.kind[side] == SPLINE and last > first:
                    knots = _spline_knots(curves.values[curves.offsets[side] : curves.offsets[side + 1]])
                    share = (knots - first) / (last - first)
                    share = share[(share > 0.0) & (share < 1.0)]
                    found.append((np.full(len(share), i, np.int32), share))
        return _ascending(*(np.concatenate(column) for column in zip(*found, strict=True)))

    def angles(self, edge: Ints, share: Floats) -> tuple[Floats, Floats]:
        """(m,) between the faces, NaN where one has no normal, and (m, 3) the places."""
        (point, one), (_, two) = (self._normals((2 * edge + k).astype(np.int32), share) for k in (0, 1))
        cross = np.sqrt((_cross(one, two) ** 2).sum(axis=1))
        angle = np.arctan2(cross, (one * two).sum(axis=1))
        angle[~(one.any(axis=1) & two.any(axis=1))] = np.nan
        return angle, point

    def angles_of(self, edge: int, share: Floats) -> tuple[Floats, Floats]:
        """The same at places of one edge."""
        alone = _Judge(self.sides[2 * edge : 2 * edge + 2], np.arange(2, dtype=np.int32), self._records_of(edge))
        return alone.angles(np.zeros(len(share), np.int32), share)

    def _records_of(self, edge: int) -> SurfaceRecords:
        r, two = self.records, self.which[2 * edge : 2 * edge + 2]
        data = [r.data[r.offsets[i] : r.offsets[i + 1]] for i in two]
        return SurfaceRecords(r.kind[two], starts([len(d) for d in data]), np.concatenate(data))

    def _normals(self, side: Ints, share: Floats) -> tuple[Floats, Floats]:
        """(m, 3) points and outward unit normals in the root's frame; 0 where there is none."""
        r = self.records
        found = _kernel.surface_points(
            r.kind, r.offsets, r.data, self.which[side], np.ascontiguousarray(self.uv(side, share))
        )
        place = self.place[side]
        turned = [(place[:, :, :3] * found[:, k, None, :]).sum(axis=2) for k in range(3)]
        normal = _cross(turned[1], turned[2]) * self.sign[side][:, None]
        longest = np.maximum((turned[1] ** 2).sum(axis=1), (turned[2] ** 2).sum(axis=1))
        area = np.sqrt((normal**2).sum(axis=1))
        sound = area > 1e-7 * longest
        normal[~sound] = 0.0
        normal[sound] /= area[sound, None]
        return turned[0] + place[:, :, 3], normal


def _spline_knots(values: Floats) -> Floats:
    degree, poles = int(values[0]), int(values[1])
    return values[3 : 3 + poles + degree + 1]


def _surface_knots(kind: int, data: Floats) -> tuple[Floats, Floats]:
    """Where a surface's u and v derivatives may jump."""
    none = np.zeros(0)
    match kind:
        case SurfaceKind.OFFSET:
            return _surface_knots(int(data[1]), data[2:])
        case SurfaceKind.REVOLUTION:
            return none, _spline_knots(data[7:]) if data[6] == SPLINE else none
        case SurfaceKind.EXTRUSION:
            return _spline_knots(data[4:]) if data[3] == SPLINE else none, none
        case SurfaceKind.SPLINE:
            u, v, m, n = data[:4].astype(int)
            result, at = [], 6
            for degree, poles, period in ((u, m, data[4]), (v, n, data[5])):
                knots = data[at : at + degree + poles + 1]
                at += len(knots)
                # Parameters of a closed surface may run past its end.
                result.append(np.unique(np.concatenate([knots - period, knots, knots + period])))
            return result[0], result[1]
    return none, none


def _divided(edge: Ints, share: Floats, parts: Ints) -> tuple[Ints, Floats]:
    """Ascending shares of edges, each step between two of one edge in so many equal parts."""
    step = np.append(np.where(edge[1:] == edge[:-1], share[1:] - share[:-1], 0.0), 0.0)
    count = np.where(step > 0.0, parts, 1)
    at = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
    return np.repeat(edge, count), np.repeat(share, count) + at * np.repeat(step / count, count)


def _ascending(edge: Ints, share: Floats) -> tuple[Ints, Floats]:
    """Sorted by edge, then share; what is nearly equal stands once."""
    order = np.lexsort((share, edge))
    edge, share = edge[order], share[order]
    keep = np.ones(len(edge), bool)
    keep[1:] = (edge[1:] != edge[:-1]) | (share[1:] - share[:-1] > 1e-9)
    return edge[keep].astype(np.int32), share[keep]


def _crossings(edge: Ints, share: Floats, parameter: Floats, steps: Any, knots: Floats) -> tuple[Ints, Floats]:
    """Where a parameter passes a knot in steps from one place to the next."""
    here, there = parameter[steps], parameter[steps + 1]
    first = np.searchsorted(knots, np.minimum(here, there), "right")
    count = np.maximum(np.searchsorted(knots, np.maximum(here, there), "left") - first, 0)
    step = np.repeat(np.arange(len(count)), count)
    knot = knots[np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count) + np.repeat(first, count)]
    way = (knot - here[step]) / (there[step] - here[step])
    at = steps[step]
    return edge[at], share[at] + way * (share[at + 1] - share[at])


def _cross(a: Floats, b: Floats) -> Floats:
    return np.stack([a[:, i - 2] * b[:, i - 1] - a[:, i - 1] * b[:, i - 2] for i in range(3)], axis=1)


def _whole(smooth: bool) -> Tangency:
    """An edge in one piece."""
    return Tangency(np.array([smooth]), np.zeros((0, 3)), np.zeros(0))


def _pieces(edge: FreeEdge, share: Floats, angle: Floats, point: Floats, closer: Closer) -> Tangency:
    """The pieces of one edge, from angles between its faces at shares of its curve; closer: those at other shares."""
    step = np.sqrt((np.diff(point, axis=0) ** 2).sum(axis=1))
    length = 0.5 * (np.append(step, 0.0) + np.append(0.0, step))
    total = length.sum()
    length = length / total if total > 0.0 else np.full(len(length), 1.0 / len(length))
    if length[angle <= TANGENT].sum() >= LONG_REST:
        # Where the parameters of a surface run back for a while, its normal is turned round and says nothing.
        angle = np.where(angle > np.pi - NEARLY_TANGENT, 0.0, angle)
    smooth = angle <= TANGENT
    short = ~smooth & (_run_sums(smooth, length) < SHORT_FOLD)
    if length[short].sum() < 2.0 * SHORT_FOLD:
        smooth |= short
        angle = np.where(short, 0.0, angle)
    # An angle that is hardly one makes no piece of its own: it waves, and the whole edge is tangent or is not.
    clear = ~smooth & (_run_peaks(smooth, angle) > NEARLY_TANGENT)
    if not clear.any():
        root_mean_square = float(np.sqrt((length * angle**2).sum()))
        wavering = angle.max() <= WAVERING and root_mean_square <= MOSTLY_TANGENT
        return _whole(bool(angle.max() <= TANGENT or wavering or edge.recorded))
    smooth &= _run_sums(smooth, length) >= LONG_REST
    change = np.flatnonzero(smooth[1:] != smooth[:-1])
    at = _where_tangent(closer, share[change], share[change + 1], smooth[change])
    first, last = edge.ends
    return Tangency(smooth[np.append(0, change + 1)], closer(at)[1], first + at * (last - first))


def _where_tangent(closer: Closer, low: Floats, high: Floats, smooth: Bools) -> Floats:
    """Shares between low and high at which the angle passes the limit; smooth: whether it is less at the low one."""
    for _ in range(HALVINGS if len(low) else 0):
        middle = 0.5 * (low + high)
        same = (closer(middle)[0] <= TANGENT) == smooth
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return 0.5 * (low + high)


def _runs(flag: Bools) -> Ints:
    """(n,) the number of the run of equal flags that each belongs to."""
    return np.append(0, np.cumsum(flag[1:] != flag[:-1])).astype(np.int32)


def _run_sums(flag: Bools, length: Floats) -> Floats:
    run = _runs(flag)
    return np.asarray(np.bincount(run, length)[run])


def _run_peaks(flag: Bools, angle: Floats) -> Floats:
    run = _runs(flag)
    peak = np.zeros(int(run[-1]) + 1)
    np.maximum.at(peak, run, angle)
    return np.asarray(peak[run])
