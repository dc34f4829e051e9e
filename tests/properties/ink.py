"""Changes between two drawings of one model: the longest stretch and the whole length of ink that differs.

Ink is sampled along all lines. Neighbouring samples without ink of the other drawing within reach form a stretch. A
drawing that only moved a little has none; if a line changed from visible to hidden, it has one as long as the line.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from hlr import Drawing
from support.ink import Ink, beside, ink, stretches, strokes

Map = Callable[[np.ndarray], np.ndarray]
STEP = 2.0
"""Accuracies between samples."""
UNDER = 3.0
"""Accuracies: a hidden line this close to a visible one lies under its ink and is not drawn."""


STUB = 10.0
"""Accuracies: of a contact, a piece up to this long counts as hidden beside a hidden one, else as visible."""
LONGEST = 2.0 * STUB + 1.0
"""Accuracies that may change class at a stretch where something is decided by rounding alone: a hidden piece too short
to be drawn comes and goes, and with it the doubtful ones on both its sides. Whole edges of the scenes here are longer,
so an edge that changes as a whole is always noticed."""


@dataclass(frozen=True)
class Change:
    """The difference of two drawings: its longest stretch and its whole length, in accuracies; where the longest is.

    share: the whole length as a share of all ink of both.
    """

    longest: float
    total: float
    share: float
    where: str

    def __str__(self) -> str:
        return f"{self.longest:.1f} at a stretch, {self.total:.1f} in all accuracies ({self.share:.2%}): {self.where}"


def _moved(drawing: Drawing, step: float, moved: Map) -> Ink:
    return ink([(visible, moved(points)) for visible, points in strokes(drawing)], step, ends=True)


def _missing(one: Drawing, other: Drawing, reach: float, visible: bool, a: Map, b: Map) -> tuple[float, float, str]:
    """Ink of one visibility that only the first has: longest stretch, whole length, and where the longest is."""
    accuracy = one.accuracy.used
    step = STEP * accuracy
    mine, theirs = _moved(one, step, a), _moved(other, step, b)
    slack = 0.5 * step
    lacking = np.flatnonzero(mine.visible == visible)
    lacking = lacking[~beside(mine.points[lacking], theirs, visible, np.hypot(reach * accuracy, slack))]
    if not visible:
        # Under the ink of a visible line a hidden one may be drawn or not.
        under = np.hypot((reach + UNDER) * accuracy, slack)
        lacking = lacking[~beside(mine.points[lacking], theirs, True, under)]
    if not len(lacking):
        return 0.0, 0.0, ""
    chosen = np.zeros(len(mine.points), bool)
    chosen[lacking] = True
    runs = stretches(mine, chosen)
    lengths = [float(mine.length[run].sum()) for run in runs]
    worst = int(runs[int(np.argmax(lengths))][0])
    x, y = mine.points[worst]
    text = f"{'visible' if visible else 'hidden'} {one.lines[mine.line[worst]].kind} at {x:.4f}, {y:.4f}"
    return max(lengths) / accuracy, sum(lengths) / accuracy, text


def change(before: Drawing, after: Drawing, reach: float = 1.0, back: Map = lambda p: p, hidden: bool = True) -> Change:
    """What ink the two do not have in common, visible and hidden by themselves.

    reach   accuracies that ink may have moved
    back    brings points of `after` to where they were before
    hidden  hidden ink too
    """
    still: Map = lambda p: p  # noqa: E731
    found = []
    for visible in (True, False)[: 1 + hidden]:
        found.append((*_missing(before, after, reach, visible, still, back), "before"))
        found.append((*_missing(after, before, reach, visible, back, still), "after"))
    longest, _, where, when = max(found)
    total = sum(each[1] for each in found)
    accuracy = before.accuracy.used
    every = sum(ink_length(each, visible) for each in (before, after) for visible in (True, False))
    return Change(longest, total, total * accuracy / every if every else 0.0, f"{where} {when}" if where else "none")


def ink_length(drawing: Drawing, visible: bool) -> float:
    """Millimetres of ink."""
    steps = [np.diff(line.points, axis=0) for line in drawing.lines if line.visible == visible]
    return float(sum(np.hypot(*step.T).sum() for step in steps))


def expect_same_ink(before: Drawing, after: Drawing, back: Map = lambda p: p, hidden: bool = True) -> None:
    """Ink moved by at most the accuracy; no stretch longer than LONGEST came, went or changed class."""
    found = change(before, after, back=back, hidden=hidden)
    assert found.longest <= LONGEST, str(found)
