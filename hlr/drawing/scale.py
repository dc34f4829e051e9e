"""Scales as drawings state them."""

from __future__ import annotations


def ratio(scale: float) -> str:
    """A scale as a drawing states it: 0.5 is "1:2"."""
    return f"{_plain(scale)}:1" if scale >= 1.0 else f"1:{_plain(1.0 / scale)}"


def _plain(number: float) -> str:
    """Six digits at most, and no exponent."""
    return f"{float(f'{number:.6g}'):.6f}".rstrip("0").rstrip(".")
