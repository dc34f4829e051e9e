"""Decides visibility in exact rationals: slow, simple, and without any code of the kernel.

Every drawn segment a -> b is compared with every triangle. A triangle hides the segment where four conditions hold,
each linear in the segment's parameter t: inside the three sides of the triangle's image, and behind its plane. So each
triangle hides one interval of t. The hidden part is the union of the intervals, and the number of triangles in front
(Appel's quantitative invisibility) is the number of intervals that contain t.

Coincidences. Depth z grows away from the viewer. The segment, and nothing else, is moved by

    side * (e^2, e^3), -e        e > 0, going to 0

which lifts it off the faces it lies on and off the lines it covers in the image. Moving does not turn the segment: a
condition alpha + beta t > 0 keeps its beta, and alpha goes to its unmoved value. Hence, exactly and without taking a
limit numerically: where beta is not 0 the unmoved end counts, and where beta is 0 the sign of alpha at a small e does.
Intervals whose length goes to 0 with e are dropped.

Coordinates must be integers of at most LARGEST for SMALL to be small enough.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Sequence
from fractions import Fraction
from typing import NamedTuple

Point = tuple[int, int, int]
Triangle = tuple[Point, Point, Point]
Segment = tuple[Point, Point]

LARGEST = 1 << 20
SMALL_BITS = 100
"""e = 2^-SMALL_BITS: against integers up to 2^62 (a plane at LARGEST), its powers never add up to one unit."""

ZERO, ONE = Fraction(0), Fraction(1)


class Interval(NamedTuple):
    """t0 < t1 along a segment, and how many triangles lie in front there."""

    t0: Fraction
    t1: Fraction
    invisibility: int

    @property
    def hidden(self) -> bool:
        return self.invisibility > 0


Condition = tuple[int, int, int]
"""alpha, beta of alpha + beta t > 0, and the sign alpha takes when the segment is moved."""


def _sign(value: int) -> int:
    return (value > 0) - (value < 0)


def _moved_sign(alpha: int, dx: int, dy: int, dz: int, side: int) -> int:
    """Sign of alpha at the moved segment, alpha growing by dx, dy, dz per unit in x, y, z."""
    bits = SMALL_BITS
    moved = (alpha << 3 * bits) + side * (dx << bits) + side * dy - (dz << 2 * bits)
    return _sign(moved)


def _conditions(segment: Segment, triangle: Triangle, side: int) -> list[Condition] | None:
    """The four conditions, or None for a triangle that is edge-on in the image: it hides nothing."""
    (ax, ay, az), (bx, by, bz) = segment
    ux, uy, uz = bx - ax, by - ay, bz - az
    p, q, r = triangle
    area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
    if area == 0:
        return None
    if area < 0:
        q, r = r, q
    conditions = []
    for (px, py, _), (qx, qy, _) in ((p, q), (q, r), (r, p)):
        wx, wy = qx - px, qy - py
        alpha = wx * (ay - py) - wy * (ax - px)
        beta = wx * uy - wy * ux
        conditions.append((alpha, beta, _moved_sign(alpha, -wy, wx, 0, side)))
    # The normal has a positive z (the image runs counter-clockwise), so it grows positive away from the viewer.
    sx, sy, sz = q[0] - p[0], q[1] - p[1], q[2] - p[2]
    tx, ty, tz = r[0] - p[0], r[1] - p[1], r[2] - p[2]
    nx, ny, nz = sy * tz - sz * ty, sz * tx - sx * tz, sx * ty - sy * tx
    alpha = nx * (ax - p[0]) + ny * (ay - p[1]) + nz * (az - p[2])
    beta = nx * ux + ny * uy + nz * uz
    conditions.append((alpha, beta, _moved_sign(alpha, nx, ny, nz, side)))
    return conditions


def hidden_part(segment: Segment, triangle: Triangle, side: int = 1) -> tuple[Fraction, Fraction] | None:
    """Where this one triangle hides the segment: an open interval within 0..1, or nowhere."""
    conditions = _conditions(segment, triangle, side)
    if conditions is None:
        return None
    low, high = (0, 1), (1, 1)
    for alpha, beta, moved in conditions:
        if beta == 0:
            if moved <= 0:
                return None
        elif beta > 0:  # t > -alpha / beta
            if -alpha * low[1] > low[0] * beta:
                low = (-alpha, beta)
        elif alpha * high[1] < high[0] * -beta:  # t < alpha / -beta
            high = (alpha, -beta)
    if low[0] * high[1] >= high[0] * low[1]:
        return None
    return Fraction(*low), Fraction(*high)


def hidden_parts(segment: Segment, triangles: Iterable[Triangle], side: int = 1) -> list[tuple[Fraction, Fraction]]:
    """For each triangle that hides some of the segment, what it hides."""
    (ax, ay, _), (bx, by, _) = segment
    left, right, bottom, top = min(ax, bx), max(ax, bx), min(ay, by), max(ay, by)
    parts = []
    for triangle in triangles:
        (px, py, _), (qx, qy, _), (rx, ry, _) = triangle
        apart = max(px, qx, rx) < left or min(px, qx, rx) > right or max(py, qy, ry) < bottom or min(py, qy, ry) > top
        part = None if apart else hidden_part(segment, triangle, side)
        if part is not None:
            parts.append(part)
    return parts


def intervals(segment: Segment, triangles: Iterable[Triangle], side: int = 1) -> list[Interval]:
    """The segment's parameters 0..1, cut where the number of triangles in front changes."""
    changes: dict[Fraction, int] = {ZERO: 0, ONE: 0}
    for start, end in hidden_parts(segment, triangles, side):
        changes[start] = changes.get(start, 0) + 1
        changes[end] = changes.get(end, 0) - 1
    result: list[Interval] = []
    count = 0
    ends = sorted(changes)
    for t0, t1 in itertools.pairwise(ends):
        count += changes[t0]
        if result and result[-1].invisibility == count:
            result[-1] = Interval(result[-1].t0, t1, count)
        else:
            result.append(Interval(t0, t1, count))
    return result


def states(found: Sequence[Interval]) -> list[tuple[Fraction, Fraction, bool]]:
    """Intervals (t0, t1, hidden); neighbours that differ only in their count are joined."""
    result: list[tuple[Fraction, Fraction, bool]] = []
    for t0, t1, count in found:
        if result and result[-1][2] == (count > 0):
            result[-1] = (result[-1][0], t1, count > 0)
        else:
            result.append((t0, t1, count > 0))
    return result


def states_either_side(segment: Segment, triangles: Sequence[Triangle]) -> list[tuple[Fraction, Fraction, bool]]:
    """The rule for lines over contours: visible where the segment, moved to one side or the other, is visible."""
    one, other = (states(intervals(segment, triangles, side)) for side in (1, -1))
    ends = sorted({t for t0, t1, _ in [*one, *other] for t in (t0, t1)})
    cut = []
    for t0, t1 in itertools.pairwise(ends):
        middle = (t0 + t1) / 2
        hidden = all(state for found in (one, other) for low, high, state in found if low < middle < high)
        cut.append(Interval(t0, t1, int(hidden)))
    return states(cut)


def invisibility_at(segment: Segment, triangles: Iterable[Triangle], t: Fraction, side: int = 1) -> int:
    """Count the triangles in front of one point, from coordinates alone, to check the oracle.

    The point is moved by a small finite amount and compared with each triangle by the barycentric coordinates of its
    image. The result is meaningful only away from the ends of intervals.
    """
    e = Fraction(1, 1 << SMALL_BITS)
    a, b = segment
    x, y, z = (Fraction(p) + t * (q - p) for p, q in zip(a, b, strict=True))
    x, y, z = x + side * e**2, y + side * e**3, z - e
    count = 0
    for p, q, r in triangles:
        area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
        if area == 0:
            continue
        v = ((x - p[0]) * (r[1] - p[1]) - (y - p[1]) * (r[0] - p[0])) / area
        w = ((q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])) / area
        u = 1 - v - w
        if u > 0 and v > 0 and w > 0 and u * p[2] + v * q[2] + w * r[2] < z:
            count += 1
    return count
