"""Dark places of a shaded picture, where black lines would not be seen."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from hlr.shading.picture import Pixels

DARK = 32
"""A pixel is dark whose channels are all below this: black differs from it by a contrast of 1.3 at most (WCAG 2)."""

LIGHT = (150, 150, 150)
"""Ink of lines in dark places. Its contrast to them is 5.5 at least."""

REACH = 3
"""Pixels to all sides that must be dark as well: half the widest line, and what antialiasing mixes."""


def dark_places(pixels: Pixels) -> npt.NDArray[np.bool_] | None:
    """(h, w) bool: pixels that are dark, with all pixels around them; None where there are none.

    An edge between a dark face and a bright one, or a bright background, is not in a dark place. What is transparent
    counts as bright.
    """
    bright = pixels[:, :, :3].max(axis=2)
    np.maximum(bright, np.uint8(255) - pixels[:, :, 3], out=bright)
    if int(bright.min()) >= DARK:
        return None
    found = bright < DARK
    for axis in (0, 1):
        found = _shrunk(found, axis)
    return found if found.any() else None


def _shrunk(found: npt.NDArray[np.bool_], axis: int) -> npt.NDArray[np.bool_]:
    """What is left where all places within REACH along an axis are to be found, too. Nothing lies beyond the border."""
    out = found.copy()
    for step in range(1, min(REACH, found.shape[axis] - 1) + 1):
        ahead = [slice(None), slice(None)]
        behind = [slice(None), slice(None)]
        ahead[axis], behind[axis] = slice(step, None), slice(None, -step)
        out[tuple(behind)] &= found[tuple(ahead)]
        out[tuple(ahead)] &= found[tuple(behind)]
    return out
