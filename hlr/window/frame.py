"""The window on paper: its sides, and the point of the model that belongs to a point on paper."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hlr.drawing.drawing import DrawnView
from hlr.drawing.line import Bounds

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Frame:
    """window: millimetres on paper, in the drawing's coordinates; per_model: millimetres on paper per model unit."""

    window: Bounds
    view: DrawnView
    per_model: float

    @property
    def low(self) -> Floats:
        """(2,) the lower left corner."""
        return np.array(self.window[:2])

    @property
    def high(self) -> Floats:
        """(2,) the upper right corner."""
        return np.array(self.window[2:])

    @property
    def sides(self) -> tuple[tuple[int, float], ...]:
        """(axis, value): left, right, bottom, top."""
        w = self.window
        return (0, w.x0), (0, w.x1), (1, w.y0), (1, w.y1)

    def to_model(self, u: Floats, v: Floats, share: float, off: Floats) -> Floats:
        """The point of the model that is seen at `share` of the way from u to v on paper, and `off` from there.

        u, v (3,) model coordinates; off (2,) millimetres on paper. In perspective the middle on paper is not the middle
        in space: nearer lengths look longer.
        """
        view, along = self.view, share
        if view.eye is not None:
            ahead = [self._ahead(each) for each in (u, v)]
            along = share * ahead[0] / (share * ahead[0] + (1.0 - share) * ahead[1])
        point = u + (v - u) * along
        if off.any():
            per = self.per_model
            if view.distance is not None:
                per *= view.distance / self._ahead(point)
            point = point + (off[0] * np.array(view.right) + off[1] * np.array(view.up)) / per
        return np.asarray(point)

    def _ahead(self, point: Floats) -> float:
        """Distance in front of the eye, along the view, model units."""
        return -float((point - np.array(self.view.eye)) @ np.array(self.view.direction))
