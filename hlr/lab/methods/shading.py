"""Interpolation along a span: linear on the screen, as in the textbook, or correct in perspective.

The code is the kernel's `methods/src/shading.rs`.
"""

from __future__ import annotations

from hlr.common.types import Floats


def along(values: Floats, other: Floats, share: Floats, w: tuple[float, float] | None = None) -> Floats:
    """Interpolate linearly on the screen; or, given the distances w of both ends from the eye, linearly on the surface.

    values, other: (k,) at the two ends; share: (n,) of the way on the screen, 0 to 1. Returns (n, k).
    """
    if w is not None:
        share = share / w[1] / ((1.0 - share) / w[0] + share / w[1])
    return values + (other - values) * share[:, None]
