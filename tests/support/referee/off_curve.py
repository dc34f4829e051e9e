"""Does every drawn edge lie on its own curve, the one that the file has for it?"""

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
    """A line off its curve: its number, how far in accuracies, where on paper."""

    line: int
    accuracies: float
    at: tuple[float, float]


def off_curve(drawing: Exchange, true: Callable[[str, int], Any], slack: Callable[[str, int], float]) -> list[Off]:
    """Lines of edges that lie farther off their own curves than they may, worst first.

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
    """From each point (n, 2) to a polyline (m, 2); where that is more than `allowed`, to the nearest of all chords."""
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


def file_curves(source: Any) -> tuple[Callable[[str, int], Any], Callable[[str, int], float]]:
    """Both functions for an opened B-rep source; its own numbering of parts and edges, OpenCASCADE's curves."""
    from OCP.BRep import BRep_Tool
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp
    from OCP.TopoDS import TopoDS

    from hlr.source.cad.shapes import sub_shapes
    from support.true_curves import true_curves

    curves = true_curves(source)
    edges = [sub_shapes(root, TopAbs_ShapeEnum.TopAbs_EDGE) for root in source.prototypes.shapes]
    parts = {part.name: part for part in source.parts}

    def true(name: str, edge: int) -> Floats | None:
        try:
            return np.asarray(curves(name, edge))
        except Exception:  # no curve in space
            return None

    def slack(name: str, edge: int) -> float:
        part = parts[name]
        own = TopoDS.Edge_s(edges[part.prototype][edge])
        ends = [end for end in (TopExp.FirstVertex_s(own), TopExp.LastVertex_s(own)) if not end.IsNull()]
        # A curve need not end at its vertices, and there neighbours meet: lines go to the vertex.
        stated = max(BRep_Tool.Tolerance_s(own), *map(BRep_Tool.Tolerance_s, ends), 0.0)
        return abs(float(np.linalg.det(part.transform[:3, :3]))) ** (1 / 3) * stated

    return true, slack
