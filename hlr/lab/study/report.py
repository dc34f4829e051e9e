"""The study as a Markdown report."""

from __future__ import annotations

from collections.abc import Sequence
from statistics import median
from typing import Any

from hlr.lab.study.advice import advice
from hlr.lab.study.frontier import frontier
from hlr.lab.study.job import EXACT, STAGES, WHO, ZBUFFER, Point
from hlr.lab.study.judge import NOTICED
from hlr.lab.study.sweep import Study
from hlr.lab.study.table import CLASSES, worst


def markdown(found: Study, plots: Sequence[str] = ()) -> str:
    """The report. plots: file names of pictures beside it, first that of errors, then that of stages."""
    look = found.look
    parts = [
        f"# What accuracy costs: {look['name']}",
        f"View {_view(found)}, {look['width']:.0f} x {look['height']:.0f} mm on paper, "
        f"{look['scale']:.4g} times as large as the model; {look['parts']} part{'s' if look['parts'] > 1 else ''}. "
        "Each point is measured in a process of its own, "
        f"{'once' if found.runs == 1 else f'medians of {found.runs} runs, fewer where they take long'}; whatever needs "
        f"more than {found.limit:g} s of processor time, reading included, is not finished. {_floor(found)}"
        + ("" if found.finished else " **The study was stopped; this is what was finished.**"),
    ]
    words = advice(found.points)
    parts += [f"**{words}**"] if words else []
    if plots:
        parts += [f"![error against time]({plots[0]})"]
    parts += ["## Points", _HOW, _points(found)]
    if len(plots) > 1:
        parts += ["## Where the time goes", f"![time by stage]({plots[1]})", _stages(found)]
    measured = [p for p in found.points if p.reached]
    if measured:
        parts += ["## Measured by class", _BY_CLASS, _classes(measured)]
    if found.arithmetic:
        parts += ["## Exact integers, f64 and f32", _ARITHMETIC, _kinds(found.arithmetic)]
    left = [*found.notes, *_failures(found.points)]
    if left:
        parts += ["## What there is not", "\n".join(f"- {sentence}" for sentence in left)]
    if look["notes"]:
        parts += ["## What the drawing notes", "\n".join(f"- {note}" for note in look["notes"])]
    return "\n\n".join(parts) + "\n"


_HOW = f"""From the shape in memory to the lines in memory: reading the file and writing the SVG are not counted.
*Processor* is the time of all cores together, which other programs on the machine hardly disturb; *clock* is what one
waits for. *Ink* is the distance between visible lines as drawn and as they truly are, both ways: 99 of 100 millimetres
of ink are nearer than that. It holds misplaced curves, displaced changes of visibility, and lost and false lines.
*Off* is how far any drawn line is from any true one, visible or hidden. *Wrong* is visible ink that is more than
{NOTICED:g} mm off, too much or missing, as a share of what is truly visible; *mislabelled* is the part of it that is
there with the wrong visibility. Points marked * are on the frontier: none is both quicker and truer.
OCCT's exact lines are curves, of which neither pieces nor bytes are counted."""

_BY_CLASS = """The worst of each class in millimetres on paper, as `hlr.lab.measure` finds it without the visibility
pass: edges against OpenCASCADE's own curves, outlines on the true surface, changes of visibility against a finer
drawing, labels by rays. A dash: this model has nothing of the kind, or it could not be measured."""

_ARITHMETIC = """The kernel's visibility pass on the same snapped points, with predicates in exact integers, in double
and in single precision. *Checked again* are edges whose count of polygons in front did not agree from both ends;
*contradictions* those where even deciding polygon by polygon gave no consistent answer. *Wrong* is what is hidden
instead of visible or the other way round, against the exact answer, before lines are joined and short ones dropped."""


def _floor(found: Study) -> str:
    """A sentence on the true lines with which all contestants are compared, and their accuracy."""
    if found.truth is None:
        return "There are no true lines to judge by."
    reading = [p.stages["source"].wall for p in found.points if p.failure is None and "source" in p.stages]
    return (
        f"All are judged by our lines at {found.truth:.2g} mm: what differs by less cannot be told apart. Reading the "
        f"file takes {_seconds(median(reading))} more, whoever draws."
    )


def _view(found: Study) -> str:
    return found.view if isinstance(found.view, str) else ",".join(f"{c:g}" for c in found.view)


def _name(point: Point) -> str:
    if point.who == EXACT:
        return point.who
    return f"{point.who}, {point.setting:.0f} pixels" if point.who == ZBUFFER else f"{point.who}, {point.setting:g} mm"


def _failures(points: Sequence[Point]) -> list[str]:
    """Sentences on failed measurements; a contestant's settings that failed for the same reason share one."""
    said: dict[tuple[str, str], list[Point]] = {}
    for p in points:
        if p.failure is not None:
            said.setdefault((p.who, p.failure.rstrip(".")), []).append(p)
    return [
        f"{who}{'' if who == EXACT else ' at ' + ', '.join(f'{p.setting:g}' for p in own)}"
        f"{' pixels' if who == ZBUFFER else '' if who == EXACT else ' mm'}: {why}."
        for (who, why), own in said.items()
    ]


def _table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = ["| " + " | ".join(head) + " |", "| --- |" + " ---: |" * (len(head) - 1)]
    return "\n".join([*lines, *("| " + " | ".join(row) + " |" for row in rows)])


def _points(found: Study) -> str:
    best = {id(p) for p in frontier(found.points, "ink_p99")}
    rows = []
    for who in WHO:
        for p in (p for p in found.points if p.who == who and p.failure is None):
            errors = p.errors
            rows.append(
                [
                    _name(p) + (" *" if id(p) in best else ""),
                    _seconds(p.processor),
                    _seconds(p.seconds),
                    f"{p.memory:.0f} MB",
                    _count(p, "lines"),
                    _count(p, "segments"),
                    _count(p, "bytes"),
                    *(_length(errors.get(name)) for name in ("ink_p99", "ink_worst", "off_p99", "off_worst")),
                    _share(errors.get("wrong")),
                    _length(errors.get("mislabelled")),
                ]
            )
    head = ["", "processor", "clock", "memory", "lines", "segments", "SVG"]
    head += ["ink, 99 %", "ink, worst", "off, 99 %", "off, worst", "wrong", "mislabelled, mm"]
    return _table(head, rows)


def _stages(found: Study) -> str:
    rows = []
    for p in (p for p in found.points if p.failure is None):
        costs = [p.stages.get(stage) for stage in STAGES]
        rows.append([_name(p), *("" if c is None else f"{_seconds(c.wall)}, {c.memory:.0f} MB" for c in costs)])
    return _table(["clock and largest memory", *STAGES], rows)


def _classes(points: Sequence[Point]) -> str:
    rows = []
    for p in points:
        labels = p.reached.get("labels") or {}
        why = p.reached.get("why")
        cells = [_length(worst(p, name)) for name in CLASSES] if why is None else [why, *[""] * (len(CLASSES) - 1)]
        rows.append([_name(p), *cells, _share(labels.get("share")), _length(labels.get("longest"))])
    return _table(["", *CLASSES, "labels wrong", "longest"], rows)


def _kinds(kinds: Sequence[dict[str, Any]]) -> str:
    rows = []
    for k in kinds:
        base = next(x for x in kinds if x["accuracy"] == k["accuracy"])
        rows.append(
            [
                f"{k['accuracy']:g} mm, {k['arithmetic']}",
                _seconds(k["processor"]),
                f"{k['processor'] / base['processor']:.2f}" if base["processor"] else "-",
                _seconds(k["seconds"]),
                f"{k['edges']:,}",
                f"{k['failed']:,}",
                f"{k['contradictions']:,}",
                f"{k['wrong_edges']:,}",
                _length(k["wrong"]),
                _length(k["longest"]),
            ]
        )
    head = ["", "processor", "ratio", "clock", "edges", "checked again", "contradictions", "wrong edges", "wrong, mm"]
    return _table([*head, "longest, mm"], rows)


def _count(point: Point, name: str) -> str:
    value = point.counts.get(name)
    if value is None:
        return "-"
    return f"{value / 1000.0:,.0f} kB" if name == "bytes" else f"{value:,}"


def _seconds(value: float) -> str:
    return f"{value * 1e3:.3g} ms" if value < 0.9995 else f"{value:.3g} s"


def _length(value: float | None) -> str:
    if value is None:
        return "-"
    return "0" if abs(value) < NOTHING else f"{value:.2g}" if value < 100.0 else f"{value:.0f}"


NOTHING = 1e-9
"""Millimetres: lengths up to this count as zero."""


def _share(value: float | None) -> str:
    return "-" if value is None else f"{100.0 * value:.2g} %"
