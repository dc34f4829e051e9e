"""Compare drawings by their ink: what lies on the paper, whichever lines it is made of.

Ink is sampled along all lines. What one drawing has and the other has not, within the reach, makes up stretches along
its lines; a drawing that only moved a little has none, and one on which a line changed from visible to hidden has one
as long as the line.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from hlr import Drawing

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
class Ink:
    """points (n, 2) on paper, before the drawing was moved to its origin; line (n,) they lie on; weight (n,) mm."""

    points: np.ndarray
    line: np.ndarray
    weight: np.ndarray


@dataclass(frozen=True)
class Change:
    """What two drawings do not have in common: the longest stretch and all of it, in accuracies; where the longest is.

    share: of all ink of both.
    """

    longest: float
    total: float
    share: float
    where: str

    def __str__(self) -> str:
        return f"{self.longest:.1f} at a stretch, {self.total:.1f} in all accuracies ({self.share:.2%}): {self.where}"


def ink(drawing: Drawing, visible: bool, step: float, moved: Map = lambda p: p) -> Ink:
    """Samples at most `step` apart, corners among them."""
    lines = [line for line in drawing.lines if line.visible == visible]
    ends = [np.stack([p[:-1], p[1:]], axis=1) for p in (moved(line.points + drawing.origin) for line in lines)]
    pieces = np.concatenate([np.zeros((0, 2, 2)), *ends])
    owner = np.repeat(np.arange(len(lines)), [len(e) for e in ends])
    size = np.hypot(*(pieces[:, 1] - pieces[:, 0]).T)
    count = np.ceil(size / step).astype(int) + 1
    which = np.repeat(np.arange(len(pieces)), count)
    first = np.cumsum(count) - count
    t = (np.arange(len(which)) - first[which]) / np.maximum(count - 1, 1)[which]
    points = pieces[which, 0] + (pieces[which, 1] - pieces[which, 0]) * t[:, None]
    return Ink(points, owner[which], (size / count)[which])


def _away(points: np.ndarray, other: Ink) -> np.ndarray:
    if not len(other.points):
        return np.full(len(points), np.inf)
    return np.asarray(cKDTree(other.points).query(points)[0])


def _missing(one: Drawing, other: Drawing, reach: float, visible: bool, a: Map, b: Map) -> tuple[float, float, str]:
    """What ink of one class the first has and the second has not: longest stretch, all of it, and where."""
    accuracy = one.accuracy.used
    step = STEP * accuracy
    mine, same = ink(one, visible, step, a), ink(other, visible, step, b)
    slack = 0.5 * step
    lacking = _away(mine.points, same) > np.hypot(reach * accuracy, slack)
    if not visible and lacking.any():
        # Under the ink of a visible line a hidden one may be drawn or not.
        over = ink(other, True, step, b)
        lacking[lacking] = _away(mine.points[lacking], over) > np.hypot((reach + UNDER) * accuracy, slack)
    if not lacking.any():
        return 0.0, 0.0, ""
    starts = np.flatnonzero(np.diff(lacking.astype(int), prepend=0) > 0)
    starts = np.union1d(starts, np.flatnonzero(lacking & (np.diff(mine.line, prepend=-1) != 0)))
    runs = np.add.reduceat(np.where(lacking, mine.weight, 0.0), starts)
    worst = int(starts[np.argmax(runs)])
    x, y = mine.points[worst]
    kinds = [line.kind for line in one.lines if line.visible == visible]
    text = f"{'visible' if visible else 'hidden'} {kinds[mine.line[worst]]} at {x:.4f}, {y:.4f}"
    return float(runs.max()) / accuracy, float(runs.sum()) / accuracy, text


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
