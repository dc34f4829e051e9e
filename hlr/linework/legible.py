"""What the pen can show: the line group by how close lines run, and lines left out that would only make a blot.

Twice the width of the pen is the least distance of lines (ISO 128). The rule has three steps.

1. The line group, where the style names no widths. Ink is crowded where a line of the same visibility runs alongside
   nearer than that, from middle to middle; of a hidden line beside a visible one, where less than its own width is
   white between them. While more than `CROWDED` of the visible ink, or as much hidden ink, is crowded, the next thinner
   group is taken, at last 0.25/0.13.
2. What even this pen cannot show is left out (`kernel/linework/src/legible/left_out.rs`).
3. Where too much is still crowded, a note names the scale at which it would not be.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil
from time import perf_counter

import numpy as np

from hlr import _kernel
from hlr.common.types import Floats
from hlr.drawing.line import Line
from hlr.drawing.lines import Lines, held
from hlr.drawing.notes import Note
from hlr.drawing.pens import LINE_GROUPS, widths_of
from hlr.drawing.scale import ratio
from hlr.request.drawing_effects import LEGIBILITY
from hlr.request.effect import Planner
from hlr.request.style import Style
from hlr.tables.line_classes import in_drawing_order
from hlr.tables.sheets import standard_scale_from

CROWDED = 0.2
"""Share of the visible ink that may be crowded. Tangent edges beside the outlines of small fillets alone are a tenth of
many pictorial views, and no pen separates these."""

APART = 2.0
"""The least distance of lines, from middle to middle, in widths of the pen."""

BINS_PER_MM = 64

Pens = tuple[float, float]
"""Widths of wide and narrow lines, millimetres."""


@dataclass(frozen=True, slots=True)
class Legible:
    """Lines as they are drawn, their line group, how many lines were left out, and what is said about it.

    group: widths of wide and narrow lines in millimetres; None: those of the style and the page
    """

    lines: Sequence[Line]
    group: Pens | None = None
    left_out: int = 0
    notes: tuple[Note, ...] = ()


@dataclass(frozen=True, slots=True)
class Spacing:
    """How close the lines of one visibility run.

    share (k,): of their ink, the share with a line alongside nearer than 1/64, 2/64 ... mm; smallest: the side of the
    square around the smallest line, mm; ink: all of it, mm
    """

    share: Floats
    smallest: float
    ink: float

    def within(self, distance: float) -> float:
        """The share of ink with a line alongside nearer than so many millimetres."""
        return float(self.share[_bins(distance) - 1])

    def crowded(self, pen: float) -> float:
        """The share of ink that is crowded with a pen of this width in millimetres."""
        return self.within(APART * pen)

    def distance(self) -> float:
        """Millimetres: all ink but `CROWDED` keeps it."""
        return float(np.searchsorted(self.share, CROWDED, side="right") + 1) / BINS_PER_MM

    def close(self, pen: float) -> bool:
        """Whether anything is crowded, or smaller than a pen of this width in millimetres."""
        return self.crowded(pen) > 0.0 or self.smallest < pen


def legible(
    lines: Sequence[Line],
    scale: float,
    accuracy: float,
    style: Style,
    sheet: tuple[float, float],
    planner: Planner,
) -> Legible:
    """The lines of one view that the pens of a style can show.

    scale: paper to model; accuracy: millimetres on paper, as used; sheet: width and height, millimetres
    """
    if not planner.on(LEGIBILITY):
        return Legible(lines)
    begun = perf_counter()
    usual = widths_of(style, sheet)
    kept = held(lines)
    ink = _kernel.Ink(kept, _reaches(usual))
    behind, seen, under = _spacings(ink)
    if seen is None or behind is None or under is None:
        return Legible(lines)
    if not (seen.close(usual[0]) or behind.close(usual[1]) or under.within(_white(usual)) > 0.0):
        return Legible(lines)
    pens = usual if style.wide or style.narrow else _group(seen, under, usual)
    notes = _notes(seen, usual, pens, scale)
    fates = ink.left_out((pens[1], pens[0]), accuracy, in_drawing_order())
    out = int(np.count_nonzero(fates))
    planner.spent(LEGIBILITY, perf_counter() - begun, left_out=out)
    if out:
        lines = Lines(kept.chosen(fates == 0))
        notes = (_left_out(out, pens), *notes)
    return Legible(lines, pens if pens != usual else None, out, notes)


def _group(seen: Spacing, under: Spacing, usual: Pens) -> Pens:
    """The first line group, beginning with the usual one, with which little ink is crowded; else the thinnest.

    seen: of visible lines; under: of hidden lines beside them
    """
    groups = [group for group in LINE_GROUPS if group[0] <= usual[0]]
    much = CROWDED * max(seen.ink, 1.0)

    def clear(group: Pens) -> bool:
        return seen.crowded(group[0]) <= CROWDED and under.within(_white(group)) * under.ink <= much

    return next((group for group in groups if clear(group)), groups[-1])


def _white(pens: Pens) -> float:
    """Millimetres from middle to middle of a visible and a hidden line with the width of the latter white between."""
    wide, narrow = pens
    return 0.5 * (wide + narrow) + narrow


def _bins(distance: float) -> int:
    """How many bins are nearer than so many millimetres."""
    return ceil(distance * BINS_PER_MM)


def _reaches(pens: Pens) -> tuple[float, float, float]:
    """How far is looked beside hidden lines, beside visible ones, and from hidden to visible ones; whole bins, mm."""
    wide, narrow = pens
    nearest = (APART * narrow, APART * wide, _white(pens))
    return _bins(nearest[0]) / BINS_PER_MM, _bins(nearest[1]) / BINS_PER_MM, _bins(nearest[2]) / BINS_PER_MM


def _spacings(ink: _kernel.Ink) -> list[Spacing | None]:
    """Of hidden lines, of visible lines, and of hidden ones beside visible ones.

    None where there is more ink than any page has room for.
    """
    return [None if found is None else Spacing(*found) for found in ink.spacings()]


def _notes(seen: Spacing, usual: Pens, pens: Pens, scale: float) -> tuple[Note, ...]:
    notes = []
    if pens != usual:
        text = f"the lines are close together: they are drawn {_shown(pens)} mm wide instead of {_shown(usual)}."
        notes.append(Note("thin-lines", text))
    crowded = seen.crowded(pens[0])
    if crowded > CROWDED:
        better = standard_scale_from(scale * APART * pens[0] / seen.distance())
        text = f"{crowded:.0%} of the lines lie closer to others than twice their width"
        text += f": {ratio(better)} would separate most." if better > scale else "."
        notes.append(Note("crowded", text))
    return tuple(notes)


def _shown(pens: Pens) -> str:
    return f"{pens[0]:g}/{pens[1]:g}"


def _left_out(count: int, pens: Pens) -> Note:
    what = "1 line is" if count == 1 else f"{count:,} lines are"
    why = f"smaller than the pen of {pens[0]:g} mm, or between others closer than that"
    text = f"{what} left out: {why}; details=True, on the command line --details, draws all."
    return Note("details-left-out", text)


__all__ = ["Legible", "legible"]
