"""How exactly the coordinates of a mesh were written: files keep seven digits, or a fixed number of decimals."""

from __future__ import annotations

import math

import numpy as np

from hlr.distinct import distinct
from hlr.source.model import Floats

FINEST_GRID = 2.0**-31
"""Of the size: a finer grid is no rounding."""

SAMPLE = 1 << 17
DIFFERENCES = 256
"""Coordinates, and differences between neighbours, among which the step of a grid is looked for."""

DIGITS = 9
"""Single numbers need so many digits to be written and read without loss."""


COARSEST = 1e-5
"""Of a mesh's extent: nobody rounds more coarsely and has a model left, though short numbers may look like it."""

USED = 0.01
"""Of single numbers that were rounded, nearly all use their last bits; of short ones (0.5, 1000) none do."""


def precision(points: Floats) -> float:
    """How far coordinates (n, 3) may be off by what they were rounded to, in their own unit; 0 without points."""
    size = float(np.abs(points).max(initial=0.0))
    if size == 0.0 or not np.isfinite(size):
        return 0.0
    rounded = _rounded(points, size)
    return rounded if rounded <= COARSEST * float(np.ptp(points, axis=0).max()) else 2.0**-53 * size


def _rounded(points: Floats, size: float) -> float:
    """What the digits of the coordinates say, whether it is likely or not."""
    single = 2.0**-24 * size
    if size < 3e38 and (points.astype(np.float32) == points).all():
        last_bits = points.astype(np.float32).view(np.uint32) & 0xF
        return single if (last_bits != 0).mean() > USED else 2.0**-53 * size
    step = _step((points - points[0]).ravel(), size)
    if step > 0.0:
        return max(0.5 * step, single)
    present = points[points != 0.0]
    digits = DIGITS - 1 - np.floor(np.log10(np.abs(present)))
    return single if _whole(present * 10.0**digits) else 2.0**-53 * size


def _step(values: Floats, size: float) -> float:
    """The step of the grid on which all coordinates lie, such as 0.001 where there are three decimals; 0 without one.

    Euclid's algorithm on the smallest differences finds it in any unit: a file in inches has its decimals there, and a
    model may have been scaled or moved.
    """
    finest = FINEST_GRID * size
    apart = np.diff(distinct(values[:: max(1, len(values) // SAMPLE)]))
    apart = distinct(apart[apart > finest])[:DIFFERENCES]
    step = 0.0
    for difference in [*apart.tolist(), float(np.abs(values).max())]:
        step = _divisor(step, difference, finest)
        if step == 0.0:
            return 0.0
        # The further apart two coordinates are, the more exactly they tell the step.
        step = difference / max(1, round(difference / step))
    return step if (np.abs(values / step - np.round(values / step)) < 1e-3).all() else 0.0


def _divisor(a: float, b: float, finest: float) -> float:
    """The greatest length of which both are multiples; remainders up to `finest` are none."""
    while b > finest:
        rest = math.fmod(a, b)
        a, b = b, min(rest, b - rest)
    return a


def _whole(numbers: Floats) -> bool:
    """Whether all are whole numbers, but for the rounding of the multiplication that made them."""
    return bool((np.abs(numbers - np.round(numbers)) <= 1e-15 * np.abs(numbers) + 1e-12).all())
