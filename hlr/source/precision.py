"""Precision of a mesh's coordinates, estimated from their digits: files keep seven digits, or some decimals."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np
import numpy.typing as npt

from hlr.common.distinct import distinct
from hlr.common.types import Floats
from hlr.source.bounds import bounding_box

FINEST_GRID = 2.0**-31
"""Share of the largest coordinate: a finer grid is not taken for rounding."""

MAX_SAMPLES = 1 << 17
MAX_DIFFERENCES = 256
"""Coordinates, and differences between neighbouring ones, in which the step of a grid is searched."""

BLOCK = 1 << 16
"""Coordinates per block."""

SINGLE_DIGITS = 9
"""Digits that a single-precision number needs to be written and read without loss."""


COARSEST_GRID = 1e-5
"""Share of a mesh's extent: a coarser grid is chance (short numbers), not rounding."""

LOW_BITS_SHARE = 0.01
"""Share of single-precision numbers with their last bits in use, above which they count as rounded.

Of rounded numbers nearly all use the last bits; of short ones (0.5, 1000) none do.
"""


def coordinate_precision(points: Floats) -> float:
    """Largest rounding error of coordinates (n, 3), in their own unit; 0 without points."""
    if not len(points):
        return 0.0
    corners = bounding_box(points)
    size = float(np.abs(corners).max())
    # From half the largest number on differences overflow.
    if size == 0.0 or not np.isfinite(2.0 * size):
        return 0.0
    rounded = _suggested_error(points, corners, size)
    return rounded if rounded <= COARSEST_GRID * float((corners[1] - corners[0]).max()) else 2.0**-53 * size


def _suggested_error(points: Floats, corners: Floats, size: float) -> float:
    """The rounding error that the digits suggest, before it is checked against the mesh's extent."""
    single = 2.0**-24 * size
    if size < 3e38 and _all(lambda block: block.astype(np.float32) == block, points):
        used = sum(int(np.count_nonzero(block.astype(np.float32).view(np.uint32) & 0xF)) for block in _blocks(points))
        return single if used / points.size > LOW_BITS_SHARE else 2.0**-53 * size
    step = _grid_step(points, corners, size)
    if step > 0.0:
        return max(0.5 * step, single)
    return single if _all(_is_short, points) else 2.0**-53 * size


def _is_short(numbers: Floats) -> npt.NDArray[np.bool_]:
    """(k,) bool: the number has nine digits at most. Zeros are left out."""
    present = numbers[numbers != 0.0]
    digits = SINGLE_DIGITS - 1 - np.floor(np.log10(np.abs(present)))
    return _is_whole(present * 10.0**digits)


def _blocks(points: Floats) -> Iterator[Floats]:
    """All coordinates in blocks: a test copies what it looks at, and mostly ends early."""
    flat = points.ravel()
    return (flat[k : k + BLOCK] for k in range(0, len(flat), BLOCK))


def _all(test: Callable[[Floats], npt.NDArray[np.bool_]], points: Floats) -> bool:
    return all(bool(test(block).all()) for block in _blocks(points))


def _grid_step(points: Floats, corners: Floats, size: float) -> float:
    """The step of the grid on which all coordinates lie, such as 0.001 where there are three decimals; 0 without one.

    Euclid's algorithm on the smallest differences finds it in any unit: a file in inches has its decimals there, and a
    model may have been scaled or moved.
    """
    finest = FINEST_GRID * size
    origin = points[0]
    every = np.arange(0, points.size, max(1, points.size // MAX_SAMPLES))
    sampled = points.ravel()[every] - origin[every % 3]
    differences = np.diff(distinct(sampled))
    differences = distinct(differences[differences > finest])[:MAX_DIFFERENCES]
    farthest = float(np.maximum(corners[1] - origin, origin - corners[0]).max())
    step = 0.0
    for difference in [*differences.tolist(), farthest]:
        step = _common_divisor(step, difference, finest)
        if step == 0.0:
            return 0.0
        # The further apart two coordinates are, the more exact the step.
        step = difference / max(1, round(difference / step))
    rows = (points[k : k + BLOCK] - origin for k in range(0, len(points), BLOCK))
    return step if all((np.abs(v / step - np.round(v / step)) < 1e-3).all() for v in rows) else 0.0


def _common_divisor(a: float, b: float, finest: float) -> float:
    """Greatest common divisor of two lengths; remainders up to `finest` count as zero."""
    while b > finest:
        rest = math.fmod(a, b)
        a, b = b, min(rest, b - rest)
    return a


def _is_whole(numbers: Floats) -> npt.NDArray[np.bool_]:
    """(k,) bool: a whole number, but for the rounding of the multiplication that made it."""
    return np.asarray(np.abs(numbers - np.round(numbers)) <= 1e-15 * np.abs(numbers) + 1e-12)
