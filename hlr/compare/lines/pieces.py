"""Lines as straight pieces, in arrays: what two drawings are compared by."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr.drawing.chords import numbered

Array = npt.NDArray[Any]
Floats = npt.NDArray[np.float64]
Index = npt.NDArray[np.int64]

_APART = 1.0
"""Millimetres between two lines that are laid end to end."""


@dataclass(frozen=True, slots=True, eq=False)
class Pieces:
    """n straight pieces. Pieces of one line stand together, in their order along it.

    start, end  (n, 2) millimetres on paper, y up
    along       (n, 2) the direction that the line takes around a piece: a chord of two tolerances or more, where the
                line is as long as that
    line        (n,) number of the line, ascending
    kind        (n,) number of the line class; -1: unknown
    visible     (n,) 1 visible, 0 hidden, -1 unknown
    part, edge  (n,) as of the drawing; -1: unknown
    view        (n,) number of the view of a page; -1: there is one view
    curved      (n,) 1: a chord of an arc or a spline, 0: as straight as in the file
    """

    start: Floats
    end: Floats
    along: Floats
    line: Index
    kind: Index
    visible: Index
    part: Index
    edge: Index
    view: Index
    curved: Index

    def __len__(self) -> int:
        return len(self.line)

    @property
    def lengths(self) -> Floats:
        """(n,) millimetres."""
        return np.asarray(np.hypot(*(self.end - self.start).T))

    @property
    def places(self) -> Floats:
        """(n,) where each piece begins when all lines are laid end to end, with a gap between two lines."""
        lengths = self.lengths
        return np.asarray(np.cumsum(lengths) - lengths + self.number_of_line * _APART)

    @property
    def number_of_line(self) -> Index:
        """(n,) the lines counted from 0, without a gap."""
        new = np.ones(len(self), np.int64)
        new[1:] = self.line[1:] != self.line[:-1]
        return np.asarray(np.cumsum(new) - 1)

    @property
    def extent(self) -> Floats:
        """(2,) width and height of the rectangle around all of them; zeros where there is none."""
        if not len(self):
            return np.zeros(2)
        return np.asarray(np.maximum(self.start, self.end).max(axis=0) - np.minimum(self.start, self.end).min(axis=0))

    def ends_of_lines(self) -> tuple[Floats, Floats]:
        """(m,), (m,) where each line begins and ends when all are laid end to end."""
        if not len(self):
            return np.zeros(0), np.zeros(0)
        last = np.append(self.line[1:] != self.line[:-1], True)
        first = np.append(True, last[:-1])
        return self.places[first], (self.places + self.lengths)[last]

    def take(self, which: Array | slice) -> Pieces:
        """Some of the pieces."""
        return Pieces(*(getattr(self, f.name)[which] for f in fields(self)))

    def shifted(self, by: Floats) -> Pieces:
        """All of them moved by (x, y) millimetres."""
        return replace(self, start=self.start + by, end=self.end + by)

    def mapped(self, matrix: Floats) -> Pieces:
        """All of them turned, mirrored or scaled: matrix (2, 2) @ point."""
        start, end, along = (each @ matrix.T for each in (self.start, self.end, self.along))
        return replace(self, start=start, end=end, along=along)

    def cut(self, intervals: Floats) -> Pieces:
        """What lies in intervals (k, 2) of the lines laid end to end, ascending; each interval becomes a line."""
        places, lengths = self.places, self.lengths
        first = np.searchsorted(places + lengths, intervals[:, 0], "right")
        last = np.searchsorted(places, intervals[:, 1], "left")
        whose, number = numbered(np.maximum(last - first, 0))
        which = first[whose] + number
        long = np.where(lengths[which] > 0.0, lengths[which], 1.0)
        low, high = (np.clip((intervals[whose, side] - places[which]) / long, 0.0, 1.0)[:, None] for side in (0, 1))
        found = self.take(which)
        way = found.end - found.start
        start, end = found.start + low * way, found.end - (1.0 - high) * way
        return replace(found, start=start, end=end, line=whose)

    def divided(self, longest: float) -> Pieces:
        """The same lines in pieces of at most so many millimetres."""
        count = np.maximum(np.ceil(self.lengths / longest), 1.0).astype(np.int64)
        whose, number = numbered(count)
        found = self.take(whose)
        way = (found.end - found.start) / count[whose][:, None]
        start = found.start + number[:, None] * way
        last = number == count[whose] - 1
        return replace(found, start=start, end=np.where(last[:, None], found.end, start + way))


def joined(several: Sequence[Pieces]) -> Pieces:
    """All pieces of several sets; lines are numbered anew."""
    columns = {f.name: np.concatenate([getattr(each, f.name) for each in several]) for f in fields(Pieces)}
    counts = [0, *(int(each.line.max(initial=-1)) + 1 for each in several[:-1])]
    first = np.repeat(np.cumsum(counts), [len(each) for each in several])
    return Pieces(**columns | {"line": columns["line"] + first})


def with_ways(pieces: Pieces, tolerance_mm: float) -> Pieces:
    """The pieces with `along` filled in, from what lies before and behind each on its line."""
    if not len(pieces):
        return pieces
    places, lengths = pieces.places, pieces.lengths
    low, high = (each[pieces.number_of_line] for each in pieces.ends_of_lines())
    middle, reach = places + 0.5 * lengths, np.maximum(tolerance_mm, 0.5 * lengths)
    at = np.stack([places, places + lengths], axis=1).ravel()
    points = np.stack([pieces.start, pieces.end], axis=1).reshape(-1, 2)
    ends = [
        np.stack([np.interp(where, at, points[:, axis]) for axis in (0, 1)], axis=1)
        for where in (np.maximum(middle - reach, low), np.minimum(middle + reach, high))
    ]
    return replace(pieces, along=ends[1] - ends[0])
