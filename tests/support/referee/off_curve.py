"""Whether every drawn edge lies on its own curve, as the model file defines it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from support.referee.exchange import Exchange, Floats

SAMPLES = 60
"""Per line."""
ALLOWED = 1.0
"""Accuracies that a line may lie off its curve."""


@dataclass(frozen=True)
class Off:
    """A line off its curve: its number, the distance in accuracies, the place on paper."""

    line: int
    accuracies: float
    at: tuple[float, float]


def off_curve(drawing: Exchange, true: Callable[[str, int], Any], slack: Callable[[str, int], float]) -> list[Off]:
    """Lines of edges that are farther from their curves than the accuracy and the file's tolerance allow, worst first.

    true: from a part's name and an edge's number to points (n, 3) of its curve in the model
    slack: the tolerance that the file itself states for that edge and its vertices, model units
    """
    found = []
    for number, line in enumerate(drawing.lines):
        if line.edge is None:
            continue
        curve = true(drawing.parts[line.part], line.edge)
        if curve is None:
            continue
        path = drawing.on_paper(curve)
        path = path[np.isfinite(path).all(axis=1)]
        if len(path) < 2:
            continue
        length = float(np.linalg.norm(np.diff(line.points, axis=0), axis=1).sum())
        ink = line.ink(max(length / SAMPLES, 1e-9))
        allowed = drawing.accuracy * ALLOWED + slack(drawing.parts[line.part], line.edge) * drawing.factor
        away = distances(ink, path, allowed)
        worst = int(np.argmax(away))
        if away[worst] > allowed:
            x, y = ink[worst].tolist()
            found.append(Off(number, float(away[worst]) / drawing.accuracy, (x, y)))
    return sorted(found, key=lambda each: -each.accuracies)


def distances(points: Floats, path: Floats, allowed: float) -> Floats:
    """(n,) distances of points (n, 2) to a polyline (m, 2); all chords are tried only for those beyond `allowed`."""
    _, nearest = cKDTree(path).query(points)
    away = np.minimum(
        _to_chord(points, path[np.maximum(nearest - 1, 0)], path[nearest]),
        _to_chord(points, path[nearest], path[np.minimum(nearest + 1, len(path) - 1)]),
    )
    for i in np.flatnonzero(away > allowed):
        away[i] = _to_chord(points[i], path[:-1], path[1:]).min()
    return away


def _to_chord(points: Floats, start: Floats, end: Floats) -> Floats:
    way = end - start
    t = ((points - start) * way).sum(axis=1) / np.maximum((way * way).sum(axis=1), 1e-300)
    return np.asarray(np.linalg.norm(points - start - np.clip(t, 0.0, 1.0)[:, None] * way, axis=1))
