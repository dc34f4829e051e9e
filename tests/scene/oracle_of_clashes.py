"""Where two triangles pass through each other, once more: exact, slow, and sharing nothing with the kernel.

The planes of two triangles have a line in common. Each side of each triangle leaves a half of that line; what all six
leave is the segment. Coordinates are integers, everything else fractions: nothing is rounded.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import sqrt

Vector = tuple[Fraction, Fraction, Fraction]
Triangle = Sequence[Sequence[int]]


@dataclass(frozen=True)
class Common:
    """ends: of the segment; depth, sine: as the kernel has them (squares are exact)."""

    ends: tuple[Vector, Vector]
    depth: float
    sine: float


def common(a: Triangle, b: Triangle) -> Common | None:
    """None where the planes are parallel, a triangle has no plane, or less than a segment is common."""
    p, q = _vectors(a), _vectors(b)
    m, n = _normal(p), _normal(q)
    along = _cross(m, n)
    square = _dot(along, along)
    if square == 0:
        return None
    # The point of both planes that is nearest to the origin.
    c, d = _dot(m, p[0]), _dot(n, q[0])
    foot = _scaled(_sum(_scaled(_cross(n, along), c), _scaled(_cross(along, m), d)), 1 / square)
    low: Fraction | None = None
    high: Fraction | None = None
    for corners, normal in ((p, m), (q, n)):
        for i in range(3):
            start, end = corners[i], corners[(i + 1) % 3]
            inward = _cross(normal, _minus(end, start))
            # inward . (foot + t along - start) >= 0
            here, slope = _dot(inward, _minus(foot, start)), _dot(inward, along)
            if slope == 0:
                if here < 0:
                    return None
            elif slope > 0:
                low = -here / slope if low is None else max(low, -here / slope)
            else:
                high = -here / slope if high is None else min(high, -here / slope)
    assert low is not None and high is not None, "a line leaves a triangle on both sides"
    if low >= high:
        return None
    depth = min(_shallower(p, q[0], n) / sqrt(_dot(n, n)), _shallower(q, p[0], m) / sqrt(_dot(m, m)))
    sine = sqrt(square / (_dot(m, m) * _dot(n, n)))
    return Common((_sum(foot, _scaled(along, low)), _sum(foot, _scaled(along, high))), depth, sine)


def _shallower(corners: Sequence[Vector], on: Vector, normal: Vector) -> Fraction:
    """How far the corners reach beyond a plane, on the side where they do so less, times |normal|."""
    side = [_dot(normal, _minus(v, on)) for v in corners]
    return max(Fraction(0), min(max(side), -min(side)))


def _vectors(triangle: Triangle) -> list[Vector]:
    return [(Fraction(int(x)), Fraction(int(y)), Fraction(int(z))) for x, y, z in triangle]


def _normal(t: Sequence[Vector]) -> Vector:
    return _cross(_minus(t[1], t[0]), _minus(t[2], t[0]))


def _sum(u: Vector, v: Vector) -> Vector:
    return (u[0] + v[0], u[1] + v[1], u[2] + v[2])


def _minus(u: Vector, v: Vector) -> Vector:
    return (u[0] - v[0], u[1] - v[1], u[2] - v[2])


def _scaled(u: Vector, by: Fraction) -> Vector:
    return (u[0] * by, u[1] * by, u[2] * by)


def _dot(u: Vector, v: Vector) -> Fraction:
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def _cross(u: Vector, v: Vector) -> Vector:
    return (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
