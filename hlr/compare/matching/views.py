"""Pages view by view: each view of one page is laid on that of the other, and judged by itself."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from hlr.compare.compared_view import ComparedView
from hlr.compare.lines.motion import Motion
from hlr.compare.lines.pieces import Pieces, joined
from hlr.compare.matching.hatched_areas import without_hatches
from hlr.compare.matching.judge import Findings, judged
from hlr.compare.matching.pairing import pairs_of, view_of, with_views_of
from hlr.compare.matching.register import translation
from hlr.compare.reading.sides import Side
from hlr.compare.verdict.verdicts import with_verdicts

DISPLACED_MM = 1.0
"""A view that has to be moved by so much more than the others is displaced."""

_FOUND = 0.5
"""Share of the length that lies on the other. A view of which less does is compared as it lies, if it would go far."""

Shift = tuple[float, float]


def by_view(
    before: Side, after: Side, tolerance_mm: float, register: bool
) -> tuple[Findings, Side, tuple[ComparedView, ...]]:
    """What differs, the second page as its views were moved, and a row for each view.

    register: whether each view of the second page is moved to where most of its lines match those of the first.
    """
    whole: Shift = (0.0, 0.0)
    if register and not (before.about.views and after.about.views):
        after, whole = _laid_on(before, after, tolerance_mm)
    before, after = with_views_of(before, after), with_views_of(after, before)
    findings, lines, rows = [], [], []
    for pair in pairs_of(before, after, tolerance_mm):
        a, b = view_of(before, pair, pair.before), view_of(after, pair, pair.after)
        shift: Shift | None = None
        if register and len(a.pieces) and len(b.pieces):
            b, (x, y) = _laid_on(a, b, tolerance_mm)
            shift = round(whole[0] + x, 4) + 0.0, round(whole[1] + y, 4) + 0.0
        moved = Motion(shift=whole if shift is None else shift)
        found = with_verdicts(judged(a, b, tolerance_mm), a, b, moved, tolerance_mm)
        findings.append(found)
        lines.append(b.pieces)
        there = len(a.pieces) > 0, len(b.pieces) > 0
        rows.append(ComparedView(pair.name, *there, shift, False, found.same_mm, found.lengths_mm))
    together: list[Pieces] = lines or [after.pieces]
    return Findings.of(findings), replace(after, pieces=joined(together)), _told_apart(rows)


def _laid_on(fixed: Side, moving: Side, tolerance_mm: float) -> tuple[Side, Shift]:
    """A side, moved onto the other where that says something, and by how much."""
    lines, others = without_hatches(moving.pieces, fixed.pieces)
    shift, share = translation(lines, others, tolerance_mm, search=False)
    if share < _FOUND and float(np.hypot(*shift)) > DISPLACED_MM:
        shift = np.zeros(2)
    x, y = shift.tolist()
    return replace(moving, pieces=moving.pieces.shifted(shift)), (x, y)


def _told_apart(rows: list[ComparedView]) -> tuple[ComparedView, ...]:
    """The rows, with the views marked that lie elsewhere than the others."""
    shifts = np.array([row.shift for row in rows if row.shift is not None]).reshape(-1, 2)
    if not len(shifts):
        return tuple(rows)
    usual = np.median(shifts, axis=0)
    return tuple(
        replace(row, displaced=row.shift is not None and float(np.hypot(*(row.shift - usual))) > DISPLACED_MM)
        for row in rows
    )
