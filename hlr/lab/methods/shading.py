"""Interpolation along a span: the textbook's linear one, and the one that is right in perspective.

The kernel's `methods/src/shading.rs`.
"""

from __future__ import annotations

from hlr.common.types import Floats


def along(values: Floats, other: Floats, share: Floats, w: tuple[float, float] | None = None) -> Floats:
    """Between two values on the screen; or, with the distances w of both from the eye, on the surface.

    values, other (k,); share (n,) of the way on the screen. Returns (n, k).
    """
    if w is not None:
        share = share / w[1] / ((1.0 - share) / w[0] + share / w[1])
    return values + (other - values) * share[:, None]
