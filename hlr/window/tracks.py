"""Lines as parametric curves: where they cross the sides of a window, and the piece between two parameters.

A track has a parameter that rises from `params[0]` to `params[-1]`, one for each point of its line.
"""

from __future__ import annotations

from math import atan2, hypot, tau
from typing import Protocol

import numpy as np
import numpy.typing as npt

from hlr.drawing.curve import Arc, Bezier, Curve
from hlr.drawing.line import Line

Floats = npt.NDArray[np.float64]

SAMPLES = 16
"""Samples of each Bezier curve: the one nearest to a point starts the search for its parameter."""

ROWS = 256
"""Points that are located at once: bounds the memory."""

ON_CIRCLE = 1e-6
"""How far a root may be from the unit circle, or from the real numbers, by rounding: two that nearly coincide are."""

_POWERS = {
    2: np.array([[1.0, 0.0, 0.0], [-2.0, 2.0, 0.0], [1.0, -2.0, 1.0]]),
    3: np.array([[1.0, 0.0, 0.0, 0.0], [-3.0, 3.0, 0.0, 0.0], [3.0, -6.0, 3.0, 0.0], [-1.0, 3.0, -3.0, 1.0]]),
}
"""From control points to the coefficients of 1, t, t^2, t^3, by degree."""


class Track(Protocol):
    """What polylines, arcs and Bezier chains have in common."""

    @property
    def params(self) -> Floats:
        """(n,) of the line's points, never falling."""

    @property
    def breaks(self) -> Floats:
        """Parameters of corners, where the direction may jump; first and last are the ends."""

    def at(self, t: Floats) -> Floats:
        """(..., 2) places on paper, millimetres."""

    def crossings(self, axis: int, value: float) -> Floats:
        """Parameters where the coordinate crosses a value; those where it only touches may be among them."""

    def round_crossings(self, middle: Floats, radius: float) -> Floats:
        """Parameters where the line crosses a circle; those where it only touches may be among them."""

    def between(self, a: float, b: float) -> Curve | None:
        """The part of the curve; None of a polyline."""


def track_of(line: Line) -> Track:
    """The line as a track."""
    if line.curve is None:
        return Polyline(line.points)
    return ArcTrack(line.curve, line.points) if isinstance(line.curve, Arc) else BezierTrack(line.curve, line.points)


class Polyline:
    """A polyline; its parameter is the number of the point."""

    def __init__(self, points: Floats) -> None:
        self.points = points
        self.params = self.breaks = np.arange(len(points), dtype=np.float64)

    def at(self, t: Floats) -> Floats:
        """See Track."""
        i = np.clip(np.floor(t).astype(np.int64), 0, len(self.points) - 2)
        s = (t - i)[..., None]
        return np.asarray(self.points[i] + (self.points[i + 1] - self.points[i]) * s)

    def crossings(self, axis: int, value: float) -> Floats:
        """See Track."""
        height = self.points[:, axis] - value
        i = np.flatnonzero(height[:-1] * height[1:] < 0.0)
        return np.asarray(i + height[i] / (height[i] - height[i + 1]))

    def round_crossings(self, middle: Floats, radius: float) -> Floats:
        """See Track. |p + s d| = radius is a quadratic equation in s."""
        p, d = self.points[:-1] - middle, np.diff(self.points, axis=0)
        a, b, c = (d * d).sum(axis=1), (p * d).sum(axis=1), (p * p).sum(axis=1) - radius * radius
        root = b * b - a * c
        i = np.flatnonzero((root > 0.0) & (a > 0.0))
        s = (-b[i] + np.array([[-1.0], [1.0]]) * np.sqrt(root[i])) / a[i]
        return np.asarray((i + s)[(s >= 0.0) & (s < 1.0)])

    def between(self, a: float, b: float) -> Curve | None:
        """See Track."""
        return None


class ArcTrack:
    """An arc; its parameter is the angle from its start, in radians."""

    def __init__(self, arc: Arc, points: Floats) -> None:
        self.arc = arc
        self.start, end = arc.angles.tolist()
        self.sign = 1.0 if end >= self.start else -1.0
        turn = abs(end - self.start)
        rest = points - arc.centre
        across = np.stack([rest @ axis / max(float(axis @ axis), 1e-300) for axis in arc.axes])
        along = np.unwrap(np.arctan2(across[1], across[0])) * self.sign
        # The first point is the start, whatever turn its angle was found in.
        self.params = np.maximum.accumulate(np.clip(along - along[0], 0.0, turn))
        self.params[-1] = turn
        self.breaks = np.array([0.0, turn])

    def at(self, t: Floats) -> Floats:
        """See Track."""
        return self.arc.at(self.start + self.sign * t)

    def crossings(self, axis: int, value: float) -> Floats:
        """See Track. c + a cos t + b sin t = c + r cos(t - phi), r the root of a^2 + b^2."""
        a, b = self.arc.axes[:, axis].tolist()
        reach, height = hypot(a, b), value - float(self.arc.centre[axis])
        if reach <= abs(height):
            return np.zeros(0)
        phi, half = atan2(b, a), float(np.arccos(height / reach))
        first = (self.sign * (np.array([phi - half, phi + half]) - self.start)) % tau
        turns = np.arange(int(self.breaks[1] / tau) + 1) * tau
        found = (first[:, None] + turns).ravel()
        return np.asarray(found[found < self.breaks[1]])

    def round_crossings(self, middle: Floats, radius: float) -> Floats:
        """See Track. With z = cos t + i sin t the equation |p + a cos t + b sin t| = radius is one of degree 4 in z."""
        p, (a, b) = self.arc.centre - middle, self.arc.axes
        # The square of the distance is even + Re(once z) + Re(twice z^2).
        even = float(p @ p + 0.5 * (a @ a + b @ b)) - radius * radius
        once, twice = complex(2.0 * p @ a, -2.0 * p @ b), complex(0.5 * (a @ a - b @ b), -(a @ b))
        z = np.roots([twice, once, 2.0 * even, once.conjugate(), twice.conjugate()])
        angles = np.angle(z[np.abs(np.abs(z) - 1.0) < ON_CIRCLE])
        first = (self.sign * (angles - self.start)) % tau
        found = (first[:, None] + np.arange(int(self.breaks[1] / tau) + 1) * tau).ravel()
        return np.asarray(found[found < self.breaks[1]])

    def between(self, a: float, b: float) -> Curve | None:
        """See Track."""
        return Arc(self.arc.centre, self.arc.axes, self.start + self.sign * np.array([a, b]))


class BezierTrack:
    """A chain of Bezier curves; its parameter runs from i to i + 1 on curve i."""

    def __init__(self, chain: Bezier, points: Floats) -> None:
        self.chain = chain
        self.count = (len(chain.points) - 1) // chain.degree
        self.breaks = np.arange(self.count + 1, dtype=np.float64)
        self.params = self._nearest(points)

    def at(self, t: Floats) -> Floats:
        """See Track."""
        return self.chain.at(t)

    def crossings(self, axis: int, value: float) -> Floats:
        """See Track. Between its extremes a coordinate rises or falls: it passes a value once, found by bisection."""
        degree = self.chain.degree
        found: list[float] = []
        for i in range(self.count):
            own = [v - value for v in self.chain.points[degree * i : degree * i + degree + 1, axis].tolist()]
            if min(own) > 0.0 or max(own) < 0.0:
                continue
            stops = [0.0, *_extremes(own), 1.0]
            heights = [_value(own, s) for s in stops]
            found += [i + s for s, h in zip(stops, heights, strict=True) if h == 0.0]
            for k in range(len(stops) - 1):
                if heights[k] * heights[k + 1] < 0.0:
                    found.append(i + _root(own, stops[k], stops[k + 1]))
        return np.array(found)

    def round_crossings(self, middle: Floats, radius: float) -> Floats:
        """See Track. The square of the distance is a polynomial of twice the degree."""
        degree, found = self.chain.degree, [np.zeros(0)]
        for i in range(self.count):
            own = self.chain.points[degree * i : degree * i + degree + 1] - middle
            powers = _POWERS[degree] @ own
            square = sum(np.polymul(powers[::-1, axis], powers[::-1, axis]) for axis in (0, 1))
            roots = np.roots(np.polysub(square, [radius * radius]))
            real = roots.real[np.abs(roots.imag) < ON_CIRCLE]
            found.append(i + real[(real >= 0.0) & (real <= 1.0)])
        return np.concatenate(found)

    def between(self, a: float, b: float) -> Curve | None:
        """See Track."""
        degree, pieces = self.chain.degree, []
        for i in range(int(a), min(int(np.ceil(b)), self.count)):
            low, high = max(a - i, 0.0), min(b - i, 1.0)
            if high > low:
                pieces.append(_cut(self.chain.points[degree * i : degree * i + degree + 1], low, high))
        return Bezier(degree, np.concatenate([pieces[0][:1], *(piece[1:] for piece in pieces)]))

    def _nearest(self, points: Floats) -> Floats:
        """The parameters of points that lie along the chain, in its order."""
        t = np.linspace(0.0, self.count, SAMPLES * self.count + 1)
        places = self.chain.at(t)
        way, of_points = _lengths(places), _lengths(points)
        of_points *= way[-1] / max(float(of_points[-1]), 1e-300)
        found = np.empty(len(points))
        for k in range(0, len(points), ROWS):
            own = points[k : k + ROWS]
            far = np.hypot(*(own[:, None] - places[None]).transpose(2, 0, 1))
            # Where a chain comes near itself, the length along it decides.
            found[k : k + ROWS] = t[np.argmin(far + 0.1 * np.abs(of_points[k : k + ROWS, None] - way), axis=1)]
        step = 1.0 / SAMPLES
        for _ in range(3):
            ahead, behind = np.minimum(found + 1e-6, self.count), np.maximum(found - 1e-6, 0.0)
            speed = (self.chain.at(ahead) - self.chain.at(behind)) / (ahead - behind)[:, None]
            off = ((self.chain.at(found) - points) * speed).sum(axis=1)
            move = off / np.maximum((speed * speed).sum(axis=1), 1e-300)
            found = np.clip(found - np.clip(move, -step, step), 0.0, self.count)
        found[0], found[-1] = 0.0, self.count
        return np.asarray(np.maximum.accumulate(found))


def _lengths(points: Floats) -> Floats:
    """(n,) length of the polyline up to each point."""
    return np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])


def _value(own: list[float], s: float) -> float:
    """A polynomial in Bernstein form, by de Casteljau."""
    while len(own) > 1:
        own = [(1.0 - s) * own[k] + s * own[k + 1] for k in range(len(own) - 1)]
    return own[0]


def _extremes(own: list[float]) -> list[float]:
    """Where a polynomial of degree 2 or 3 in Bernstein form has derivative zero, ascending, between 0 and 1."""
    d = [own[k + 1] - own[k] for k in range(len(own) - 1)]
    a, b, c = (0.0, d[1] - d[0], d[0]) if len(d) == 2 else (d[0] - 2.0 * d[1] + d[2], 2.0 * (d[1] - d[0]), d[0])
    root = b * b - 4.0 * a * c
    if root < 0.0:
        return []
    q = -0.5 * (b + (root**0.5 if b >= 0.0 else -(root**0.5)))
    found = [up / down for up, down in ((q, a), (c, q)) if down != 0.0]
    return sorted(s for s in found if 0.0 < s < 1.0)


def _root(own: list[float], low: float, high: float) -> float:
    """Where a polynomial in Bernstein form changes its sign, to the last bit."""
    rising = _value(own, low) < 0.0
    while True:
        middle = 0.5 * (low + high)
        if middle in (low, high):
            return middle
        if (_value(own, middle) < 0.0) == rising:
            low = middle
        else:
            high = middle


def _cut(points: Floats, low: float, high: float) -> Floats:
    """The control points of a Bezier curve between two parameters."""
    if high < 1.0:
        points = _halves(points, high)[0]
    return points if low <= 0.0 else _halves(points, low / high)[1]


def _halves(points: Floats, s: float) -> tuple[Floats, Floats]:
    before, after = [points[0]], [points[-1]]
    while len(points) > 1:
        points = (1.0 - s) * points[:-1] + s * points[1:]
        before.append(points[0])
        after.append(points[-1])
    return np.array(before), np.array(after[::-1])


__all__ = ["ArcTrack", "BezierTrack", "Polyline", "Track", "track_of"]
