"""The study as CSV, written and read again."""

from __future__ import annotations

import csv
import io
from typing import Any

from hlr.lab.study.job import STAGES, Cost, Point
from hlr.lab.study.sweep import Study

ERRORS = (
    "off_mean",
    "off_p99",
    "off_worst",
    "ink_mean",
    "ink_p99",
    "ink_worst",
    "too_much",
    "missing",
    "mislabelled",
    "wrong",
)
COUNTS = ("lines", "segments", "bytes", "triangles", "failed_checks", "contradictions")
CLASSES = ("edges", "outlines", "meshes", "intersections", "changes", "lost", "short")
"""Of `hlr.lab.measure`, with their worst; labels are told apart."""


def comma_separated(found: Study) -> str:
    """One row for each point; empty cells where a contestant has no such figure."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    stages = [f"{stage}_{what}" for stage in STAGES for what in ("wall_s", "cpu_s", "mb")]
    writer.writerow(
        ["who", "setting", "accuracy_mm", "failure", "runs", "wall_s", "cpu_s", "mb", *COUNTS, *ERRORS]
        + [f"reached_{name}" for name in (*CLASSES, "labels_share", "labels_longest")]
        + stages
    )
    for p in found.points:
        row: list[Any] = [p.who, f"{p.setting:g}", "" if p.accuracy is None else f"{p.accuracy:.6g}", p.failure or ""]
        if p.failure is None:
            row += [p.runs, f"{p.seconds:.6f}", f"{p.processor:.6f}", f"{p.memory:.1f}"]
            row += [p.counts.get(name, "") for name in COUNTS]
            row += [f"{p.errors[name]:.6g}" if name in p.errors else "" for name in ERRORS]
            row += [_plain(worst(p, name)) for name in CLASSES]
            labels = p.reached.get("labels") or {}
            row += [_plain(labels.get("share")), _plain(labels.get("longest"))]
            for stage in STAGES:
                cost = p.stages.get(stage)
                row += ["", "", ""] if cost is None else [f"{cost.wall:.6f}", f"{cost.cpu:.6f}", f"{cost.memory:.1f}"]
        writer.writerow(row)
    return out.getvalue()


def arithmetic_csv(found: Study) -> str:
    """One row for each kind of arithmetic and accuracy."""
    out = io.StringIO()
    if found.arithmetic:
        writer = csv.DictWriter(out, list(found.arithmetic[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(found.arithmetic)
    return out.getvalue()


def _plain(value: Any) -> str:
    return "" if value is None else f"{float(value):.6g}"


def worst(point: Point, name: str) -> float | None:
    """The largest error of a class that `hlr.lab.measure` found, millimetres; None: not measured."""
    errors = point.reached.get(name) or {}
    value = errors.get("worst")
    return None if value is None else float(value)


def points_of(text: str) -> list[Point]:
    """Read the points of a table that `comma_separated` wrote, with all figures that the plots need."""
    out = []
    for row in csv.DictReader(io.StringIO(text)):
        accuracy = float(row["accuracy_mm"]) if row["accuracy_mm"] else None
        point = Point(row["who"], float(row["setting"]), accuracy, row["failure"] or None)
        if point.failure is None:
            point.runs = int(row["runs"])
            point.counts = {name: int(row[name]) for name in COUNTS if row[name]}
            point.errors = {name: float(row[name]) for name in ERRORS if row[name]}
            point.stages = {
                stage: Cost(*(float(row[f"{stage}_{what}"]) for what in ("wall_s", "cpu_s", "mb")))
                for stage in STAGES
                if row[f"{stage}_wall_s"]
            }
        out.append(point)
    return out
