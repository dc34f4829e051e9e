"""Bounding boxes of points, and limits on the size of a model."""

from __future__ import annotations

import math

import numpy as np

from hlr.common.types import Floats
from hlr.errors import SourceError

LARGEST_COORDINATE, SMALLEST_SIZE = 1e60, 1e-60
"""Model units: products of five such lengths neither overflow nor vanish in floating point."""


def check_bounds(name: str, bounds: Floats) -> Floats:
    """Return the bounds (2, 3) of a model if its coordinates are within the limits.

    Raises:
        SourceError: a coordinate is beyond LARGEST or is no number; or no side reaches SMALLEST, and not all are zero.
    """
    low, high = bounds.tolist()
    if not all([abs(c) < LARGEST_COORDINATE for c in (*low, *high)]):  # also where one is NaN
        raise SourceError(f"{name} has no finite size, or coordinates beyond {LARGEST_COORDINATE:g}: repair the model.")
    if 0.0 < (size := max([b - a for a, b in zip(low, high, strict=True)])) < SMALLEST_SIZE:
        raise SourceError(f"{name} is only {size:.3g} large, where {SMALLEST_SIZE:g} is the least: scale the model up.")
    return bounds


def diagonal(bounds: Floats) -> float:
    """Length of the diagonal of a box (2, 3)."""
    (a, b, c), (d, e, f) = bounds.tolist()
    x, y, z = d - a, e - b, f - c
    return math.sqrt(x * x + y * y + z * z)


ROWS_AT_ONCE = 64


def bounding_box(points: Floats) -> Floats:
    """(2, 3) lower and upper corner of points (n, 3), n > 0."""
    # Many rows side by side: along an axis of length three NumPy takes ten times as long.
    whole = len(points) - len(points) % ROWS_AT_ONCE
    wide, rest = points[:whole].reshape(-1, 3 * ROWS_AT_ONCE), points[whole:]
    low, high = [rest], [rest]
    if whole:
        low.append(wide.min(axis=0).reshape(ROWS_AT_ONCE, 3))
        high.append(wide.max(axis=0).reshape(ROWS_AT_ONCE, 3))
    return np.stack((np.concatenate(low).min(axis=0), np.concatenate(high).max(axis=0)))
