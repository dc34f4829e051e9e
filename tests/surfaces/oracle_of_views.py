"""Which polygon is visible at a pixel of any view, by rationals: polygons anywhere in space, in perspective too.

It shares nothing with the kernel but the camera's matrix. Each pixel's answer comes with how safe it is, for the
kernel rounds once: to a 256th of a pixel, and depth to so many steps.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations

STEP = Fraction(1, 256)


def judged(polygons, matrix, size, rule="even-odd"):
    """{(row, column): (id or -1, depth, gap)}: gap, the depth by which the winner leads the next; None without one.

    polygons: lists of loops of points, all planar up to the last bits and before the eye. Pixels whose centre lies
    within a 256th of a pixel of some edge are left out.
    """
    rows = [[Fraction(c) for c in row] for row in matrix]
    flat = [[[_projected(rows, p) for p in loop] for loop in loops] for loops in polygons]
    planes = [_plane([p for loop in loops for p in loop]) for loops in flat]
    out = {}
    for row in range(size[1]):
        for column in range(size[0]):
            x, y = column + Fraction(1, 2), row + Fraction(1, 2)
            found = []
            for number, (loops, plane) in enumerate(zip(flat, planes, strict=True)):
                inside = _inside(loops, x, y, rule)
                if inside is None:
                    break
                if inside and plane is not None:
                    found.append((plane[0] * x + plane[1] * y + plane[2], number))
            else:
                found.sort()
                if not found:
                    out[row, column] = (-1, None, None)
                else:
                    gap = found[1][0] - found[0][0] if len(found) > 1 else None
                    out[row, column] = (found[0][1], found[0][0], gap)
    return out


def _projected(rows, point):
    x, y, z = (Fraction(c) for c in point)
    u, v, q, w = (a * x + b * y + c * z + d for a, b, c, d in rows)
    assert w > 0, "the oracle wants what is before the eye"
    return u / w, v / w, q / w


def _inside(loops, x, y, rule):
    """Whether a centre is inside; None where it is too near to an edge to say."""
    winding = 0
    for loop in loops:
        for p, q in zip(loop, [*loop[1:], loop[0]], strict=True):
            if _near(p, q, x, y):
                return None
            if (p[1] <= y) != (q[1] <= y):
                side = (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])
                winding += (side > 0) - (side < 0) if (q[1] > p[1]) == (side > 0) else 0
    return winding % 2 != 0 if rule == "even-odd" else winding != 0


def _near(p, q, x, y):
    """Within a step of the segment."""
    if not (min(p[0], q[0]) - STEP <= x <= max(p[0], q[0]) + STEP):
        return False
    if not (min(p[1], q[1]) - STEP <= y <= max(p[1], q[1]) + STEP):
        return False
    dx, dy = q[0] - p[0], q[1] - p[1]
    off = dx * (y - p[1]) - dy * (x - p[0])
    return off * off <= STEP * STEP * (dx * dx + dy * dy)


def _plane(corners):
    """Depth as a x + b y + c, through the three corners that span most; None for what is seen edge-on."""

    def area(t):
        p, q, r = t
        return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])

    o, p, q = max(combinations(corners, 3), key=lambda t: abs(area(t)))
    det = area((o, p, q))
    if det == 0:
        return None
    a = ((p[2] - o[2]) * (q[1] - o[1]) - (q[2] - o[2]) * (p[1] - o[1])) / det
    b = ((p[0] - o[0]) * (q[2] - o[2]) - (q[0] - o[0]) * (p[2] - o[2])) / det
    return a, b, o[2] - a * o[0] - b * o[1]
