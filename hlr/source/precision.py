"""How exactly the coordinates of a mesh were written: files keep seven digits, or a fixed number of decimals."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np
import numpy.typing as npt

from hlr.common.distinct import distinct
from hlr.common.types import Floats
from hlr.source.bounds import bounding_box

FINEST_GRID = 2.0**-31
"""Of the size: a finer grid is no rounding."""

SAMPLE = 1 << 17
DIFFERENCES = 256
"""Coordinates, and differences between neighbours, among which the step of a grid is looked for."""

PIECE = 1 << 16
"""Coordinates that are looked at in one go."""

DIGITS = 9
"""Single numbers need so many digits to be written and read without loss."""


COARSEST = 1e-5
"""Of a mesh's extent: nobody rounds more coarsely and has a model left, though short numbers may look like it."""

USED = 0.01
"""Of single numbers that were rounded, nearly all use their last bits; of short ones (0.5, 1000) none do."""


def coordinate_precision(points: Floats) -> float:
    """How far coordinates (n, 3) may be off by what they were rounded to, in their own unit; 0 without points."""
    if not len(points):
        return 0.0
    corners = bounding_box(points)
    size = float(np.abs(corners).max())
    # From half the largest number on differences overflow.
    if size == 0.0 or not np.isfinite(2.0 * size):
        return 0.0
    rounded = _rounded(points, corners, size)
    return rounded if rounded <= COARSEST * float((corners[1] - corners[0]).max()) else 2.0**-53 * size


def _rounded(points: Floats, corners: Floats, size: float) -> float:
    """What the digits of the coordinates say, whether it is likely or not."""
    single = 2.0**-24 * size
    if size < 3e38 and _every(lambda some: some.astype(np.float32) == some, points):
        used = sum(int(np.count_nonzero(some.astype(np.float32).view(np.uint32) & 0xF)) for some in _pieces(points))
        return single if used / points.size > USED else 2.0**-53 * size
    step = _step(points, corners, size)
    if step > 0.0:
        return max(0.5 * step, single)
    return single if _every(_short, points) else 2.0**-53 * size


def _short(numbers: Floats) -> npt.NDArray[np.bool_]:
    """Which of the numbers have nine digits at most."""
    present = numbers[numbers != 0.0]
    digits = DIGITS - 1 - np.floor(np.log10(np.abs(present)))
    return _whole(present * 10.0**digits)


def _pieces(points: Floats) -> Iterator[Floats]:
    """All coordinates, so many at a time: what is looked for in them takes copies, and most end it early."""
    flat = points.ravel()
    return (flat[k : k + PIECE] for k in range(0, len(flat), PIECE))


def _every(test: Callable[[Floats], npt.NDArray[np.bool_]], points: Floats) -> bool:
    return all(bool(test(some).all()) for some in _pieces(points))


def _step(points: Floats, corners: Floats, size: float) -> float:
    """The step of the grid on which all coordinates lie, such as 0.001 where there are three decimals; 0 without one.

    Euclid's algorithm on the smallest differences finds it in any unit: a file in inches has its decimals there, and a
    model may have been scaled or moved.
    """
    finest = FINEST_GRID * size
    origin = points[0]
    every = np.arange(0, points.size, max(1, points.size // SAMPLE))
    sampled = points.ravel()[every] - origin[every % 3]
    apart = np.diff(distinct(sampled))
    apart = distinct(apart[apart > finest])[:DIFFERENCES]
    farthest = float(np.maximum(corners[1] - origin, origin - corners[0]).max())
    step = 0.0
    for difference in [*apart.tolist(), farthest]:
        step = _divisor(step, difference, finest)
        if step == 0.0:
            return 0.0
        # The further apart two coordinates are, the more exactly they tell the step.
        step = difference / max(1, round(difference / step))
    rows = (points[k : k + PIECE] - origin for k in range(0, len(points), PIECE))
    return step if all((np.abs(v / step - np.round(v / step)) < 1e-3).all() for v in rows) else 0.0


def _divisor(a: float, b: float, finest: float) -> float:
    """The greatest length of which both are multiples; remainders up to `finest` are none."""
    while b > finest:
        rest = math.fmod(a, b)
        a, b = b, min(rest, b - rest)
    return a


def _whole(numbers: Floats) -> npt.NDArray[np.bool_]:
    """Which are whole numbers, but for the rounding of the multiplication that made them."""
    return np.asarray(np.abs(numbers - np.round(numbers)) <= 1e-15 * np.abs(numbers) + 1e-12)
