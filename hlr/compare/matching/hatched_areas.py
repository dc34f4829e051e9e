"""Hatches of two drawings, by the areas that they fill: the lines of a hatch may have any direction and spacing.

A stroke of one drawing crosses the lines on which the other has its strokes. At each crossing the other either has a
stroke as well, and then both are hatched there, or it has none::

        \\   \\   \\
      ---\\---\\---o---o---        the second drawing (\\) is hatched as far as the third line:
          \\   \\                  the rest of the stroke (---) is in the first drawing only

So areas are told apart that are wider than one and a half times the wider spacing of the two. The edges around an area
are compared as lines.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from hlr.compare.lines.pieces import Array, Floats, Index, Pieces, joined
from hlr.compare.lines.sketch import About
from hlr.compare.matching.hatch_edges import divided_by_edges, edges_of
from hlr.compare.matching.hatch_lines import HatchLines, hatches_of, runs_of
from hlr.drawing.chords import numbered
from hlr.linework.hatching import SPACINGS

_PARALLEL = 0.2
"""Sine of the angle between two hatches whose lines do not cross often enough."""

_BORDER = 3.0
"""Tolerances from the end of a stroke: there the border may lie on this side or that."""

_ON_LINE = 0.2
"""Tolerances: a stroke that lies no farther from a line of the other hatch ends where a stroke there does."""

_NAMELESS = 1 << 32
"""Number of the first part whose name is not known: more than a drawing has parts."""

_A_SPACING = 2
"""Places at which a stroke is looked at that is parallel to the other hatch, to a spacing of that."""


def told_apart(one: Pieces, other: Pieces) -> bool:
    """Whether both drawings say which of their lines are hatches."""
    return bool((one.kind >= 0).all() and (other.kind >= 0).all())


def without_hatches(one: Pieces, other: Pieces) -> tuple[Pieces, Pieces]:
    """The lines by which two drawings are laid on one another: without hatches where both say which those are."""
    if not told_apart(one, other):
        return one, other
    edges = [each.take(~hatches_of(each)) for each in (one, other)]
    return (edges[0], edges[1]) if all(map(len, edges)) else (one, other)


def by_part(pieces: Pieces) -> Pieces:
    """The same lines. Strokes of which a file does not say the part, or just a layer, have a part for each hatch."""
    hatches, part, nameless = hatches_of(pieces), pieces.part.copy(), _NAMELESS
    for number in np.unique(part[hatches]).tolist():
        own = hatches & (pieces.part == number)
        some = pieces.take(own)
        if number < 0 or HatchLines.of(some) is None:
            part[own] = nameless + runs_of(some)
            nameless = int(part[own].max()) + 1
    return replace(pieces, part=part)


@dataclass(frozen=True, slots=True, eq=False)
class Hatches:
    """The hatches of a drawing.

    lines  of each part that is hatched, by its number; None: they are not parallel, or not evenly spaced
    names  of all parts, as the other drawing may call them; empty: unknown
    edges  all that is visible but for hatches
    """

    pieces: Pieces
    lines: Mapping[int, HatchLines | None]
    names: tuple[str, ...]
    edges: Pieces

    @staticmethod
    def of(pieces: Pieces, about: About | None = None) -> Hatches:
        """The hatches among pieces, as of `by_part`. about: of the drawing; None: parts have no names."""
        some = pieces.take(hatches_of(pieces))
        lines = {part: HatchLines.of(some.take(some.part == part)) for part in np.unique(some.part).tolist()}
        return Hatches(some, lines, () if about is None else own_names(about), edges_of(pieces))

    def name(self, part: int) -> str | None:
        """The name of a part; None: unknown."""
        return self.names[part] if 0 <= part < len(self.names) else None

    def divided(self, other: Hatches, tolerance_mm: float, some: Pieces | None = None) -> tuple[Pieces, Pieces]:
        """The strokes that lie where the other drawing is hatched, and the others.

        Where that has a part of the same name, it has to be hatched there, unless its face is so small that it may lie
        between two lines. some: of the strokes; None: all
        """
        some = self.pieces if some is None else some
        inside, outside = [some.take(slice(0))], [some.take(slice(0))]
        for part in np.unique(some.part).tolist():
            left = some.take(some.part == part)
            named = self.name(part) in other.names
            same = [k for k in other.lines if not named or other.name(k) == self.name(part)]
            for k in same:
                own = _Own(self.lines[part], self.edges)
                both, left = _divided(left, own, other.lines[k], tolerance_mm, named)
                inside.append(both)
            speck = not same and float(left.lengths.sum()) < SPACINGS[0]
            (inside if speck else outside).append(left)
        return joined(inside), joined(outside)


def own_names(about: About) -> tuple[str, ...]:
    """The names of all parts, without those of the views of a page before them."""
    views = [f"{view}/" for name in about.views for view in name.split(" / ")]
    names = []
    for name in about.parts:
        before = next((view for view in views if name.startswith(view)), "")
        names.append(name.removeprefix(before))
    return tuple(names)


@dataclass(frozen=True, slots=True, eq=False)
class _Own:
    """What is drawn around strokes. lines: of all strokes of their hatch; edges: of their drawing."""

    lines: HatchLines | None
    edges: Pieces


def _divided(
    some: Pieces, own: _Own, other: HatchLines | None, tolerance_mm: float, named: bool
) -> tuple[Pieces, Pieces]:
    """Strokes of one hatch as far as they lie inside and outside the area of another.

    own: what is drawn around the strokes; named: whether the other is that of the part of the same name. Where
    nothing says on which lines the other has its strokes, all lies outside.
    """
    if other is None or not len(some) or not (named or other.meets(np.concatenate([some.start, some.end]))):
        return some.take(slice(0)), some
    strokes = _Strokes.of(some)
    samples = _samples(strokes, own, other, tolerance_mm)
    silent = np.setdiff1d(np.arange(len(strokes.length)), samples.stroke)
    # A stroke that crosses no line lies inside where that can be.
    can = named | other.around(strokes.at(silent, np.full(len(silent), 0.5)))
    inside = np.concatenate([strokes.intervals(samples.turned()), strokes.whole(silent[can])])
    outside = np.concatenate([strokes.intervals(samples), strokes.whole(silent[~can])])
    both, alone = (some.cut(each[np.argsort(each[:, 0], kind="stable")]) for each in (inside, outside))
    return both, alone


@dataclass(frozen=True, slots=True, eq=False)
class _Samples:
    """Places where strokes are looked at: the stroke, how far along it, 0 to 1, and whether the other is bare there."""

    stroke: Index
    share: Floats
    bare: Array

    def turned(self) -> _Samples:
        """Those that are bare as those that are not."""
        return replace(self, bare=~self.bare)

    @staticmethod
    def of(several: Sequence[_Samples]) -> _Samples:
        """All of them, stroke by stroke and along each."""
        stroke, share, bare = (np.concatenate([getattr(each, f.name) for each in several]) for f in fields(_Samples))
        order = np.lexsort((share, stroke))
        return _Samples(stroke[order], share[order], bare[order])


@dataclass(frozen=True, slots=True, eq=False)
class _Strokes:
    """Straight lines: start and end (n, 2), length (n,), and where each begins (n,) when all are laid end to end."""

    start: Floats
    end: Floats
    length: Floats
    place: Floats

    @staticmethod
    def of(pieces: Pieces) -> _Strokes:
        """The lines that the pieces are."""
        first = np.flatnonzero(np.diff(pieces.number_of_line, prepend=-1))
        last = np.append(first[1:], len(pieces)) - 1
        low, high = pieces.ends_of_lines()
        return _Strokes(pieces.start[first], pieces.end[last], high - low, low)

    def at(self, stroke: Index, share: Floats) -> Floats:
        """(n, 2) the points so far along these strokes."""
        return np.asarray(self.start[stroke] + share[:, None] * (self.end - self.start)[stroke])

    def whole(self, which: Index) -> Floats:
        """(n, 2) of these strokes from where to where they go, laid end to end."""
        return np.stack([self.place[which], self.place[which] + self.length[which]], axis=1)

    def intervals(self, samples: _Samples) -> Floats:
        """(n, 2) what is bare of all, laid end to end: as far as half way to a place that is not."""
        if not len(samples.stroke):
            return np.zeros((0, 2))
        new = np.diff(samples.stroke, prepend=-1) > 0
        half = 0.5 * (samples.share + np.append(0.0, samples.share[:-1]))
        low = np.where(new, 0.0, half)
        high = np.append(np.where(new, 1.0, half)[1:], 1.0)
        first = samples.bare & (new | ~np.append(False, samples.bare[:-1]))
        last = samples.bare & np.append(new[1:] | ~samples.bare[1:], True)
        whose = samples.stroke[first]
        shares = np.stack([low[first], high[last]], axis=1)
        return np.asarray(self.place[whose][:, None] + self.length[whose][:, None] * shares)


def _samples(strokes: _Strokes, own: _Own, other: HatchLines, tolerance_mm: float) -> _Samples:
    """Where strokes say whether the other hatch is there."""
    ways = strokes.end - strokes.start
    steep = np.abs(ways @ other.across) > _PARALLEL * strokes.length
    crossing = _where_they_cross(strokes, np.flatnonzero(steep), other, tolerance_mm)
    return _Samples.of([crossing, _beside(strokes, np.flatnonzero(~steep), own, other, tolerance_mm)])


def _where_they_cross(strokes: _Strokes, which: Index, other: HatchLines, tolerance_mm: float) -> _Samples:
    """Where some strokes cross the lines of the other hatch, but for their ends."""
    border = _BORDER * tolerance_mm
    begin, end = other.level(strokes.start[which]), other.level(strokes.end[which])
    first = np.ceil(np.minimum(begin, end)).astype(np.int64)
    count = np.maximum(np.floor(np.maximum(begin, end)).astype(np.int64) - first + 1, 0)
    whose, number = numbered(count)
    line = first[whose] + number
    share = (line - begin[whose]) / (end - begin)[whose]
    length = strokes.length[which[whose]]
    within = np.minimum(share, 1.0 - share) * length >= border
    whose, line, share = which[whose[within]], line[within], share[within]
    return _Samples(whose, share, ~other.drawn(line, strokes.at(whose, share), border))


def _beside(strokes: _Strokes, which: Index, own: _Own, other: HatchLines, tolerance_mm: float) -> _Samples:
    """Strokes that are parallel to the other hatch: the lines of that on both sides of them say whether it is there.

    Where both are bare, that says something only if the strokes' own area reaches as far as one of them: its hatch has
    to be around that place, and no edge before it. Between teeth, the lines on both sides may run in the gaps.
    """
    border = _BORDER * tolerance_mm
    count = np.ceil(_A_SPACING * strokes.length[which] / other.spacing).astype(np.int64)
    whose, number = numbered(np.maximum(count, 1))
    share = (number + 0.5) / np.maximum(count, 1)[whose]
    whose = which[whose]
    points = strokes.at(whose, share)
    level = other.level(points)
    on_line = np.abs(level - np.rint(level)) * other.spacing <= _ON_LINE * tolerance_mm
    lines = [np.where(on_line, np.rint(level), line).astype(np.int64) for line in (np.floor(level), np.ceil(level))]
    there = [other.drawn(line, points, np.where(on_line, 0.0, border)) for line in lines]
    bare = ~(there[0] | there[1])
    reaches = on_line | (own.lines is None)
    if own.lines is not None:
        for line in lines:
            looked = np.flatnonzero(bare & ~reaches)
            foot = points[looked] + ((line - level)[looked] * other.spacing)[:, None] * other.across
            reaches[looked] = _one_area(points[looked], foot, own.lines, own.edges, tolerance_mm)
    return _Samples(whose, share, bare & reaches)


def _one_area(points: Floats, foot: Floats, lines: HatchLines, edges: Pieces, tolerance_mm: float) -> Array:
    """(n,) whether the area of a hatch around points (n, 2) reaches to a place (n, 2) beside each."""
    height, border = lines.level(foot), _BORDER * tolerance_mm
    around = np.logical_and(
        *(lines.drawn(side.astype(np.int64), foot, border) for side in (np.floor(height), np.ceil(height)))
    )
    near = np.flatnonzero(around)
    around[near] = ~divided_by_edges(points[near], foot[near], edges, tolerance_mm)
    return np.asarray(around)
