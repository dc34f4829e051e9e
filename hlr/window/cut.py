"""Cuts a drawing's lines and faces at its window, if any of them reach beyond it."""

from __future__ import annotations

from collections.abc import Sequence
from time import perf_counter

import numpy as np
import numpy.typing as npt

from hlr.common.numbers import typed
from hlr.drawing.fill import Fill
from hlr.drawing.line import Bounds, Line
from hlr.drawing.lines import bounds_of
from hlr.drawing.notes import Note
from hlr.request.effect import Facts, Planner
from hlr.window.fill import cut_fill
from hlr.window.frame import SLACK, Frame
from hlr.window.lines import cut_lines

EFFECT = "window"
"""The row of the table of effects."""

PLACES = 3
"""Digits after the point of millimetres in a note."""


def decide_cut(points: npt.NDArray[np.float64], window: Bounds, planner: Planner) -> None:
    """Decide whether the window will cut anything, before there are lines.

    points (n, 2): millimetres on paper, those of the model. The drawing's lower left corner is theirs.
    """
    if len(points):
        low, high = points.min(axis=0), points.max(axis=0)
        planner.on(EFFECT, Facts(crossed=_beyond(Bounds(0.0, 0.0, *(high - low).tolist()), window)))


def cut_at_window(
    lines: Sequence[Line], fill: Fill | None, frame: Frame | None, planner: Planner
) -> tuple[Sequence[Line], Fill | None, tuple[Note, ...]]:
    """The lines and fill inside the window. frame None: no window was asked for, nothing is cut."""
    if frame is None:
        planner.state(Facts(), EFFECT)
        return lines, fill, ()
    begun = perf_counter()
    whole = _around(lines, fill)
    sides = _beyond(whole, frame.window)
    if not planner.on(EFFECT, Facts(crossed=sides)):
        return lines, fill, ()
    lines, cuts = cut_lines(lines, frame)
    if fill is not None:
        fill, more = cut_fill(fill, frame.window)
        cuts += more
    planner.spent(EFFECT, perf_counter() - begun, window_cuts=cuts)
    if lines or (fill is not None and len(fill.part)):
        return lines, fill, ()
    text = (
        f"nothing of the drawing lies in the window {_shown(frame.window)}: "
        f"without it the drawing is {_shown(whole)} (x0,y0,x1,y1 in millimetres)"
    )
    return lines, fill, (Note("nothing-in-view", text),)


def _around(lines: Sequence[Line], fill: Fill | None) -> Bounds:
    box = bounds_of(lines)
    if fill is None or len(fill.points) == 0:
        return box
    (x0, y0), (x1, y1) = fill.points.min(axis=0).tolist(), fill.points.max(axis=0).tolist()
    return Bounds(min(x0, box.x0), min(y0, box.y0), max(x1, box.x1), max(y1, box.y1))


def _beyond(box: Bounds, window: Bounds) -> int:
    """How many sides of the window the box reaches beyond."""
    out = [window.x0 - box.x0, window.y0 - box.y0, box.x1 - window.x1, box.y1 - window.y1]
    return sum(distance > SLACK for distance in out)


def _shown(box: Bounds) -> str:
    return ",".join(typed(value, places=PLACES) for value in box)
