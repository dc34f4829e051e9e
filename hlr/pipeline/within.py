"""The finest drawing that fits into a time: coarse first, then finer while time lasts.

1. The source is opened once. The first pass is COARSE times coarser than the accuracy that a drawing of its size has,
   and coarser still on a sheet of metres: its work is bounded by what an A4 sheet shows, whatever the scale.
2. What the passes took tells how time grows with fineness: as a power of it (time ~ accuracy^-p). The next accuracy is
   the finest of the ladder that this lets finish; where not even the next rung would, the last drawing is the result.
3. The growth is an estimate: a pass that turns out to take longer is given up, while it meshes or between two stages.
4. Reading the model and the first pass cannot be cut short: where they end too late, a note says what took how long.

::

        seconds |                        x         given up, or not even started: it would end too late
                |........................:........ budget
                |            x
                |     x
                |  x  0.2   0.1         0.02 mm
                | 0.5

Each finished drawing is handed over at once: the caller can write it before the next pass begins.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import ceil, floor, log, log10
from time import perf_counter
from typing import Any

from hlr.common.types import Progress
from hlr.drawing.drawing import Drawing
from hlr.drawing.notes import Note, Noted
from hlr.errors import HlrError
from hlr.pipeline.draw import draw_views
from hlr.pipeline.session import Session
from hlr.request.check import checked, checked_views
from hlr.request.options import Options, View
from hlr.source.model import Source
from hlr.source.selection import open_selected
from hlr.tables.readers import is_brep

COARSE = 10.0
"""How much coarser than usual the first drawing is: 0.5 mm, the width of a line, where 0.05 is usual."""
FIRST_SIZE = 1000.0
"""The first drawing is no finer than its diagonal over this. On A4 that is less than 0.5 mm."""
LEAST_STEPS = 100.0
"""Of several views of different sizes, none is coarser than its own diagonal over this for that reason."""
FINEST = 0.04
"""Finest accuracy where none is asked for, as a share of the usual one: 0.002 mm, which no printer shows."""
LADDER = (1, 2, 5)
"""Accuracies after the first are these times powers of ten: 0.5, 0.2, 0.1, ... mm. There are few rungs, so that chance
seldom picks the drawing."""

FIRST_GROWTH = 1.8
"""Exponent p of the growth until two passes have shown it: the steepest that was measured, on a screw with its thread,
from 0.05 mm on. Where the growth is steeper still, the pass is given up after meshing, before the time is over."""
MESH_GROWTH = 0.8
"""The same for a mesh: its triangles are given, only the number of lines grows."""
LEAST_GROWTH, CAUTION = 0.4, 0.3
"""Least exponent, and what is added to the one that two passes have shown: the first pass also loaded libraries, and
meshing grows faster as it gets finer."""
BOLDEST = 6.0
"""One pass is at most this many times finer than the last."""
TELLING = 0.2
"""Share of a pass that must be over before the rest is estimated from it: meshing a mesh takes next to nothing."""
SPARE = 0.9
"""Share of the remaining time that a pass may be expected to take."""

Finished = Callable[[list[Drawing]], None]


class _TooLong(Exception):  # noqa: N818 - not an error, and nobody sees it
    """A pass would end too late."""


def draw_within(
    source: Any,
    views: Sequence[View],
    options: Options,
    progress: Progress | None = None,
    finished: Finished | None = None,
    started: float | None = None,
    noted: Noted | None = None,
) -> list[Drawing]:
    """One drawing per view, as fine as `options.within` seconds allow, but not finer than `options.accuracy`.

    finished: called with the drawings of each pass as soon as they are there; its time counts.
    started: when the time began, by `perf_counter`; None: now. Loading and reading count from there.
    noted: as of `hlr.pipeline.draw.draw_views`.

    Where reading and the first pass take longer than that, the first drawing is the result, and a note states the
    excess and where it comes from. KeyboardInterrupt before the first drawing is raised; after it, the last finished
    drawing is the result.
    Raises what `hlr.pipeline.draw.draw_views` raises.
    """
    started = perf_counter() if started is None else started
    options = checked(options)
    assert options.within is not None
    budget = options.within
    views = checked_views(views, options)
    if not views:
        return []
    opened = open_selected(source, options)
    first, goal = _range(opened, views, options)
    read = perf_counter() - started
    guess = FIRST_GROWTH if is_brep(opened.kind) else MESH_GROWTH
    request = replace(options, within=None, report=False)
    best: list[Drawing] = []
    passes: list[tuple[float, float, dict[str, float]]] = []
    accuracy: float | None = first
    while accuracy is not None:
        begun = perf_counter()
        watch = _Watch(progress, passes[-1], begun, started + budget) if passes else progress
        try:
            best = draw_views(opened, views, replace(request, accuracy=accuracy), watch, None if best else noted)
        except (_TooLong, KeyboardInterrupt, HlrError, MemoryError):
            if not best:
                raise
            break
        best = [replace(x, accuracy=replace(x.accuracy, asked=options.accuracy, within=budget)) for x in best]
        took = perf_counter() - started
        if not passes and took > budget:
            late = _late(took, read, budget, accuracy)
            best = [replace(x, notes=(*x.notes, late)) for x in best]
        if finished is not None:
            finished(best)
        now = perf_counter()
        passes.append((accuracy, now - begun, dict(best[-1].timings)))
        accuracy = _next(passes, goal, budget - (now - started), guess)
    return best


def _late(took: float, read: float, budget: float, accuracy: float) -> Note:
    """The note of a first drawing that ended too late. took, read, budget: seconds, reading among those it took."""
    text = (
        f"{took - budget:.1f} s over the {budget:g} s asked for: loading and reading the model, which cannot be cut "
        f"short, took {read:.1f} s, and the coarsest drawing, of {accuracy:.3g} mm, {took - read:.1f} s"
    )
    return Note("over-time", text)


def _range(opened: Source, views: list[View], options: Options) -> tuple[float, float]:
    """The first accuracy and the finest one, millimetres on paper."""
    session = Session(opened, views, replace(options, accuracy=None))
    usual = min(placement.tolerances.accuracy for placement in session.placements)
    diagonals = [placement.diagonal for placement in session.placements]
    bounded = min(max(diagonals) / FIRST_SIZE, min(diagonals) / LEAST_STEPS)
    goal = options.accuracy if options.accuracy is not None else FINEST * usual
    return max(goal, COARSE * usual, bounded), goal


def _rungs(coarsest: float, finest: float) -> list[float]:
    """The accuracies of the ladder between both, ascending; the finest is among them, the coarsest is not."""
    powers = range(floor(log10(finest)), ceil(log10(coarsest)))
    rungs = [float(f"{digit}e{power}") for power in powers for digit in LADDER]
    return [finest, *(rung for rung in rungs if finest < rung < coarsest)]


def _growth(passes: Sequence[tuple[float, float, dict[str, float]]], guess: float) -> float:
    """The exponent by which the time of a pass grows with its fineness; a guess until two passes have shown it."""
    if len(passes) < 2:
        return guess
    (a, time_a, _), (b, time_b, _) = passes[-2:]
    return max(LEAST_GROWTH, log(max(time_b / time_a, 1.0)) / log(a / b) + CAUTION)


def _next(
    passes: Sequence[tuple[float, float, dict[str, float]]], goal: float, left: float, guess: float
) -> float | None:
    """The finest accuracy that can be finished in `left` seconds; None where there is none."""
    accuracy, took, _ = passes[-1]
    if accuracy <= goal or left <= 0.0:
        return None
    finer = float((left * SPARE / took) ** (1.0 / _growth(passes, guess)))
    finest = accuracy / min(finer, BOLDEST)
    return next((rung for rung in _rungs(accuracy, goal) if finest <= rung), None)


class _Watch:
    """Progress of a pass; gives it up where the stages so far show that it will end too late."""

    def __init__(
        self,
        show: Progress | None,
        last: tuple[float, float, dict[str, float]],
        begun: float,
        deadline: float,
    ) -> None:
        self._show, self._begun, self._deadline = show, begun, deadline
        _, took, timings = last
        self._before = {"scene": timings["tessellate"], "visibility": timings["tessellate"] + timings["scene"]}
        self._whole = max(took, 1e-9)

    def __call__(self, stage: str, done: float) -> None:
        """As `hlr.common.types.Progress`; raises _TooLong."""
        if self._show is not None:
            self._show(stage, done)
        now = perf_counter()
        share = min(self._before.get(stage, 0.0) / self._whole, 1.0) if done == 0.0 else 0.0
        # The later stages grow no faster than meshing, which comes first.
        ends = self._begun + (now - self._begun) / share if share > TELLING else now
        if ends > self._deadline:
            raise _TooLong
