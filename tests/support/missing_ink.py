"""Visible lines of one drawing that another one of the same model lacks."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.drawing.drawing import Drawing

Floats = npt.NDArray[np.float64]

PLACES = 8
"""Places along each segment that are looked at."""
FAR = 100.0
"""Millimetres: what is farther away is not looked for."""


def visible_segments(drawing: Drawing, kinds: Collection[str] | None = None) -> Floats:
    """(n, 4) the visible lines, of these kinds alone where they are given, from the origin of the model."""
    chosen = [line.points for line in drawing.visible if kinds is None or line.kind in kinds]
    if not chosen:
        return np.zeros((0, 4))
    return np.concatenate([np.concatenate([p[:-1], p[1:]], axis=1) for p in chosen]) + np.tile(drawing.origin, 2)


def missing(wanted: Floats, segments: Floats, apart: float) -> float:
    """Millimetres of wanted segments (n, 4) that are farther from all others (m, 4) than `apart`, millimetres."""
    share = (np.arange(PLACES)[None, :, None] + 0.5) / PLACES
    points = (wanted[:, None, :2] * (1.0 - share) + wanted[:, None, 2:] * share).reshape(-1, 2)
    lengths = np.repeat(np.hypot(*(wanted[:, 2:] - wanted[:, :2]).T) / PLACES, PLACES)
    none, zero = np.zeros(len(points), np.int32), np.zeros(len(segments), np.int32)
    away = _kernel.nearest(np.ascontiguousarray(points), none, np.ascontiguousarray(segments), zero, FAR)[0]
    return float(lengths[away > apart].sum())
