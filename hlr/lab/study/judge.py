"""How far polylines are from the true lines: the same measure for every program.

::

      true visible   ____________________
      drawn visible  ___________     _________     missing lines count as much as false ones

Distances are taken both ways, from drawn to true lines and back. If a visible line stops too late, its end is as far
from the true visible line as the change of visibility is displaced. So the one distance measures misplaced lines,
displaced changes, missing lines and false lines.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.types import Floats
from hlr.lab.polylines import Polylines
from hlr.lab.sampling import with_ends
from hlr.tables.line_classes import where

SAMPLES = 200_000
"""Points along all lines of a drawing, beside their ends."""

NOTICED = 0.1
"""Millimetres: ink farther off than a fifth of a wide line counts as wrong."""

P99 = 0.99
"""Share of the length that is nearer than `off_p99` and `ink_p99`."""


class LineJudge:
    """Compares polylines of any drawing program with the true ones of the same view."""

    def __init__(self, true: Polylines) -> None:
        self._true = true

    def judge(self, drawn: Polylines) -> dict[str, float]:
        """Errors by name; lengths in millimetres on paper.

        off_mean, off_p99, off_worst     distance of all drawn lines from the nearest true line, visible or hidden
        ink_mean, ink_p99, ink_worst     distance between drawn and true visible lines, both ways
        too_much, missing                length of drawn visible lines, and of true ones, farther off than `NOTICED`
        mislabelled                      the part of these that is drawn visible where it is truly hidden, or vice versa
        wrong                            too_much and missing together, as a share of the true visible length
        """
        true = self._true
        # Line classes that are drawn by default are required; the others may be drawn or left out.
        required = where(lambda row: row.by_default is True)[true.kind]
        allowed_seen = true.segments(true.visible)
        allowed_all = true.segments()
        seen, weight = _samples(drawn, drawn.visible)
        unseen, unseen_weight = _samples(drawn, ~drawn.visible)
        truly, true_weight = _samples(true, true.visible & required)
        shown = _distance(seen, allowed_seen)
        short = _distance(truly, drawn.segments(drawn.visible))
        placed = np.concatenate([np.minimum(shown, _distance(seen, allowed_all)), _distance(unseen, allowed_all)])
        both, both_weight = np.concatenate([shown, short]), np.concatenate([weight, true_weight])
        extra, lacking = shown > NOTICED, short > NOTICED
        hidden_there = _distance(seen[extra], true.segments(~true.visible)) <= NOTICED
        hidden_drawn = _distance(truly[lacking], drawn.segments(~drawn.visible)) <= NOTICED
        total = float(true_weight.sum())
        too_much, missing = float(weight[extra].sum()), float(true_weight[lacking].sum())
        return {
            **_summary("off", placed, np.concatenate([weight, unseen_weight])),
            **_summary("ink", both, both_weight),
            "too_much": too_much,
            "missing": missing,
            "mislabelled": float(weight[extra][hidden_there].sum() + true_weight[lacking][hidden_drawn].sum()),
            "wrong": (too_much + missing) / total if total > 0.0 else 0.0,
            "true_visible": total,
        }


def _summary(name: str, distance: Floats, weight: Floats) -> dict[str, float]:
    if len(distance) == 0 or not weight.sum() > 0.0:
        return {}
    # Without any line on one side the distance is the width of the paper, which no distance exceeds.
    distance = np.minimum(distance, FARTHEST)
    order = np.argsort(distance)
    share = np.cumsum(weight[order]) / weight.sum()
    p99 = distance[order][min(int(np.searchsorted(share, P99)), len(order) - 1)]
    mean = float((distance * weight).sum() / weight.sum())
    return {f"{name}_mean": mean, f"{name}_p99": float(p99), f"{name}_worst": float(distance.max())}


FARTHEST = 1000.0


def _samples(lines: Polylines, chosen: npt.NDArray[np.bool_]) -> tuple[Floats, Floats]:
    """Points (n, 2) along the chosen lines, ends included, and the length (n,) in mm that each represents."""
    pieces = lines.segments(chosen)
    if len(pieces) == 0:
        return np.empty((0, 2)), np.empty(0)
    step = max(float(np.hypot(*(pieces[:, 2:] - pieces[:, :2]).T).sum()) / SAMPLES, 1e-9)
    found = with_ends(pieces, step)
    # By the trapezoidal rule: each end of a segment represents half a step.
    weight = np.where((found.share == 0.0) | (found.share == 1.0), 0.5, 1.0)
    return found.points, (found.length / found.pieces)[found.segment] * weight


def _distance(points: Floats, segments: Floats) -> Floats:
    if len(points) == 0 or len(segments) == 0:
        return np.full(len(points), np.inf)
    keys = np.zeros(len(points), np.int32), np.zeros(len(segments), np.int32)
    found, _ = _kernel.nearest(np.ascontiguousarray(points), keys[0], np.ascontiguousarray(segments), keys[1], np.inf)
    return np.asarray(found)
