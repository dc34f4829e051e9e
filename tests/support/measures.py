"""Measures for comparing drawings: straight pieces as sets, distances, and lengths of lines drawn twice."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise

import numpy as np
from scipy.spatial import cKDTree

from hlr import Drawing, Line
from hlr.lab.sampling import with_ends

DIGITS = 6
FIRST = 4
"""Pieces that are tried for each point before it is asked whether another one may be nearer."""


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
    half = np.hypot(*(pieces[:, 1] - pieces[:, 0]).T) / 2
    # Pieces about as long as one another: how far their middles are says which of them may be the nearest.
    sizes = np.frexp(half)[1] // 3
    for size in np.unique(sizes):
        _nearer(points, pieces[sizes == size], half[sizes == size].max(), best)
    return best


def _nearer(points: np.ndarray, pieces: np.ndarray, half: float, best: np.ndarray) -> None:
    """Lower `best` where one of these pieces is nearer; half: half the length of the longest."""
    tree, left, many = cKDTree(pieces.mean(axis=1)), np.arange(len(points)), min(FIRST, len(pieces))
    while len(left):
        away, number = tree.query(points[left], range(1, many + 1))
        best[left] = np.minimum(best[left], _to_pieces(points[left], pieces[number.T]).min(axis=0))
        if many == len(pieces):
            return
        # No other piece has a nearer middle.
        left, many = left[away[:, -1] - half < best[left]], min(2 * many, len(pieces))


def _to_pieces(points: np.ndarray, pieces: np.ndarray) -> np.ndarray:
    """(k, m) from each of the points (m, 2) to k pieces (k, m, 2, 2) of its own."""
    way, off = pieces[:, :, 1] - pieces[:, :, 0], points - pieces[:, :, 0]
    square = np.einsum("kmi,kmi->km", way, way)
    t = np.clip(np.einsum("kmi,kmi->km", off, way) / np.where(square > 0.0, square, 1.0), 0.0, 1.0)
    off -= t[:, :, None] * way
    return np.hypot(off[:, :, 0], off[:, :, 1])


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
        off = np.abs((others - a) @ normal)
        near = (off[:, 0] < width) & (off[:, 1] < width)
        along = (others[near] - a) @ d
        overlap = np.minimum(along.max(axis=1), size) - np.maximum(along.min(axis=1), 0.0)
        total += float(overlap[overlap > 2 * width].sum())
    return total
