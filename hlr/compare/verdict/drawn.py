"""What a drawing itself has at points of a comparison, whatever is true there."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hlr import _kernel
from hlr.common.types import Floats
from hlr.compare.lines.pieces import Pieces
from hlr.compare.verdict.true_lines import Bools


@dataclass(frozen=True, slots=True, eq=False)
class Shown:
    """What a drawing shows at n points.

    hides   whether it has hidden lines at all
    inked   (n,) whether it has a visible line within the tolerance, under whose ink a hidden one may lie
    hidden  (n,) whether it has a hidden line there
    """

    hides: bool
    inked: Bools
    hidden: Bools

    @staticmethod
    def of(pieces: Pieces, points: Floats, tolerance_mm: float) -> Shown:
        """Look at all lines of a drawing."""
        inked, hidden = (
            np.isfinite(nearest(pieces.take(pieces.visible == seen), points, tolerance_mm)[0]) for seen in (1, 0)
        )
        return Shown(bool((pieces.visible < 1).any()), inked, hidden)


def nearest(pieces: Pieces, points: Floats, most_mm: float) -> tuple[Floats, Floats]:
    """For each of n points the distance (n,) to the nearest line, infinite beyond `most_mm`, and the place there."""
    if not len(pieces) or not len(points):
        return np.full(len(points), np.inf), points.copy()
    segments = np.ascontiguousarray(np.concatenate([pieces.start, pieces.end], axis=1))
    none, zero = np.zeros(len(points), np.int32), np.zeros(len(segments), np.int32)
    far, which = _kernel.nearest(np.ascontiguousarray(points), none, segments, zero, most_mm)
    start, way = pieces.start[which], pieces.end[which] - pieces.start[which]
    share = ((points - start) * way).sum(axis=1) / np.maximum((way * way).sum(axis=1), 1e-300)
    return far, start + np.clip(share, 0.0, 1.0)[:, None] * way
