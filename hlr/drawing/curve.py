"""Curves on paper: the geometry of lines that are not straight."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import hypot, tau

import numpy as np
import numpy.typing as npt

from hlr.common.values import ByValue

Points = npt.NDArray[np.float64]

WHOLE = 1e-9
"""Share of a turn: an arc that lacks no more than this is a full circle or ellipse."""

CHORDS = 512
"""Points by which the length of an arc, or of a piece of a chain, is measured."""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Arc(ByValue):
    """An arc of a circle or an ellipse, or a whole one: centre + cos t axes[0] + sin t axes[1].

    centre   (2,) millimetres on paper, y up
    axes     (2, 2) two perpendicular half axes, the longer one first, millimetres
    angles   (2,) t at the start and at the end, radians; the arc runs backward where the second is less

    >>> import hlr
    >>> (hole,) = [line.curve for line in hlr.draw("part.step", view="top", scale=1).visible if line.curve]
    >>> hole, hole.whole
    (<Arc about (15, 10), radius 4, 360 degrees>, True)
    """

    centre: Points
    axes: Points
    angles: Points

    def __repr__(self) -> str:
        long, short = self.radii
        radii = f"{long:.6g}" if abs(long - short) <= WHOLE * long else f"{long:.6g} and {short:.6g}"
        x, y = self.centre.tolist()
        turn = np.degrees(self.angles[1] - self.angles[0])
        return f"<Arc about ({x:.6g}, {y:.6g}), radius {radii}, {turn:.6g} degrees>"

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
        """Whether it is a full circle or ellipse."""
        return bool(abs(self.angles[1] - self.angles[0]) >= (1.0 - WHOLE) * tau)

    @property
    def length_mm(self) -> float:
        """Millimetres on paper, to five digits at least."""
        return _along(self.at(np.linspace(self.angles[0], self.angles[1], CHORDS)))

    @property
    def bounds(self) -> Points:
        """(2, 2) lower and upper corner."""
        return arc_bounds([self])


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Bezier(ByValue):
    """A chain of Bezier curves: points[degree * i : degree * (i + 1) + 1] are those of piece i.

    degree   2 or 3
    points   (degree * k + 1, 2) millimetres on paper, y up

    >>> import hlr, numpy
    >>> curve = hlr.Bezier(2, numpy.array([(0.0, 0.0), (1.0, 2.0), (2.0, 0.0)]))
    >>> curve, curve.at(0.5).tolist()
    (<Bezier of degree 2, 1 pieces>, [1.0, 1.0])
    """

    degree: int
    points: Points

    def __repr__(self) -> str:
        return f"<Bezier of degree {self.degree}, {(len(self.points) - 1) // self.degree} pieces>"

    def at(self, t: npt.ArrayLike) -> Points:
        """Points (..., 2) at parameters (...) from 0 to the number of pieces."""
        t = np.asarray(t, np.float64)
        count = (len(self.points) - 1) // self.degree
        piece = np.clip(np.floor(t).astype(np.int64), 0, count - 1)
        s = (t - piece)[..., None]
        p = [self.points[self.degree * piece + j] for j in range(self.degree + 1)]
        while len(p) > 1:
            p = [a + (b - a) * s for a, b in pairwise(p)]
        return np.asarray(p[0])

    @property
    def length_mm(self) -> float:
        """Millimetres on paper, to five digits at least where no piece has a cusp."""
        pieces = (len(self.points) - 1) // self.degree
        return _along(self.at(np.linspace(0.0, pieces, CHORDS * pieces)))

    @property
    def bounds(self) -> Points:
        """(2, 2) lower and upper corner, exact."""
        return bezier_bounds([self])


def _along(points: Points) -> float:
    """Millimetres along points (n, 2)."""
    steps = np.diff(points, axis=0)
    return float(np.hypot(steps[:, 0], steps[:, 1]).sum())


def arc_bounds(arcs: Sequence[Arc]) -> Points:
    """(2, 2) lower and upper corner of all arcs, exact."""
    centre, axes, angles = (np.array([getattr(arc, name) for arc in arcs]) for name in ("centre", "axes", "angles"))
    low, high = angles.min(axis=1), angles.max(axis=1)
    # In x and in y alike there are extremes half a turn apart, those of a full turn at most three inside it.
    first = np.arctan2(axes[:, 1], axes[:, 0])
    turn = np.ceil((low[:, None] - first) / np.pi)[:, :, None] + np.arange(3)
    extremes = (first[:, :, None] + turn * np.pi).reshape(len(arcs), -1)
    t = np.concatenate([angles, np.where(extremes <= high[:, None], extremes, low[:, None])], axis=1)[..., None]
    points = centre[:, None] + np.cos(t) * axes[:, None, 0] + np.sin(t) * axes[:, None, 1]
    return np.stack([points.min(axis=(0, 1)), points.max(axis=(0, 1))])


def bezier_bounds(chains: Sequence[Bezier]) -> Points:
    """(2, 2) lower and upper corner of all chains, exact."""
    cubic = np.concatenate([(chain if chain.degree == 3 else raised(chain)).points[:-1] for chain in chains])
    last = np.concatenate([chain.points[-1:] for chain in chains])
    pieces = cubic.reshape(-1, 3, 2)
    count = np.array([(len(chain.points) - 1) // chain.degree for chain in chains])
    # A piece ends where the next one begins, or where its chain does.
    ends = np.concatenate([pieces[1:, 0], last[-1:]])
    ends[np.cumsum(count) - 1] = last
    a, b, c, d = pieces[:, 0], pieces[:, 1], pieces[:, 2], ends
    e0, e1, e2 = b - a, c - b, d - c
    found = [a, last]
    with np.errstate(all="ignore"):
        p, q = e0 - 2.0 * e1 + e2, e1 - e0
        far = -(q + np.copysign(np.sqrt(np.maximum(q * q - p * e0, 0.0)), q))
        for t in (far / p, e0 / far):
            s = 1.0 - t
            at = s * s * s * a + 3.0 * s * t * (s * b + t * c) + t * t * t * d
            found.append(np.where((t > 0.0) & (t < 1.0), at, a))
    every = np.concatenate(found)
    return np.stack([every.min(axis=0), every.max(axis=0)])


def raised(chain: Bezier) -> Bezier:
    """A quadratic chain as a cubic one, the same curve."""
    ends, middle = chain.points[::2], chain.points[1::2]
    points = np.empty((3 * len(middle) + 1, 2))
    points[::3] = ends
    points[1::3] = ends[:-1] + (middle - ends[:-1]) * (2.0 / 3.0)
    points[2::3] = ends[1:] + (middle - ends[1:]) * (2.0 / 3.0)
    return Bezier(3, points)


Curve = Arc | Bezier
"""The curve of a line; None where the line is its polyline."""
