"""What counts as a number in options, manifests and styles."""

from __future__ import annotations

import math
from numbers import Real
from typing import Any


def is_real(value: Any) -> bool:
    """Whether it is a number that a float can hold; NaN and infinities are. True and False are no numbers."""
    if not isinstance(value, Real) or isinstance(value, bool):
        return False
    try:
        float(value)
    except (OverflowError, ValueError):
        return False
    return True


def is_finite(value: Any) -> bool:
    """Whether it is a number that a float can hold, neither NaN nor infinite."""
    return is_real(value) and math.isfinite(value)
