"""Lengths of intersection lines that another line runs beside, so near that both cannot be read."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from hlr.drawing.drawing import Drawing

Floats = npt.NDArray[np.float64]

NEAR = 0.15
"""Millimetres on paper: lines nearer than this are one line for the eye."""
PARALLEL = 0.97
"""Cosine of the angle up to which two lines run the same way."""
STEP = 0.1
RUN = 1.0
"""Millimetres: what is shorter is a crossing, or an end."""


def sampled(points: Floats) -> tuple[Floats, Floats, float]:
    """Points along a polyline, its direction at each, and the length that each stands for."""
    ways = np.diff(points, axis=0)
    lengths = np.hypot(*ways.T)
    ends = np.concatenate([[0.0], np.cumsum(lengths)])
    count = max(int(ends[-1] / STEP), 1)
    places = (np.arange(count) + 0.5) * ends[-1] / count
    at = np.clip(np.searchsorted(ends, places) - 1, 0, len(ways) - 1)
    share = (places - ends[at]) / np.maximum(lengths[at], 1e-12)
    directions = ways[at] / np.maximum(lengths[at], 1e-12)[:, None]
    return points[at] + share[:, None] * ways[at], directions, float(ends[-1] / count)


def accompanied(points: Floats, directions: Floats, other: Floats) -> npt.NDArray[np.bool_]:
    """Whether a polyline passes each point at less than NEAR, in the same direction."""
    start, way = other[:-1], np.diff(other, axis=0)
    squared = np.maximum((way**2).sum(axis=1), 1e-24)
    to = points[:, None] - start
    share = np.clip((to * way).sum(axis=2) / squared, 0.0, 1.0)
    near = np.hypot(*np.moveaxis(to - share[..., None] * way, 2, 0)) < NEAR
    along = np.abs(directions @ (way / np.sqrt(squared)[:, None]).T) > PARALLEL
    return np.asarray((near & along).any(axis=1))


def side_by_side(drawing: Drawing) -> float:
    """Millimetres of intersection lines, visible and hidden, that run beside other lines over more than RUN."""
    total = 0.0
    lines = [np.asarray(line.points) for line in drawing.lines]
    for i, line in enumerate(drawing.lines):
        if line.kind != "intersection":
            continue
        points, directions, step = sampled(lines[i])
        low, high = points.min(axis=0) - NEAR, points.max(axis=0) + NEAR
        beside = np.zeros(len(points), bool)
        for k, other in enumerate(lines):
            if k != i and (other.max(axis=0) >= low).all() and (other.min(axis=0) <= high).all():
                beside |= accompanied(points, directions, other)
        changes = np.flatnonzero(np.diff(np.concatenate([[False], beside, [False]])))
        runs = np.diff(changes.reshape(-1, 2), axis=1).ravel() * step
        total += float(runs[runs > RUN].sum())
    return total
