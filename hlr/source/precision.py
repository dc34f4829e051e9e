"""How exactly the coordinates of a mesh were written: files keep seven digits, or a fixed number of decimals."""

from __future__ import annotations

import numpy as np

from hlr.source.model import Floats

MOST_DECIMALS = 9
"""Coordinates with more are no rounded ones."""

DIGITS = 9
"""Single numbers need so many digits to be written and read without loss."""


def precision(points: Floats) -> float:
    """How far coordinates (n, 3) may be off by what they were rounded to, in their own unit; 0 without points."""
    size = float(np.abs(points).max(initial=0.0))
    if size == 0.0 or not np.isfinite(size):
        return 0.0
    single = 2.0**-24 * size
    if size < 3e38 and (points.astype(np.float32) == points).all():
        return single
    for decimals in range(MOST_DECIMALS + 1):
        if _whole(points * 10.0**decimals):
            return max(0.5 * 10.0**-decimals, single)
    present = points[points != 0.0]
    digits = DIGITS - 1 - np.floor(np.log10(np.abs(present)))
    return single if _whole(present * 10.0**digits) else 2.0**-53 * size


def _whole(numbers: Floats) -> bool:
    """Whether all are whole numbers, but for the rounding of the multiplication that made them."""
    return bool((np.abs(numbers - np.round(numbers)) <= 1e-15 * np.abs(numbers) + 1e-12).all())
