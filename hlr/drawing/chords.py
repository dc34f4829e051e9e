"""Curves as chords: points along them, no further off than is asked for."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from hlr.drawing.curve import Arc, Curve, Points

Index = npt.NDArray[np.int64]

MOST_CHORDS = 20_000
"""Largest number of chords of one curve."""


def numbered(count: Index) -> tuple[Index, Index]:
    """For `count` (m,) samples of each of m items in a row: the item (n,) of each sample, and its number (n,) in it."""
    whose = np.repeat(np.arange(len(count)), count)
    return whose, np.arange(len(whose)) - np.repeat(np.cumsum(count) - count, count)


def chords(curve: Curve, most_off: float) -> Points:
    """(n, 2) points along a curve, such that the chords between them are at most `most_off` millimetres off it.

    The chord error of n pieces is |second difference| / 8 n^2.
    """
    if isinstance(curve, Arc):
        start, end = curve.angles
        count = math.ceil(abs(end - start) * math.sqrt(max(curve.radii) / (8.0 * most_off)))
        return evenly(curve, min(max(count, 1), MOST_CHORDS) + 1)
    d = curve.degree
    pieces = bezier_pieces(curve)
    p = np.stack([curve.points[k : k + d * (pieces - 1) + 1 : d] for k in range(d + 1)])
    bend = np.linalg.norm(np.diff(p, n=2, axis=0), axis=2).max(axis=0) * (d * (d - 1))
    count = np.clip(np.ceil(np.sqrt(bend / (8.0 * most_off))), 1, MOST_CHORDS).astype(np.int64)
    piece, number = numbered(count)
    return curve.at(np.append(piece + number / count[piece], float(pieces)))


def evenly(curve: Curve, count: int) -> Points:
    """(count, 2) points at even steps of a curve's parameter."""
    first, last = curve.angles if isinstance(curve, Arc) else (0.0, float(bezier_pieces(curve)))
    return curve.at(np.linspace(first, last, count))


def bezier_pieces(curve: Curve) -> int:
    """The number of Bezier curves in a chain; 1 for an arc."""
    return 1 if isinstance(curve, Arc) else (len(curve.points) - 1) // curve.degree
