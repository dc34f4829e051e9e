"""Verdicts: for each difference, which of the two drawings shows what is true of the model.

What is true is asked at points along the line, away from its ends, and each drawing's answer is compared with it. A
verdict needs most of the points: where too few are clear, or they disagree, it is "undecided".
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace

import numpy as np

from hlr.common.types import Floats
from hlr.compare.difference import Difference, Verdict, told
from hlr.compare.lines.motion import Motion
from hlr.compare.lines.pieces import Index, Pieces
from hlr.compare.matching.judge import Findings
from hlr.compare.reading.sides import Behind, Side
from hlr.compare.verdict.drawn import Shown, nearest
from hlr.compare.verdict.sight import HIDDEN, NOTHING, UNCLEAR, VISIBLE, Truth, truth
from hlr.compare.verdict.true_lines import TrueLines

_STEP_MM, _FEWEST, _MOST = 0.25, 3, 15
"""Distance of the points along a line, and how many there are."""

_ENDS = 0.1
"""Share of a line at each end without points: what is true may change there."""

_MOST_JUDGED = 3_000
"""Differences, the longest of each kind first."""

_AGREED = 0.75
"""Share of the clear points that have to agree."""

_CLEAR = 0.4
"""Share of the points that have to be clear."""

_FARTHEST = 2.0
"""Times its mean: how far a displaced line may lie somewhere."""

_NEARER = 0.5
"""Of a displacement: a line is in its place where it is off by less, and the other by more."""

WORDS: dict[tuple[bool, bool], Verdict] = {
    (True, False): "first right",
    (False, True): "second right",
    (True, True): "both right",
    (False, False): "neither right",
}
"""Whether the first drawing is right, and the second."""

COVERED = "it is hidden, and so close to a visible line that a drawing may show it or leave it out"
LIKED = "only a smooth edge or a seam runs there, which a drawing may show or leave out"


@dataclass(frozen=True, slots=True)
class Answer:
    """What a drawing says of a line: whether it draws it, and as visible (1), hidden (0), or not known (-1)."""

    drawn: bool
    visible: int = -1


def with_verdicts(
    found: Findings,
    before: Side,
    after: Side,
    motion: Motion | None,
    tolerance_mm: float,
    shown: tuple[Pieces, Pieces] | None = None,
) -> Findings:
    """The differences with verdicts, where one side is a model and the other a drawing of it.

    shown  all lines of both, also those that were left out of the comparison: a visible one hides what runs under it
    """
    side = before if before.behind is not None else after
    if side.behind is None or (before.behind is not None and after.behind is not None):
        return found
    judged = [each.kind in _JUDGED and each.line_class != "hatch" for each in found.differences]
    chosen = np.flatnonzero(judged)[:_MOST_JUDGED].tolist()
    model = TrueLines.of(side.behind.source, side.behind.drawing, tolerance_mm) if chosen else None
    if model is None:
        return found
    motion = motion if side is after and motion is not None else Motion()
    whose, points, ways = _samples([found.traces[n] for n in chosen])
    one, other = shown or (before.pieces, after.pieces)
    drawn = Shown.of(one, points, tolerance_mm), Shown.of(other, points, tolerance_mm)
    at = _Asked(model, side.behind, motion, tolerance_mm)
    known = at(points, ways)
    differences = list(found.differences)
    for n, number in enumerate(chosen):
        here = np.flatnonzero(whose == n)
        each = differences[number]
        if each.kind == "moved":
            far, place = nearest(after.pieces, points[here], _FARTHEST * each.moved_mm)
            verdict, reason = _moved(each, known.away[here], at(place, ways[here]).away[np.isfinite(far)])
        else:
            verdict, reason = _seen(each, known, here, drawn)
        differences[number] = replace(each, verdict=verdict, reason=reason)
    return replace(found, differences=[_polyline(each, tolerance_mm) for each in differences])


@dataclass(frozen=True, slots=True)
class _Asked:
    """Asks what is true at points of the comparison: whatever has moved the model's drawing is undone first."""

    model: TrueLines
    behind: Behind
    motion: Motion
    tolerance_mm: float

    def __call__(self, points: Floats, ways: Floats) -> Truth:
        back = np.linalg.inv(self.motion.matrix @ self.behind.matrix).T
        own = (points - np.array(self.motion.shift) - self.motion.matrix @ self.behind.shift) @ back
        return truth(self.model, own, ways @ back, self.tolerance_mm / self.motion.scale)


def _samples(traces: list[Floats]) -> tuple[Index, Floats, Floats]:
    """Points along lines, each given as segments (k, 2, 2): the line (n,), the point (n, 2), the line's way (n, 2)."""
    whose, points, ways = [], [], []
    for number, trace in enumerate(traces):
        step = trace[:, 1] - trace[:, 0]
        ends = np.cumsum(np.hypot(*step.T))
        count = int(np.clip(np.ceil(ends[-1] / _STEP_MM), _FEWEST, _MOST))
        at = (_ENDS + (1.0 - 2.0 * _ENDS) * (np.arange(count) + 0.5) / count) * ends[-1]
        k = np.minimum(np.searchsorted(ends, at), len(trace) - 1)
        rest = (ends[k] - at) / np.maximum(np.hypot(*step[k].T), 1e-300)
        whose.append(np.full(count, number))
        points.append(trace[k, 1] - np.clip(rest, 0.0, 1.0)[:, None] * step[k])
        ways.append(step[k])
    return np.concatenate(whose), np.concatenate(points), np.concatenate(ways)


def _answers(each: Difference, hidden: bool) -> tuple[Answer, Answer]:
    """What the first and the second drawing say of the line of a difference.

    hidden: the drawing of which the difference is not told has a hidden line there, and no visible one
    """
    own = Answer(True, -1 if each.visible is None else int(each.visible))
    if each.kind == "visibility changed":
        return own, Answer(True, 1 - own.visible if own.visible >= 0 else -1)
    other = Answer(True, 0) if hidden and own.visible != 0 else Answer(False)
    return (own, other) if each.side == "before" else (other, own)


def _right(answer: Answer, line: Answer, known: Truth, n: int, hidden: bool, by: Shown) -> bool | None:
    """Whether an answer is true at point n of a line that one drawing has; None where that cannot be said.

    line: as one of the drawings has it; hidden: a hidden line may be drawn there, or left out by him who draws none,
    because it is under the ink of a visible one; by: what the drawing that answers shows
    """
    always, state = int(known.always[n]), max(int(known.always[n]), int(known.optional[n]))
    if not answer.drawn:
        # Of a line that may be either: the visible one that runs there is drawn, or a hidden one lies under its ink.
        if hidden and (line.visible == 0 or (line.visible < 0 and by.inked[n])):
            return True
        if always == VISIBLE:
            return False
        return None if always == UNCLEAR else always == NOTHING or not by.hides or hidden
    if state == NOTHING or answer.visible < 0:
        return state != NOTHING
    if answer.visible == 0 and hidden:
        return True
    return None if state == UNCLEAR else answer.visible == (state == VISIBLE)


def _seen(each: Difference, known: Truth, here: Index, shown: tuple[Shown, Shown]) -> tuple[Verdict, str]:
    """The verdict on a line that is in one drawing only, or visible in one and hidden in the other."""
    votes: Counter[tuple[bool, bool]] = Counter()
    reasons: Counter[str] = Counter()
    other = shown[each.side == "before"]
    alone = each.kind != "visibility changed"
    for n in here.tolist():
        answers = _answers(each, bool(other.hidden[n]) and not other.inked[n])
        line = answers[each.side == "after"]
        ink = alone and bool(known.covered[n] or other.inked[n])
        true = alone and line.visible == 0 and (ink or bool(known.hidden[n]))
        first, second = (
            _right(answer, line, known, n, true if answer.drawn else ink, some)
            for answer, some in zip(answers, shown, strict=True)
        )
        if first is not None and second is not None:
            votes[first, second] += 1
            reasons[_state(line, known, n, first and second)] += 1
    clear = sum(votes.values())
    if clear < _CLEAR * len(here):
        return "undecided", "what lies there is too close to tell"
    (most, count), state = votes.most_common(1)[0], reasons.most_common(1)[0][0]
    if count < _AGREED * clear:
        return "undecided", f"one part of it is so, another not: {count} of {clear} points say {WORDS[most]}"
    return WORDS[most], _hidden_by(known, here) if state == "hidden" else state


def _state(line: Answer, known: Truth, n: int, both: bool) -> str:
    """What is true, in words. line: as one of the drawings has it; both: whether both drawings are right."""
    always, optional = int(known.always[n]), int(known.optional[n])
    if max(always, optional) == NOTHING:
        return "no edge or outline of the model runs there"
    if both:
        return LIKED if always == NOTHING else COVERED
    hidden = max(always, optional) == HIDDEN or (line.visible == 0 and always != VISIBLE and known.hidden[n])
    return "hidden" if hidden else "nothing is in front of it"


def _hidden_by(known: Truth, here: Index) -> str:
    some = here[np.isfinite(known.depth[here])]
    if not len(some):
        return "a face is in front of it"
    middle = some[np.argsort(known.depth[some], kind="stable")[len(some) // 2]]
    return f"a face is in front of it, by {told(float(known.depth[middle]))} mm"


def _moved(each: Difference, own: Floats, other: Floats) -> tuple[Verdict, str]:
    """The verdict on a displaced line, by how far both lines are from one of the model, at points along them."""
    first = float(np.median(own))
    second = float(np.median(other)) if len(other) >= _CLEAR * len(own) else first
    near, far = min(first, second), max(first, second)
    if not near <= _NEARER * each.moved_mm <= far:
        return "undecided", "a line of the model runs beside both" if np.isfinite(far) else "no line runs beside both"
    reason = f"the line of the model runs {told(near)} mm from it"
    return ("first right" if first < second else "second right"), reason


def _polyline(each: Difference, tolerance_mm: float) -> Difference:
    """Straight pieces in place of a curve are right as long as they look like it."""
    if each.kind != "polyline":
        return each
    reason = f"straight pieces, off by {told(each.moved_mm)} mm"
    if each.moved_mm <= tolerance_mm:
        return replace(each, verdict="both right", reason=reason)
    # The drawing of which the difference is told has the curve, or the straight pieces.
    told_of_first, has_curve = each.side == "before", each.became == "straight pieces"
    return replace(each, verdict="first right" if told_of_first == has_curve else "second right", reason=reason)


_JUDGED = ("gone", "new", "moved", "visibility changed")
"""Kinds on which rays say something, but for hatches: those run across faces, where a model has no line."""
