"""Measures for comparing drawings: straight pieces as sets, distances, and lengths of lines drawn twice."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise

import numpy as np

from hlr import Drawing, Line
from hlr.lab.sampling import with_ends

DIGITS = 6


def counts(drawing: Drawing) -> Counter[tuple[str, bool]]:
    """How many lines of each kind and visibility."""
    return Counter((line.kind, line.visible) for line in drawing.lines)


def length(line: Line) -> float:
    """The length of a line on paper, millimetres."""
    return float(np.sqrt((np.diff(line.points, axis=0) ** 2).sum(axis=1)).sum())


def placed(drawing: Drawing, line: Line) -> np.ndarray:
    """(n, 2) points of a line on paper, millimetres, before the drawing was moved to its origin."""
    return line.points + np.asarray(drawing.origin)


def straight(drawing: Drawing, visible: bool | None = None) -> dict[tuple, int]:
    """Every straight piece as ((x0, y0), (x1, y1), visible), and its count; only for drawings without curves."""
    found: Counter[tuple] = Counter()
    for line in drawing.lines:
        if visible is None or line.visible == visible:
            for a, b in pairwise(np.round(placed(drawing, line), DIGITS) + 0.0):
                found[(*sorted((tuple(a.tolist()), tuple(b.tolist()))), line.visible)] += 1
    return found


def segments(drawing: Drawing, visible: bool | None = None) -> np.ndarray:
    """(n, 2, 2) straight pieces of all lines."""
    chosen = [placed(drawing, line) for line in drawing.lines if visible is None or line.visible == visible]
    pieces = [np.stack([p[:-1], p[1:]], axis=1) for p in chosen]
    return np.concatenate([np.zeros((0, 2, 2)), *pieces])


def samples(pieces: np.ndarray, step: float) -> np.ndarray:
    """(m, 2) points along pieces, at most `step` apart."""
    return with_ends(pieces.reshape(-1, 4), step).points


def distances(points: np.ndarray, pieces: np.ndarray) -> np.ndarray:
    """(m,) from each point to the nearest piece."""
    best = np.full(len(points), np.inf)
    for a, b in pieces:
        d = b - a
        square = float(d @ d)
        t = np.clip(((points - a) @ d) / square, 0.0, 1.0) if square else np.zeros(len(points))
        best = np.minimum(best, np.hypot(*(points - a - t[:, None] * d).T))
    return best


def apart(one: np.ndarray, other: np.ndarray, step: float = 0.5) -> float:
    """Hausdorff distance of two sets of pieces, sampled."""
    there, back = distances(samples(one, step), other), distances(samples(other, step), one)
    return float(max(there.max(initial=0.0), back.max(initial=0.0)))


def drawn_twice(drawing: Drawing, width: float | None = None) -> float:
    """Millimetres on paper along which a line lies on another one, or on itself."""
    width = 0.2 * drawing.accuracy.used if width is None else width
    pieces = segments(drawing)
    pieces = pieces[np.hypot(*(pieces[:, 1] - pieces[:, 0]).T) > 4 * width]
    total = 0.0
    for i, (a, b) in enumerate(pieces):
        d = b - a
        size = float(np.hypot(*d))
        d = d / size
        normal = np.array([-d[1], d[0]])
        others = pieces[i + 1 :]
        off = np.abs((others - a) @ normal).max(axis=1, initial=0.0)
        along = (others - a) @ d
        overlap = np.minimum(along.max(axis=1), size) - np.maximum(along.min(axis=1), 0.0)
        total += float(overlap[(off < width) & (overlap > 2 * width)].sum())
    return total
