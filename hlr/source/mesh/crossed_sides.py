"""Where straight lines in a plane pass through one another."""

from __future__ import annotations

import numpy as np

from hlr.common.types import Floats, Ints

AT_ONCE = 256
"""Lines that are compared with all others at a time."""


def crossings(lines: Floats) -> tuple[Ints, Floats]:
    """Numbers (k, 2) of lines (n, 2, 2) that pass through one another, each between its ends; and where (k, 2)."""
    pairs = []
    low, high = lines.min(axis=1), lines.max(axis=1)
    for first in range(0, len(lines), AT_ONCE):
        some = slice(first, first + AT_ONCE)
        near = ((low[some, None] < high) & (low < high[some, None])).all(axis=2)
        one, other = np.nonzero(near)
        one += first
        pairs.append(np.stack([one, other], axis=1)[one < other])
    found = np.concatenate([np.zeros((0, 2), np.int64), *pairs])
    one, other = lines[found[:, 0]], lines[found[:, 1]]
    from_one, from_other = _sides(one, other), _sides(other, one)
    through = (from_one.prod(axis=1) < 0.0) & (from_other.prod(axis=1) < 0.0)
    share = from_other[through, 0] / (from_other[through, 0] - from_other[through, 1])
    way = one[through, 1] - one[through, 0]
    return found[through].astype(np.int32), one[through, 0] + share[:, None] * way


def _sides(lines: Floats, others: Floats) -> Floats:
    """(n, 2) on which side of each line the ends of the other lie; 0 where that is rounding."""
    way, off = lines[:, 1] - lines[:, 0], others - lines[:, :1]
    area = way[:, None, 0] * off[..., 1] - way[:, None, 1] * off[..., 0]
    size = np.abs(lines).max(axis=(1, 2)) + np.abs(others).max(axis=(1, 2))
    return np.where(np.abs(area) <= 1e-12 * (size * size)[:, None], 0.0, area)
