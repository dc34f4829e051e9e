"""How large and how small a model may be."""

from __future__ import annotations

import numpy as np

from hlr.common.types import Floats
from hlr.errors import SourceError

LARGEST, SMALLEST = 1e60, 1e-60
"""Model units. Products of five lengths neither overflow nor vanish; no true model comes near."""


def checked(name: str, bounds: Floats) -> Floats:
    """The bounds (2, 3), if they can be calculated with.

    Raises:
        SourceError: a coordinate is beyond LARGEST or is no number; or no side reaches SMALLEST, and not all are zero.
    """
    low, high = bounds.tolist()
    if not all(abs(c) < LARGEST for c in (*low, *high)):  # also where one is NaN
        raise SourceError(f"{name} has no finite size, or coordinates beyond {LARGEST:g}: repair the model.")
    if 0.0 < (size := max(b - a for a, b in zip(low, high, strict=True))) < SMALLEST:
        raise SourceError(f"{name} is only {size:.3g} large, where {SMALLEST:g} is the least: scale the model up.")
    return bounds


ROWS = 64


def box(points: Floats) -> Floats:
    """(2, 3) lower and upper corner of points (n, 3), of which there is one at least."""
    # So many rows side by side: along an axis of three NumPy takes ten times as long.
    whole = len(points) - len(points) % ROWS
    wide, rest = points[:whole].reshape(-1, 3 * ROWS), points[whole:]
    low, high = [rest], [rest]
    if whole:
        low.append(wide.min(axis=0).reshape(ROWS, 3))
        high.append(wide.max(axis=0).reshape(ROWS, 3))
    return np.stack((np.concatenate(low).min(axis=0), np.concatenate(high).max(axis=0)))
