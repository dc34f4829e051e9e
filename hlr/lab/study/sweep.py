"""The study: decides which points are measured, in which order, and which are left out."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from hlr.common.types import Progress
from hlr.errors import OptionError, SourceError
from hlr.lab.study.job import ACCURACIES, EXACT, HLR, PIXELS, POLY, PREDICATES, ZBUFFER, Job, Point, point_of
from hlr.lab.study.process import answer
from hlr.request.check import check_accuracy
from hlr.request.defaults import STUDY_LIMIT_S, STUDY_RUNS
from hlr.request.options import Parameter, View

A4 = (277.0, 190.0)
"""Millimetres: a landscape sheet with its margins."""

FINER = 0.4
"""Accuracy of the true lines, as a share of the finest accuracy that could be drawn."""
PATIENCE = 3.0
"""Time allowed for the true lines and the judge, as a multiple of the limit."""


@dataclass(slots=True)
class Study:
    """All results of one model.

    source  path of the model
    view    a name, or the direction from the object toward the viewer
    limit   seconds of processor time for each point
    runs    how often each contestant draws at each point
    points  what was measured, in the order of measuring
    look    what is drawn: name, scale, width, height, parts, lines, triangles
    truth   accuracy of the true lines, millimetres; None: they could not be drawn, and there are no errors
    arithmetic  per accuracy, the kernel's pass with each kind of arithmetic (`hlr.lab.study.arithmetic.Rounding`)
    notes   sentences on what was left out
    finished  False if the study was stopped
    """

    source: str
    view: View
    limit: float
    runs: int
    look: dict[str, Any] = field(default_factory=dict)
    truth: float | None = None
    points: list[Point] = field(default_factory=list)
    arithmetic: list[dict[str, Any]] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    finished: bool = False


@dataclass(frozen=True, slots=True)
class Scope:
    """What is to be measured.

    accuracies  of hlr and PolyAlgo, millimetres on paper
    pixels      of the depth buffers, along the longer side
    predicates  accuracies at which kinds of arithmetic are compared, millimetres on paper
    rivals      whether other programs are measured
    reached     whether drawings of hlr are measured class by class
    """

    accuracies: Sequence[float] = ACCURACIES
    pixels: Sequence[int] = PIXELS
    predicates: Sequence[float] = PREDICATES
    rivals: bool = True
    reached: bool = True


def study(  # noqa: PLR0913 - one for each thing a user may ask
    source: str,
    view: View = "iso",
    *,
    scale: float | None = None,
    fit: tuple[float, float] | None = None,
    scope: Scope | None = None,
    limit: float = STUDY_LIMIT_S,
    runs: int = STUDY_RUNS,
    only: Sequence[str] = (),
    hide: Sequence[str] = (),
    var: str | None = None,
    parameters: Mapping[str, Parameter] | None = None,
    annotations: bool = False,
    hidden_objects: bool = False,
    into: Study | None = None,
    progress: Progress | None = None,
) -> Study:
    """Measure all points, each `runs` times in a process of its own.

    scale: paper to model; None: as large as fits into `fit` (an A4 sheet). limit: processor seconds for each point.
    only, hide, var, parameters, annotations, hidden_objects: which parts, as for a drawing (`hlr.Options`).
    into: a Study that is filled step by step, so that finished results survive an interruption.

    Raises OptionError, and SourceError where the model cannot be drawn at all.
    """
    scope = scope or Scope()
    if not limit > 0.0 or runs < 1:
        raise OptionError("a study needs a positive limit of seconds, and at least one run")
    for accuracy in (*scope.accuracies, *scope.predicates):
        check_accuracy(accuracy)
    out = into if into is not None else Study(source, view, limit, runs)
    told = progress or (lambda _stage, _done: None)
    with tempfile.TemporaryDirectory(prefix="hlr-study-") as folder:
        # Without a given scale the first look finds the largest that fits; all later points use it.
        chosen: dict[str, Any] = {
            "only": tuple(only),
            "hide": tuple(hide),
            "var": var,
            "parameters": parameters,
            "annotations": annotations,
            "hidden_objects": hidden_objects,
        }
        first = Job("look", source, view, scale=scale, fit=fit or A4, limit=PATIENCE * limit, **chosen)
        told("look", 0.0)
        out.look = answer(first)
        if out.look.get("failure"):
            raise SourceError(f"{source} cannot be studied: {out.look['failure']}")
        common = {"source": source, "view": view, "scale": out.look["scale"], "folder": folder, "runs": runs, **chosen}
        _Points(out, common, scope, limit, told).run()
    out.finished = True
    return out


class _Points:
    """Measures all points, one after another."""

    def __init__(
        self, out: Study, common: dict[str, Any], scope: Scope, limit: float, progress: Callable[[str, float], None]
    ) -> None:
        self._out, self._common, self._scope, self._limit, self._progress = out, common, scope, limit, progress
        self._steps, self._done = 1, 0

    def run(self) -> None:
        wanted: list[tuple[str, Sequence[float]]] = [(HLR, sorted(self._scope.accuracies, reverse=True))]
        if self._scope.rivals:
            wanted += [
                (POLY, sorted(self._scope.accuracies, reverse=True)),
                (EXACT, [0.0]),
                (ZBUFFER, sorted(self._scope.pixels)),
            ]
        count = sum(len(settings) for _, settings in wanted)
        self._steps = 2 * count + len(self._scope.predicates) + len(self._scope.accuracies) + 1
        for who, settings in wanted:
            self._first(who, settings)
        self._truth()
        self._judge()
        for accuracy in self._scope.predicates:
            self._arithmetic(accuracy)
        if self._scope.reached:
            self._reached()

    def _answer(self, work: str, setting: float, name: str = "", patience: float = 1.0) -> dict[str, Any]:
        self._done += 1
        self._progress(f"{work} {setting:g}" if setting else work, min(self._done / self._steps, 1.0))
        return answer(Job(work, setting=setting, name=name, limit=self._limit * patience, **self._common))

    def _first(self, who: str, settings: Sequence[float]) -> None:
        """Measure the settings coarse to fine, until one takes too long: the finer ones would as well."""
        late: float | None = None
        for setting in settings:
            number = len(self._out.points)
            if late is not None:
                found: dict[str, Any] = {"failure": f"not tried: {late:g} was not finished"}
            else:
                found = self._answer(who, setting, f"{number}")
            if found.get("failure"):
                if found["failure"].startswith("not finished"):
                    late = setting
                accuracy = setting if who in (HLR, POLY) else None
                self._out.points.append(Point(who, setting, accuracy, failure=found["failure"]))
                continue
            self._out.points.append(point_of(found))

    def _truth(self) -> None:
        """Draw the true lines: finer than all other drawings, or as fine as the finest."""
        drawn = [p.setting for p in self._out.points if p.who == HLR and p.failure is None]
        if not drawn:
            return
        finest = min(drawn)
        for accuracy in (FINER * finest, finest):
            found = self._answer("truth", accuracy, "truth", PATIENCE)
            if not found.get("failure"):
                self._out.truth = accuracy
                return
        self._out.notes.append(
            f"No errors were measured: the true lines could not be drawn ({found['failure'].rstrip('.')})."
        )

    def _judge(self) -> None:
        if self._out.truth is None:
            return
        for number, point in enumerate(self._out.points):
            if point.failure is None:
                found = self._answer("judge", point.setting, f"{number}", PATIENCE)
                if found.get("failure"):
                    self._out.notes.append(
                        f"{point.who} at {point.setting:g} was not judged: {found['failure'].rstrip('.')}."
                    )
                else:
                    point.errors = found["errors"]

    def _arithmetic(self, accuracy: float) -> None:
        found = self._answer("arithmetic", accuracy, patience=PATIENCE)
        if found.get("failure"):
            self._out.notes.append(
                f"Kinds of arithmetic were not compared at {accuracy:g} mm: {found['failure'].rstrip('.')}."
            )
        else:
            self._out.arithmetic += found["kinds"]

    def _reached(self) -> None:
        """Measure our own drawings class by class, coarse to fine, until one does not finish in time."""
        late: float | None = None
        for point in self._out.points:
            if point.who != HLR or point.failure is not None:
                continue
            if late is not None:
                point.reached = {"why": f"not tried: {late:g} mm was not finished"}
                continue
            found = self._answer("reached", point.setting, patience=PATIENCE)
            if not found.get("failure"):
                point.reached = found["reached"]
                continue
            point.reached = {"why": found["failure"]}
            if found["failure"].startswith("not finished"):
                late = point.setting
