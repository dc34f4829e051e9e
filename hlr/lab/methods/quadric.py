"""Depth of curved patches by forward differences (see the kernel's `methods/src/quadric.rs`)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.errors import OptionError

MISSED = np.iinfo(np.int64).min
"""Depth where a row misses the quadric."""


def quadric_depths(
    coefficients: Sequence[int], columns: tuple[int, int], row: int
) -> tuple[npt.NDArray[np.int64], int]:
    """Depth of a quadric's nearer side at the pixels of a row, rounded down; and the number of corrections needed.

    No square root is taken. coefficients: integers a .. j of
    a x^2 + b y^2 + c z^2 + d xy + e xz + f yz + g x + h y + i z + j = 0, c > 0; columns [from, to).
    A pixel beside the quadric is MISSED. Raises OptionError where 128 bits do not hold the numbers.
    """
    if len(coefficients) != 10:
        raise OptionError(f"a quadric has ten coefficients, not {len(coefficients)}")
    first, last = columns
    try:
        return _kernel.quadric_row([int(c) for c in coefficients], int(first), int(row), max(0, int(last) - int(first)))
    except (ValueError, OverflowError) as error:
        raise OptionError(f"{error}") from None
