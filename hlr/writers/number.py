"""Numbers in SVG and PDF: fixed decimals that follow from the drawing's accuracy.

Both round to a decimal grid first and then print integers of that grid (points: the kernel's `linework::curves`). So
a point has the same digits in both, and sums of relative coordinates are exact.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from hlr.errors import WriteError
from hlr.request.accuracy import DIGITS

Ints = npt.NDArray[np.int64]

MAX_DECIMALS = 12
# Beyond 2**53 a double has no unit digit any more: further decimals would mean nothing.
_MAX_GRID = float(2**53)
NOT_FINITE = "the drawing has a point that is not finite; it cannot be written"


def decimals(accuracy: float, extent: float = 0.0) -> int:
    """Fewest decimals whose rounding moves a plane point by less than the share DIGITS of `accuracy`.

    accuracy and extent (largest absolute coordinate) are in the unit of the numbers; at least 0, and never so many
    that `extent` would lose its last digit.
    """
    if not (math.isfinite(accuracy) and accuracy > 0.0):
        raise WriteError(f"the drawing states no usable accuracy ({accuracy!r}); it must be a positive length in mm")
    if not math.isfinite(extent):
        raise WriteError(NOT_FINITE)
    # Half a grid step in x and in y: the point moves by at most step / sqrt(2).
    step = accuracy * DIGITS * math.sqrt(2.0)
    wanted = math.ceil(-math.log10(step) + 1e-12)
    room = math.floor(math.log10(_MAX_GRID / max(extent, 1.0)))
    return max(0, min(wanted, room, MAX_DECIMALS))


def grid(values: npt.NDArray[np.float64], places: int) -> Ints:
    """Round to whole grid steps of 10**-places (same shape, int64). Raises WriteError for NaN or infinity."""
    if not np.isfinite(values).all():
        raise WriteError(NOT_FINITE)
    return np.rint(values * 10.0**places).astype(np.int64)


@lru_cache(maxsize=256)
def number(value: float, places: int = 6) -> str:
    """One number, compact: ".5", "-12.25", "0"."""
    steps = round(value * 10**places)
    digits = f"{abs(steps):0{places + 1}d}"
    whole, fraction = digits[: len(digits) - places].lstrip("0"), digits[len(digits) - places :].rstrip("0")
    return f"{'-' if steps < 0 else ''}{whole}{'.' if fraction else ''}{fraction}" if whole or fraction else "0"
