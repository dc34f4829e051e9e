"""What differs between two registered sides. Each stage takes on what the stages before it have not matched."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Any, Literal

import numpy as np

from hlr.compare.difference import KINDS, UNKNOWN, VERDICTS, Difference, Kind
from hlr.compare.lines.pieces import Floats, Pieces, joined
from hlr.compare.lines.sketch import CHORD_SHARE, About
from hlr.compare.matching.hatch_lines import hatches_of
from hlr.compare.matching.hatched_areas import Hatches, by_part, told_apart
from hlr.compare.matching.match import Rule, divided_by, once, partners
from hlr.compare.reading.sides import Side
from hlr.tables.line_classes import names


@dataclass(frozen=True, slots=True)
class Stage:
    """A row of the table below.

    kind   what lines are called that it matches; None: they are the same
    same   in what two lines have to agree
    reach  how far apart they may lie, in tolerances
    """

    kind: Kind | None
    same: tuple[str, ...]
    reach: float = 1.0


_MOVED = 10.1
"""Tolerances by which a line may be displaced that is still the same: ten, and what files round. Designers move edges
by a whole millimetre, which the usual ten tolerances are at full size; then the ending of a file must not decide."""

STAGES = (
    Stage(None, ("kind", "visible")),
    Stage("class changed", ("visible",)),
    Stage("visibility changed", ()),
    Stage("moved", ("kind", "visible"), reach=_MOVED),
)


_TWICE = 4.0 * CHORD_SHARE
"""Tolerances within which lines of one drawing are one line, drawn twice: two curves differ by two chords' errors."""

_MEETING = 20.0
"""Tolerances: over a shorter length, lines lie on one another where they meet at a small angle."""

_BENT = 1.5 * CHORD_SHARE
"""Tolerances: straight pieces that lie farther off a curve are not the curve."""

_ONE_WAY = 0.01
"""Radians within which pieces have one direction."""

_MOSTLY = 0.8
"""Share of a curve that lies beside straight pieces."""


@dataclass(slots=True)
class Findings:
    """Differences, and the pieces that show them. Pieces are (n, 2, 2), millimetres on paper: start and end of each.

    differences  by kind, the longest first
    traces       of each difference its pieces, in the same order
    same         what both sides share, as the first has it; None: nothing was compared
    moved        where the second has what is displaced
    rehatched    names of the parts that both have hatched in the same places, with other lines
    """

    differences: list[Difference] = field(default_factory=list)
    traces: list[Floats] = field(default_factory=list)
    same: Pieces | None = None
    moved: Floats = field(default_factory=lambda: np.zeros((0, 2, 2)))
    rehatched: tuple[str, ...] = ()

    @staticmethod
    def of(several: Sequence[Findings]) -> Findings:
        """All findings of several pairs of drawings."""
        every = [each.same for each in several if each.same is not None]
        return Findings(
            [found for each in several for found in each.differences],
            [trace for each in several for trace in each.traces],
            joined(every) if every else None,
            np.concatenate([np.zeros((0, 2, 2)), *(each.moved for each in several)]),
            tuple(dict.fromkeys(name for each in several for name in each.rehatched)),
        ).ranked()

    def ranked(self) -> Findings:
        """The same by kind, the longest first."""
        order = sorted(range(len(self.differences)), key=lambda n: _rank(self.differences[n]))
        return replace(self, differences=[self.differences[n] for n in order], traces=[self.traces[n] for n in order])

    def add(self, found: Difference, pieces: Pieces) -> None:
        """Add a difference, and the pieces that show it."""
        self.differences.append(found)
        self.traces.append(_ends(pieces))

    @property
    def same_mm(self) -> float:
        """Length that is the same in both."""
        return 0.0 if self.same is None else round(float(self.same.lengths.sum()), 6)

    @property
    def lengths_mm(self) -> dict[str, float]:
        """Millimetres of each kind of difference."""
        out = dict.fromkeys(KINDS, 0.0)
        for each in self.differences:
            out[each.kind] += each.length_mm
        return {kind: round(length, 4) for kind, length in out.items()}

    @property
    def verdicts_mm(self) -> dict[str, float]:
        """Millimetres of each verdict; empty where nothing was judged. Lines drawn twice are not."""
        out: dict[str, float] = {}
        for verdict in VERDICTS:
            length = sum(each.length_mm for each in self.differences if each.verdict == verdict)
            if verdict and length > 0.0:
                out[verdict] = round(length, 4)
        return out


def judged(before: Side, after: Side, tolerance_mm: float) -> Findings:
    """All differences; the longest of each kind first."""
    found = Findings()
    hatched = told_apart(before.pieces, after.pieces)
    if hatched:
        before, after = (replace(side, pieces=by_part(side.pieces)) for side in (before, after))
    a, b = before.pieces, after.pieces
    alone = a.take(slice(0)), b.take(slice(0))
    _doubled(found, before, "before", tolerance_mm)
    _doubled(found, after, "after", tolerance_mm)
    for stage in STAGES:
        rule = Rule(stage.reach * tolerance_mm, tolerance_mm, stage.same)
        (both, left_a), (also, left_b) = divided_by(a, b, rule), divided_by(b, a, rule)
        if stage.kind is None:
            found.same = both
            if before.about.foreign or after.about.foreign:
                _bent(found, both, b, rule, before.about, "before")
                _bent(found, also, a, rule, after.about, "after")
                found.same = once(both, Rule(_TWICE * tolerance_mm, tolerance_mm))[0]
            left_a, left_b = _seen(left_a, before, tolerance_mm), _seen(left_b, after, tolerance_mm)
            twice = Rule(_TWICE * tolerance_mm, tolerance_mm, stage.same)
            left_a, left_b = once(left_a, twice)[0], once(left_b, twice)[0]
            if hatched:
                alone = _hatched(found, (left_a, left_b), (before, after), tolerance_mm)
                left_a, left_b = left_a.take(~hatches_of(left_a)), left_b.take(~hatches_of(left_b))
        else:
            _changed(found, stage.kind, both, b, rule, (before.about, after.about))
        if stage.kind == "moved":
            found.moved = _ends(also)
        a, b = left_a, left_b
    for kind, pieces, side in (("gone", joined([a, alone[0]]), before), ("new", joined([b, alone[1]]), after)):
        for line in _lines(pieces):
            found.add(_difference(kind, line, side.about, "after" if kind == "new" else "before"), line)
    return found.ranked()


def _hatched(
    found: Findings, left: tuple[Pieces, Pieces], sides: tuple[Side, Side], tolerance_mm: float
) -> tuple[Pieces, Pieces]:
    """Of strokes that only one drawing has, those that lie where the other is not hatched. The others are the same."""
    one, other = (Hatches.of(side.pieces, side.about) for side in sides)
    strokes = [each.take(hatches_of(each)) for each in left]
    (both, gone), (also, new) = (
        one.divided(other, tolerance_mm, strokes[0]),
        other.divided(one, tolerance_mm, strokes[1]),
    )
    found.same = both if found.same is None else joined([found.same, both])
    names = _mostly_shared(one, both, gone) | _mostly_shared(other, also, new)
    found.rehatched = tuple(sorted(names))
    return gone, new


def _mostly_shared(whose: Hatches, both: Pieces, alone: Pieces) -> set[str]:
    """Names of the parts of which more strokes lie where both drawings are hatched than elsewhere.

    At the border to another part short ends of strokes seem to lie in its hatch.
    """
    parts = np.unique(both.part).tolist()
    most = [part for part in parts if _length_of(both, part) > _length_of(alone, part)]
    return {name for name in map(whose.name, most) if name}


def _length_of(pieces: Pieces, part: int) -> float:
    return float(pieces.lengths[pieces.part == part].sum())


def _doubled(found: Findings, side: Side, name: Literal["before", "after"], tolerance_mm: float) -> None:
    """Add what a side draws twice. Other programs draw hidden lines under visible ones, and an edge for each face."""
    if not side.about.foreign:
        return
    _, again = once(side.pieces, Rule(_TWICE * tolerance_mm, tolerance_mm))
    for line in _lines(again):
        if float(line.lengths.sum()) > _MEETING * tolerance_mm:
            found.add(_difference("doubled", line, side.about, name), line)


def _seen(left: Pieces, side: Side, tolerance_mm: float) -> Pieces:
    """Without hidden lines under visible ones of the same drawing, which nobody sees. hlr never draws those."""
    if not side.about.foreign:
        return left
    hidden, visible = (side.pieces.visible == value for value in (0, 1))
    under = divided_by(
        left.take(left.visible == 0), side.pieces.take(visible), Rule(_TWICE * tolerance_mm, tolerance_mm)
    )
    return joined([left.take(left.visible != 0), under[1]]) if hidden.any() else left


def _bent(
    found: Findings, both: Pieces, other: Pieces, rule: Rule, about: About, side: Literal["before", "after"]
) -> None:
    """Add the curves that are straight pieces in the other drawing, as far as that can be seen."""
    curves = both.take(both.curved == 1)
    if not len(curves):
        return
    quarter = 0.25 * (curves.end - curves.start)
    # The ends of chords lie on the curve, their middles do not.
    around = replace(curves, start=curves.start - quarter, end=curves.start + quarter)
    near, off = partners(around, other, rule)
    fits = (near >= 0) & (other.curved[np.maximum(near, 0)] == 0)
    off = np.where(fits, off, 0.0)
    starts = np.flatnonzero(np.append(True, curves.line[1:] != curves.line[:-1]))
    for first, line in zip(starts, _lines(curves), strict=True):
        here = slice(first, first + len(line))
        error = float(off[here].max())
        if error > _BENT * rule.tolerance_mm and fits[here].mean() > _MOSTLY:
            found.add(_difference("polyline", line, about, side, "straight pieces", error), line)


def _rank(found: Difference) -> tuple[int, float, float, float]:
    return KINDS.index(found.kind), -found.length_mm, *found.place


def _changed(found: Findings, kind: Kind, both: Pieces, b: Pieces, rule: Rule, abouts: tuple[About, About]) -> None:
    """Add the lines that have a partner in the second drawing, and what has become of them."""
    if not len(both):
        return
    about, foreign = abouts[0], any(each.foreign for each in abouts)
    near, off = partners(both, b, rule)
    starts = np.flatnonzero(np.append(True, both.line[1:] != both.line[:-1]))
    for first, line in zip(starts, _lines(both), strict=True):
        last = first + len(line)
        fits = near[first:last] >= 0
        weight = np.where(fits, line.lengths, 0.0)
        best = near[first:last][int(np.argmax(weight))]
        became = ""
        if kind == "class changed" and best >= 0:
            became = _class(b.kind[best])
        elif kind == "visibility changed":
            became = "hidden" if line.visible[0] else "visible"
        moved, named = 0.0, kind
        if kind == "moved" and weight.sum() > 0.0:
            moved = float((np.where(fits, off[first:last], 0.0) * weight).sum() / weight.sum())
            pieces_beside = b.take(near[first:last][fits]) if line.curved[0] else line
            if foreign and line.curved[0] != b.curved[best] and _straight(pieces_beside):
                farthest = float(np.where(fits, off[first:last], 0.0).max())
                # An arc is longer than twice its rise above the chord: a shorter line lies beside the other by chance.
                if line.lengths.sum() > 2.0 * farthest:
                    named, moved = "polyline", farthest
                    became = "straight pieces" if line.curved[0] else "a curve"
        found.add(_difference(named, line, about, "before", became, moved), line)


def _straight(pieces: Pieces) -> bool:
    """Whether all pieces have one direction, as those of one chord have."""
    ways = (pieces.end - pieces.start) / np.maximum(pieces.lengths, 1e-300)[:, None]
    turned = (ways[:, 0] + 1j * ways[:, 1]) ** 2
    return bool((np.abs(turned - turned[:1]) < 2.0 * _ONE_WAY).all())


def _difference(
    kind: str, line: Pieces, about: About, side: Literal["before", "after"], became: str = "", moved: float = 0.0
) -> Difference:
    part, edge, view = int(line.part[0]), int(line.edge[0]), int(line.view[0])
    return Difference(
        kind=kind,  # type: ignore[arg-type]
        place=_middle(line),
        length_mm=round(float(line.lengths.sum()), 6),
        line_class=_class(line.kind[0]),
        visible=None if line.visible[0] < 0 else bool(line.visible[0]),
        part=about.parts[part] if 0 <= part < len(about.parts) else None,
        edge=edge if edge >= 0 else None,
        side=side,
        became=became,
        moved_mm=round(moved, 4),
        view=about.views[view] if 0 <= view < len(about.views) else None,
    )


def _class(number: Any) -> str:
    return names()[number] if number >= 0 else UNKNOWN


def _ends(pieces: Pieces) -> Floats:
    return np.stack([pieces.start, pieces.end], axis=1)


def _middle(line: Pieces) -> tuple[float, float]:
    """The point half way along a line."""
    ends = np.cumsum(line.lengths)
    n = int(np.searchsorted(ends, 0.5 * ends[-1]))
    share = 1.0 - (ends[n] - 0.5 * ends[-1]) / line.lengths[n]
    x, y = (line.start[n] + share * (line.end[n] - line.start[n])).tolist()
    return round(x, 4) + 0.0, round(y, 4) + 0.0


def _lines(pieces: Pieces) -> list[Pieces]:
    """The pieces of each line."""
    if not len(pieces):
        return []
    cuts = np.flatnonzero(pieces.line[1:] != pieces.line[:-1]) + 1
    ends = [0, *cuts.tolist(), len(pieces)]
    return [pieces.take(slice(first, last)) for first, last in pairwise(ends)]
