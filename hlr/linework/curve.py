"""Curves on paper: what a line's geometry is where it is not straight."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, ceil, cos, floor, hypot, pi, sin, tau

import numpy as np
import numpy.typing as npt

Points = npt.NDArray[np.float64]

WHOLE = 1e-9
"""Of a turn: an arc that lacks no more than this is a full circle or ellipse."""


@dataclass(frozen=True, slots=True)
class Arc:
    """A piece of a circle or an ellipse, or all of it: centre + cos t axes[0] + sin t axes[1].

    centre   (2,) millimetres on paper, y up
    axes     (2, 2) two perpendicular half axes, the longer one first
    angles   (2,) t at the start and at the end, radians; it runs backward where the second is less
    """

    centre: Points
    axes: Points
    angles: Points

    def at(self, t: npt.ArrayLike) -> Points:
        """Points (..., 2) at angles (...)."""
        t = np.asarray(t, np.float64)[..., None]
        return np.asarray(self.centre + np.cos(t) * self.axes[0] + np.sin(t) * self.axes[1])

    @property
    def radii(self) -> tuple[float, float]:
        """Half lengths of the axes."""
        return hypot(*self.axes[0].tolist()), hypot(*self.axes[1].tolist())

    @property
    def whole(self) -> bool:
        """Whether it closes."""
        return bool(abs(self.angles[1] - self.angles[0]) >= (1.0 - WHOLE) * tau)

    def bounds(self) -> Points:
        """(2, 2) lower and upper corner."""
        (cx, cy), (ax, ay), (bx, by) = self.centre.tolist(), *self.axes.tolist()
        low, high = sorted(self.angles.tolist())
        angles = [low, high]
        for k in (atan2(bx, ax), atan2(by, ay)):
            angles += [k + n * pi for n in range(ceil((low - k) / pi), floor((high - k) / pi) + 1)]
        x = [cx + cos(t) * ax + sin(t) * bx for t in angles]
        y = [cy + cos(t) * ay + sin(t) * by for t in angles]
        return np.array([[min(x), min(y)], [max(x), max(y)]])


@dataclass(frozen=True, slots=True)
class Bezier:
    """A chain of Bezier curves: points[degree * i : degree * (i + 1) + 1] are those of piece i.

    degree   2 or 3
    points   (degree * k + 1, 2) millimetres on paper, y up
    """

    degree: int
    points: Points

    def at(self, t: npt.ArrayLike) -> Points:
        """Points (..., 2) at parameters (...) from 0 to the number of pieces."""
        t = np.asarray(t, np.float64)
        count = (len(self.points) - 1) // self.degree
        piece = np.clip(np.floor(t).astype(np.int64), 0, count - 1)
        s = (t - piece)[..., None]
        p = [self.points[self.degree * piece + j] for j in range(self.degree + 1)]
        while len(p) > 1:
            p = [a + (b - a) * s for a, b in zip(p, p[1:], strict=False)]
        return np.asarray(p[0])

    def bounds(self) -> Points:
        """(2, 2) lower and upper corner, exact."""
        degree, ends = self.degree, self.points[:: self.degree]
        d = np.stack([self.points[j + 1 :: degree][: len(ends) - 1] for j in range(degree)])
        d -= np.stack([self.points[j::degree][: len(ends) - 1] for j in range(degree)])
        with np.errstate(all="ignore"):
            if degree == 2:
                roots = (d[0] / (d[0] - d[1]))[None]
            else:
                p, q, r = d[0] - 2.0 * d[1] + d[2], d[1] - d[0], d[0]
                far = -(q + np.copysign(np.sqrt(np.maximum(q * q - p * r, 0.0)), q))
                roots = np.stack([far / p, r / far])
            inside = (roots > 0.0) & (roots < 1.0)
        found = [ends]
        _, piece, _ = np.nonzero(inside)
        if len(piece):
            found.append(self.at(piece + roots[inside]))
        every = np.concatenate(found)
        return np.stack([every.min(axis=0), every.max(axis=0)])


Curve = Arc | Bezier
"""Of a line; None stands for its polyline."""
