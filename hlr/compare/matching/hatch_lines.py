"""The hatch of one part of a drawing: parallel lines at one distance, and where on them strokes are drawn."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hlr.compare.lines.pieces import Array, Floats, Index, Pieces
from hlr.linework.hatching import SPACINGS
from hlr.tables.line_classes import LINE_CLASSES

_ONE_LINE_MM = 0.02
"""Strokes that lie less far apart, across their direction, are on one line: files round."""

_ROUND_ANGLE, _NEARLY = np.radians(15.0), np.radians(0.2)
"""Hatches lie at multiples of the one; a direction that is off by less than the other is meant to be that."""

_REGULAR = 0.1
"""Of the spacing: how far strokes may lie off the lines."""


@dataclass(frozen=True, slots=True, eq=False)
class HatchLines:
    """The lines of a hatch, endless and numbered, and the strokes on them.

    along, across  (2,) of length 1
    first          millimetres across, of line 0
    spacing        millimetres from line to line; where strokes lie on one line alone, more than it can be
    strokes        (n, 2) millimetres along, from and to; number (n,) of the line of each; both ascending
    width          more millimetres than there are along any line
    """

    along: Floats
    across: Floats
    first: float
    spacing: float
    number: Index
    strokes: Floats
    width: float

    @staticmethod
    def of(pieces: Pieces) -> HatchLines | None:
        """The lines that these pieces lie on; None: they are not parallel, or not evenly spaced."""
        ways = pieces.end - pieces.start
        along = _direction(ways)
        across = np.array([-along[1], along[0]])
        if np.abs(ways @ across).max(initial=0.0) > _ONE_LINE_MM:
            return None
        off = 0.5 * (pieces.start + pieces.end) @ across
        order = np.argsort(off, kind="stable")
        off = off[order]
        line = np.cumsum(np.diff(off, prepend=off[0]) > _ONE_LINE_MM)
        places = np.bincount(line, off) / np.bincount(line)
        found = _evenly(places)
        if found is None:
            return None
        first, spacing, number = found
        strokes = np.sort(np.stack([pieces.start @ along, pieces.end @ along], axis=1)[order], axis=1)
        by_place = np.lexsort((strokes[:, 0], line))
        width = 4.0 * float(np.abs(strokes).max()) + 1e4
        return HatchLines(along, across, first, spacing, number[line][by_place], strokes[by_place], width)

    def level(self, points: Floats) -> Floats:
        """(n,) of points (n, 2): 2.5 is half way between line 2 and line 3."""
        return np.asarray((points @ self.across - self.first) / self.spacing)

    def drawn(self, number: Index, points: Floats, reach_mm: Floats | float) -> Array:
        """(n,) whether there is a stroke on the line of this number (n,), beside points (n, 2)."""
        starts = self.number * self.width + self.strokes[:, 0]
        ends = np.maximum.accumulate(self.number * self.width + self.strokes[:, 1])
        at = number * self.width + points @ self.along
        before = np.searchsorted(starts, at + reach_mm, "right") - 1
        return np.asarray((before >= 0) & (ends[np.maximum(before, 0)] >= at - reach_mm))

    def around(self, points: Floats) -> Array:
        """(n,) whether points (n, 2) lie in the rectangle around the strokes, or less than a spacing outside it."""
        level, at = self.level(points), points @ self.along
        return np.asarray(self._across(level, level) & self._beside(at, at))

    def meets(self, points: Floats) -> bool:
        """Whether the rectangle around points (n, 2), along these lines, meets that of `around`."""
        level, at = self.level(points), points @ self.along
        return bool(self._across(level.min(), level.max()) & self._beside(at.min(), at.max()))

    def _across(self, low: Floats, high: Floats) -> Array:
        return np.asarray((high >= self.number[0] - 1.0) & (low <= self.number[-1] + 1.0))

    def _beside(self, low: Floats, high: Floats) -> Array:
        first, last = self.strokes[:, 0].min() - self.spacing, self.strokes[:, 1].max() + self.spacing
        return np.asarray((high >= first) & (low <= last))


def hatches_of(pieces: Pieces) -> Array:
    """(n,) which pieces belong to a hatch."""
    return np.asarray(pieces.kind == LINE_CLASSES["hatch"].number)


def runs_of(pieces: Pieces) -> Index:
    """(n,) which hatch each piece belongs to, by the order of the strokes: those of one face follow one another.

    A hatch ends where the direction changes, or where the next stroke goes back or lies between the lines so far.
    """
    first = np.flatnonzero(np.diff(pieces.number_of_line, prepend=-1))
    last = np.append(first[1:], len(pieces)) - 1
    middles, ways = 0.5 * (pieces.start[first] + pieces.end[last]), pieces.end[last] - pieces.start[first]
    run = np.zeros(len(first), np.int64)
    across, spacing = _across(ways[0]) if len(ways) else np.zeros(2), 0.0
    for k in range(1, len(first)):
        step = float((middles[k] - middles[k - 1]) @ across)
        times = round(step / spacing) if spacing else 1
        turned = abs(ways[k] @ across) > _ONE_LINE_MM
        if turned or times < 0 or (spacing and abs(step - times * spacing) > _REGULAR * abs(spacing)):
            run[k:] += 1
            across, spacing = _across(ways[k]), 0.0
        elif not spacing and abs(step) > _ONE_LINE_MM:
            spacing = step
    return np.asarray(run[pieces.number_of_line])


def _across(way: Floats) -> Floats:
    """(2,) of length 1, across a stroke."""
    along = _direction(way[None])
    return np.array([-along[1], along[0]])


def _direction(ways: Floats) -> Floats:
    """(2,) the direction that most of the length has."""
    turned = ways[:, 0] + 1j * ways[:, 1]
    angle = 0.5 * float(np.angle((turned**2 / np.maximum(np.abs(turned), 1e-300)).sum()))
    usual = round(angle / _ROUND_ANGLE) * _ROUND_ANGLE
    angle = usual if abs(angle - usual) < _NEARLY else angle
    return np.array([np.cos(angle), np.sin(angle)])


def _evenly(places: Floats) -> tuple[float, float, Index] | None:
    """Where line 0 is, the spacing, and the number of the line at each place, ascending; None: not evenly spaced."""
    gaps = np.diff(places)
    if not len(gaps):
        return float(places[0]), SPACINGS[-1], np.zeros(1, np.int64)
    spacing = _common(np.sort(gaps))
    if spacing is None:
        return None
    number = np.append(0, np.cumsum(np.rint(gaps / spacing))).astype(np.int64)
    spacing, first = np.polyfit(number, places, 1).tolist()
    if float(np.abs(first + spacing * number - places).max()) > _REGULAR * spacing:
        return None
    return first, spacing, number


def _common(gaps: Floats) -> float | None:
    """The largest length of which all gaps, ascending, are multiples; None: there is none."""
    spacing = float(gaps[0])
    while spacing > 2.0 * _ONE_LINE_MM:
        total, count = 0.0, 0.0
        for gap in gaps.tolist():
            mean = total / count if count else spacing
            times = round(gap / mean)
            rest = abs(gap - times * mean)
            if rest > _REGULAR * mean:
                spacing = rest
                break
            total, count = total + gap, count + times
        else:
            return total / count
    return None
