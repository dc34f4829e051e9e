"""Planes of one direction that lie side by side, each as far as the next step: what a section is cut by.

A plane that does not step is one of them without an end.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hlr.common.types import Floats


@dataclass(frozen=True, slots=True, eq=False)
class Stepped:
    """Planes that step along a direction.

    normal, along  (3,) of length 1, at right angles: toward what is taken away, and that of the steps
    levels         (n,) how far the planes lie along the normal, in the order of the steps
    steps          (n - 1,) how far along the steps lie, ascending
    """

    normal: Floats
    along: Floats
    levels: Floats
    steps: Floats

    def heights(self, points: Floats, near: float = 0.0) -> Floats:
        """(n,) how far points (n, 3) lie before the planes. Beside a step, as near as that, the higher plane counts."""
        at = points @ self.along
        sides = [self.levels[np.searchsorted(self.steps, at + sense * near)] for sense in (-1.0, 1.0)]
        return np.asarray(points @ self.normal - np.maximum(*sides))

    def contain(self, points: Floats, near: float) -> npt.NDArray[np.bool_]:
        """(n,) which of points (n, 3) lie on the planes, no farther than `near`; at a step, on either of the two."""
        at, heights = points @ self.along, points @ self.normal
        beside = (self.levels[np.searchsorted(self.steps, at + sense * near)] for sense in (-1.0, 1.0))
        before, behind = (np.abs(heights - level) <= near for level in beside)
        return np.asarray(before | behind)

    def reach(self, points: Floats) -> tuple[float, float]:
        """From where to where what has these corners (n, 3) may lie before the planes."""
        at, heights = points @ self.along, points @ self.normal
        first, last = np.searchsorted(self.steps, [at.min(), at.max()])
        beside = self.levels[first : last + 1]
        return float(heights.min() - beside.max()), float(heights.max() - beside.min())

    def blocks(self) -> Iterator[tuple[float, float, float]]:
        """What lies behind the planes, as blocks that overlap: from where to where along, and up to which level."""
        ends = np.concatenate([[-np.inf], self.steps, [np.inf]])
        for level in np.unique(self.levels).tolist():
            behind = np.concatenate([[0], self.levels >= level, [0]]).astype(int)
            starts, stops = (np.flatnonzero(np.diff(behind) == sense) for sense in (1, -1))
            yield from ((float(ends[a]), float(ends[b]), level) for a, b in zip(starts, stops, strict=True))

    def before(self, transform: Floats) -> Stepped:
        """The same planes before a placement (4, 4), which may scale."""
        turned = transform[:3, :3].T @ self.normal
        scale, move = float(np.linalg.norm(turned)), transform[:3, 3]
        along = transform[:3, :3].T @ self.along / scale
        levels, steps = self.levels - move @ self.normal, self.steps - move @ self.along
        return Stepped(turned / scale, along, levels / scale, steps / scale)
