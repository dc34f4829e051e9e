"""The Pareto front: the points for which no other is both faster and more accurate."""

from __future__ import annotations

from collections.abc import Sequence

from hlr.lab.study.job import Point


def frontier(points: Sequence[Point], error: str) -> list[Point]:
    """Points on the Pareto front of processor seconds and an error (a name in `Point.errors`), quickest first."""
    known = [p for p in points if p.failure is None and error in p.errors and p.processor > 0.0]
    out: list[Point] = []
    for point in sorted(known, key=lambda p: (p.processor, p.errors[error])):
        if not out or point.errors[error] < out[-1].errors[error]:
            out.append(point)
    return out
