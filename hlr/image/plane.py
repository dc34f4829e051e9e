"""The planes at which an image is cut before a perspective view, and the bodies that one looks into after such a cut.

A body that is cut stays closed for the eye unless a line of sight begins within it. No line of sight crosses a side of
the frame, for these planes hold the eye. All cross the near plane in a small rectangle before the eye: only a body that
fills it, or whose surface runs through it, is looked into.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hlr.common.types import Floats, Ints
from hlr.image.camera import dot
from hlr.request.options import Vector

SLACK = 1e-9
"""Share of a window by which it counts as larger, for rounding."""


@dataclass(frozen=True, slots=True)
class Window:
    """The rectangle of a plane that lines of sight go through.

    centre     its middle
    right, up  unit vectors along its sides
    half       half its width and height
    """

    centre: Vector
    right: Vector
    up: Vector
    half: tuple[float, float]

    def flat(self, points: Floats) -> Floats:
        """(n, 2) coordinates of points (n, 3) of the plane, from the middle of the window."""
        away = points - np.asarray(self.centre)
        return np.stack([dot(away, self.right), dot(away, self.up)], axis=1)


@dataclass(frozen=True, slots=True)
class Plane:
    """A plane that keeps the points p with normal . p >= offset.

    side    it holds the eye, as a side of the frame does: no line of sight crosses it
    window  where lines of sight cross it; None: anywhere
    """

    normal: Vector
    offset: float
    side: bool = False
    window: Window | None = None

    def height(self, points: Floats) -> Floats:
        """(n,) signed distance times |normal|."""
        return np.asarray(dot(points, self.normal) - self.offset)

    def looked_into(self, starts: Floats, ends: Floats, group: Ints, count: int) -> npt.NDArray[np.bool_]:
        """(count,) the groups that lines of sight enter through the cut.

        starts, ends (k, 3): the borders of the cut, a piece of each triangle, which all run the same way around their
        bodies; group (k,): that of each
        """
        found = np.zeros(count, bool)
        if self.side:
            return found
        if self.window is None:
            found[group] = True
            return found
        a, b, half = self.window.flat(starts), self.window.flat(ends), np.asarray(self.window.half) * (1.0 + SLACK)
        touches = ((np.minimum(a, b) <= half) & (np.maximum(a, b) >= -half)).all(axis=1)
        found[group[touches]] = True
        # How often the borders run around the middle: at each crossing of the half axis to the right once more or less.
        turn = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
        rises, falls = (a[:, 1] <= 0.0) & (b[:, 1] > 0.0), (a[:, 1] > 0.0) & (b[:, 1] <= 0.0)
        around = (rises & (turn > 0.0)).astype(float) - (falls & (turn < 0.0))
        return np.asarray(found | (np.bincount(group, around, count) != 0.0))
