"""How much of one set of lines is covered by another, by length, within a tolerance.

A piece is covered where it runs in the direction of a piece of the other set and is no farther than the tolerance from
it. Around a straight piece that region is convex, so each pair gives one interval, computed exactly. Where lines are
split, which way they run, and whether there are two on top of one another makes no difference to the union.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from hlr.compare.lines.pieces import Array, Floats, Index, Pieces
from hlr.compare.matching.near import pairs

STEEPEST = 0.42
"""Sine of the largest angle between two pieces that cover one another."""

_ALWAYS = 0.05
"""Sine of an angle at which they always do."""

_NOTHING_MM = 1e-6
"""A shorter length is a rounding error."""

_FEW = 4
"""Times as many pieces on the other side: looking for the very same ones would take longer than measuring."""

_ISLAND = 4.0
"""Tolerances: a shorter covered length between two uncovered ones is where lines cross."""


@dataclass(frozen=True, slots=True)
class Rule:
    """When a piece covers another.

    reach_mm      how far apart they may lie
    tolerance_mm  what counts as no difference; lines shorter than that have no direction
    same          columns of `Pieces` in which they have to agree; what is unknown agrees with everything
    any_way       whether the direction does not matter
    """

    reach_mm: float
    tolerance_mm: float
    same: tuple[str, ...] = ()
    any_way: bool = False


def divided_by(a: Pieces, b: Pieces, rule: Rule) -> tuple[Pieces, Pieces]:
    """The lines of a, divided into what b covers and what it does not.

    A length counts as uncovered where some of it is out of reach of b; it then begins where the other line ends.
    """
    bare = _bare(a, b, rule)
    short = bare[:, 1] - bare[:, 0] < rule.tolerance_mm
    if short.any() and not rule.any_way:
        # Near a corner the direction of a short length says nothing.
        tested = a.cut(bare[short])
        far = _bare(tested, b, Rule(rule.reach_mm, rule.tolerance_mm, rule.same, any_way=True))
        keep = ~short
        if len(far):
            first, last = tested.ends_of_lines()
            hit = np.zeros(len(first), bool)
            hit[np.searchsorted(last, far[:, 0], "right").clip(0, len(hit) - 1)] = True
            keep[np.flatnonzero(short)] = hit
        bare = bare[keep]
    return a.cut(_complement(a, bare)), a.cut(bare)


def once(a: Pieces, rule: Rule) -> tuple[Pieces, Pieces]:
    """The lines of a without what is drawn already, and what is: lines on top of one another count once.

    A line goes under those before it in the file; a hidden one also under all visible ones that the rule lets cover it.
    What sticks out by less than the tolerance goes with the rest.
    """
    if not len(a):
        return a, a
    covered: list[Floats] = []
    places = a.places
    order = (a.visible == 0) * (a.line[-1] + 1) + a.line
    for i, j in _fitting(a, a, rule):
        earlier = order[j] < order[i]
        i, j = i[earlier], j[earlier]  # noqa: PLW2901 - the pairs that count
        (low, high), _ = _intervals(a, a, i, j, rule.reach_mm)
        some = high > low
        covered.append(np.stack([low[some], high[some]], axis=1) + places[i[some]][:, None])
    left = _gaps(a, covered)
    whole = np.isin(left[:, 0], a.ends_of_lines()[0]) & np.isin(left[:, 1], a.ends_of_lines()[1])
    left = left[whole | (left[:, 1] - left[:, 0] > rule.tolerance_mm)]
    return a.cut(left), a.cut(_complement(a, left))


def partners(a: Pieces, b: Pieces, rule: Rule) -> tuple[Index, Floats]:
    """For each piece of a the nearest of b that covers some of it, or -1, and how far its middle is from it."""
    nearest, least = np.full(len(a), -1), np.full(len(a), np.inf)
    for i, j in _fitting(a, b, rule):
        off = _distance(0.5 * (a.start[i] + a.end[i]), b, j)
        order = np.lexsort((j, off, i))
        best = order[np.diff(i[order], prepend=-1) > 0]
        better = best[off[best] < least[i[best]]]
        nearest[i[better]], least[i[better]] = j[better], off[better]
    return nearest, least


def _bare(a: Pieces, b: Pieces, rule: Rule) -> Floats:
    """(k, 2) lengths of the lines of a, laid end to end, that b does not cover."""
    tight: list[Floats] = []
    loose: list[Floats] = []
    places = a.places
    twin = _twins(a, b, rule.same) if _FEW * len(a) > len(b) else np.zeros(len(a), bool)
    whole = np.stack([places, places + a.lengths], axis=1)[twin]
    tight.append(whole)
    loose.append(whole)
    rest = np.flatnonzero(~twin)
    few = a.take(rest)
    for of_few, j in _fitting(few, b, rule):
        i = rest[of_few]
        strict, wide = _intervals(a, b, i, j, rule.reach_mm)
        for found, (low, high) in ((tight, strict), (loose, wide)):
            some = high > low
            found.append(np.stack([low[some], high[some]], axis=1) + places[i[some]][:, None])
    outside = _gaps(a, loose)
    outside = outside[outside[:, 1] - outside[:, 0] > _NOTHING_MM]
    around = _gaps(a, tight)
    counts = np.zeros(len(around), bool)
    counts[np.searchsorted(around[:, 0], 0.5 * outside.sum(axis=1), "right") - 1] = True
    return _without_islands(a, around[counts], _ISLAND * rule.tolerance_mm)


def _twins(a: Pieces, b: Pieces, same: tuple[str, ...]) -> Array:
    """(n,) whether b has the very same piece, number by number: most have one, and it need not be looked for nearby."""
    keys = []
    for each in (a, b):
        columns = [*np.concatenate([each.start, each.end], axis=1).T, *(getattr(each, name) for name in same)]
        key = np.zeros(len(each), np.uint64)
        for column in columns:
            key = (key ^ np.ascontiguousarray(column).view(np.uint64)) * np.uint64(0x9E3779B97F4A7C15)
            key ^= key >> np.uint64(29)
        keys.append(key)
    return np.isin(keys[0], keys[1])


def _fitting(a: Pieces, b: Pieces, rule: Rule) -> Iterator[tuple[Index, Index]]:
    """Batches of pairs near one another that agree in what the rule asks for. Pieces without a length are in none."""
    some_a, some_b = a.lengths > 0.0, b.lengths > 0.0
    for i, j in pairs(a, b, rule.reach_mm):
        fits = _alike(a, b, i, j, rule) & some_a[i] & some_b[j]
        yield i[fits], j[fits]


def _alike(a: Pieces, b: Pieces, i: Index, j: Index, rule: Rule) -> Array:
    """(n,) whether the pieces of each pair agree in what the rule asks for."""
    fits = np.ones(len(i), bool)
    for name in rule.same:
        one, other = getattr(a, name)[i], getattr(b, name)[j]
        fits &= (one == other) | (one < 0) | (other < 0)
    if rule.any_way:
        return fits
    u, v = a.along[i], b.along[j]
    long_u, long_v = np.hypot(*u.T), np.hypot(*v.T)
    shorter = np.maximum(np.minimum(long_u, long_v), 1e-12)
    steep = np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])
    most = np.clip(2.0 * rule.reach_mm / shorter, _ALWAYS, STEEPEST)
    return np.asarray(fits & ((steep <= most * long_u * long_v) | (shorter < 1.5 * rule.tolerance_mm)))


Interval = tuple[Floats, Floats]


def _intervals(a: Pieces, b: Pieces, i: Index, j: Index, reach: float) -> tuple[Interval, Interval]:
    """Where along a piece of a one of b lies beside it, and where it is within reach: millimetres, (low, high) each."""
    way, other = a.end[i] - a.start[i], b.end[j] - b.start[j]
    long, far = np.hypot(*way.T), np.hypot(*other.T)
    d, e = way / long[:, None], other / far[:, None]
    from_b = a.start[i] - b.start[j]
    u, v = (from_b * e).sum(axis=1), from_b[:, 1] * e[:, 0] - from_b[:, 0] * e[:, 1]
    du, dv = (d * e).sum(axis=1), d[:, 1] * e[:, 0] - d[:, 0] * e[:, 1]
    low, high = _between(u, du, np.zeros(len(u)), far)
    under, over = _between(v, dv, np.full(len(u), -reach), np.full(len(u), reach))
    low, high = np.maximum(low, under), np.minimum(high, over)
    none = high < low
    beside = np.where(none, np.inf, low), np.where(none, -np.inf, high)
    around = beside
    for shift in (np.zeros(len(u)), far):  # the half discs at both ends
        half = (u - shift) * du + v * dv
        root = half * half - (u - shift) ** 2 - v * v + reach * reach
        hit, root = root >= 0.0, np.sqrt(np.maximum(root, 0.0))
        around = (
            np.where(hit, np.minimum(around[0], -half - root), around[0]),
            np.where(hit, np.maximum(around[1], -half + root), around[1]),
        )
    return _clipped(beside, long), _clipped(around, long)


def _between(at: Floats, step: Floats, low: Floats, high: Floats) -> Interval:
    """The t for which low <= at + t step <= high."""
    flat = np.abs(step) < 1e-12
    safe = np.where(flat, 1.0, step)
    s, t = (low - at) / safe, (high - at) / safe
    inside = (at >= low) & (at <= high)
    first = np.where(flat, np.where(inside, -np.inf, np.inf), np.minimum(s, t))
    last = np.where(flat, np.where(inside, np.inf, -np.inf), np.maximum(s, t))
    return first, last


def _clipped(interval: Interval, long: Floats) -> Interval:
    return np.maximum(interval[0], 0.0), np.minimum(interval[1], long)


def _distance(points: Floats, b: Pieces, j: Index) -> Floats:
    """(n,) from each point to its piece of b."""
    way, off = b.end[j] - b.start[j], points - b.start[j]
    t = np.clip((off * way).sum(axis=1) / (way * way).sum(axis=1), 0.0, 1.0)
    return np.asarray(np.hypot(*(off - t[:, None] * way).T))


def _gaps(a: Pieces, covered: list[Floats]) -> Floats:
    """(k, 2) of the lines of a, laid end to end, what no interval covers, ascending."""
    first, last = a.ends_of_lines()
    if not len(first):
        return np.zeros((0, 2))
    # What lies between two lines is nobody's.
    between = np.stack([np.append(-np.inf, last), np.append(first, np.inf)], axis=1)
    every = np.concatenate([between, *covered])
    every = every[np.argsort(every[:, 0], kind="stable")]
    reached = np.maximum.accumulate(every[:, 1])
    gaps = np.stack([reached[:-1], every[1:, 0]], axis=1)
    return gaps[gaps[:, 1] > gaps[:, 0]]


def _complement(a: Pieces, intervals: Floats) -> Floats:
    """What is left of the lines of a beside the intervals."""
    left = _gaps(a, [intervals])
    return left[left[:, 1] - left[:, 0] > _NOTHING_MM]


def _without_islands(a: Pieces, intervals: Floats, widest: float) -> Floats:
    """Intervals of one line with less than `widest` between them become one."""
    if len(intervals) < 2:
        return intervals
    line = np.searchsorted(a.ends_of_lines()[0], intervals[:, 0] + _NOTHING_MM, "right")
    apart = (intervals[1:, 0] - intervals[:-1, 1] > widest) | (line[1:] != line[:-1])
    first, last = np.append(True, apart), np.append(apart, True)
    return np.stack([intervals[first, 0], intervals[last, 1]], axis=1)
