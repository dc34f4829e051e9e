"""Scales as people write them: 1:50, 2:1, 0.5."""

from __future__ import annotations

import math


def scale_of(value: float | str) -> float | None:
    """Paper to model as a number: 1:2 is 0.5. None where a text is no scale, or one that is not positive."""
    if not isinstance(value, str):
        return float(value)
    paper, colon, model = value.partition(":")
    try:
        above, below = float(paper), float(model) if colon else 1.0
    except ValueError:
        return None
    sound = all(math.isfinite(number) and number > 0.0 for number in (above, below))
    return above / below if sound else None


__all__ = ["scale_of"]
