"""The methods timed side by side, each on each scene, within a time limit."""

from __future__ import annotations

import statistics
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from hlr.lab.methods.limits import NotFinishedError, limits
from hlr.lab.methods.render import Statistics
from hlr.lab.methods.table import METHODS
from hlr.lab.methods.viewport import Viewport

REPEATS = 3
QUICK = 0.5
"""Seconds: a shorter run is repeated, and the median taken."""

Trial = tuple[str, str]
"""A method and its variant."""

TRIALS: tuple[Trial, ...] = (*((m, "") for m in METHODS), ("ray casting", "grid"), ("ray casting", "partition"))


@dataclass(frozen=True, slots=True)
class Scenery:
    """A scene to time: its name and number of polygons; `make` makes the kernel's scene anew for each run."""

    name: str
    count: int
    make: Callable[[], Any]
    viewport: Viewport


@dataclass(frozen=True, slots=True)
class Timing:
    """One method on one scene; statistics None: not finished within the limit.

    seconds: processor time of one call: projecting, clipping, sorting, trees and drawing; None: not finished
    """

    scene: str
    count: int
    method: str
    seconds: float | None
    statistics: Statistics | None
    limit: float | None = None
    """Seconds that it was given."""


def label(trial: Trial) -> str:
    """The name of a trial in tables, such as "ray casting, grid"."""
    method, variant = trial
    return f"{method}, {variant}" if variant else method


def measure(
    sceneries: Sequence[Scenery],
    limit: float,
    trials: Sequence[Trial] = TRIALS,
    progress: Callable[[str, float], None] | None = None,
) -> list[Timing]:
    """Time each trial on each scene. limit: seconds of processor time for each; Ctrl-C stops at once."""
    out: list[Timing] = []
    tell = progress or (lambda _stage, _done: None)
    for i, scenery in enumerate(sceneries):
        for k, trial in enumerate(trials):
            tell("methods", (i + k / len(trials)) / len(sceneries))
            out.append(_one(scenery, trial, limit))
    tell("methods", 1.0)
    return out


def _one(scenery: Scenery, trial: Trial, limit: float) -> Timing:
    found: list[Statistics] = []
    for _ in range(REPEATS):
        # Each run has a new scene: a BSP tree that exists already would cost nothing.
        within = limits(limit, worked=True)
        try:
            with within.over(label(trial)):
                answer = scenery.make().render(scenery.viewport.kernel(), trial, within.kernel(), "", False)
        except NotFinishedError:
            return Timing(scenery.name, scenery.count, label(trial), None, None, limit)
        found.append(Statistics(**answer["statistics"]))
        if found[0].seconds > QUICK:
            break
    seconds = statistics.median(s.prepared + s.seconds for s in found)
    return Timing(scenery.name, scenery.count, label(trial), seconds, found[0], limit)
