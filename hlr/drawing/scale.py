"""Scales as drawings state them."""

from __future__ import annotations


def ratio(scale: float) -> str:
    """A scale as a drawing states it: 0.5 is "1:2"."""
    if scale >= 1.0:
        return f"{scale:.6g}:1"
    return f"1:{1.0 / scale:.6g}"
