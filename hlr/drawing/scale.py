"""Scales as drawings state them."""

from __future__ import annotations

from functools import lru_cache

from hlr.common.numbers import typed


@lru_cache(maxsize=64)
def ratio(scale: float) -> str:
    """A scale as a drawing states it: 0.5 is "1:2"."""
    return f"{typed(scale, places=6)}:1" if scale >= 1.0 else f"1:{typed(1.0 / scale, places=6)}"
