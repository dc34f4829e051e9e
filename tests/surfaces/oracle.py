"""Which polygon is visible at a pixel, by rationals. It shares nothing with the kernel."""

from __future__ import annotations

from fractions import Fraction

import numpy as np


def seen(polygons, size, rule="even-odd"):
    """(height, width) ids and depths; polygons are lists of loops of (x, y, z) in pixels, all planar."""
    width, height = size
    ids = np.full((height, width), -1)
    depths = np.full((height, width), np.inf)
    best: dict[tuple[int, int], Fraction] = {}
    for number, given in enumerate(polygons):
        loops = [[tuple(Fraction(c) for c in p) for p in loop] for loop in given]
        plane = _plane(loops)
        if plane is None:
            continue
        xs, ys = ([p[k] for loop in loops for p in loop] for k in (0, 1))
        edges = list(_edges(loops))
        for row in range(max(0, int(min(ys)) - 1), min(height, int(max(ys)) + 2)):
            y = row + Fraction(1, 2)
            crossings = list(_crossings(edges, y))
            if not crossings:
                continue
            for column in range(max(0, int(min(xs)) - 1), min(width, int(max(xs)) + 2)):
                x = column + Fraction(1, 2)
                # A pixel is beyond a crossing that its centre lies on.
                winding = sum(way for at, way in crossings if at <= x)
                if winding == 0 or (rule == "even-odd" and winding % 2 == 0):
                    continue
                z = plane[0] * x + plane[1] * y + plane[2]
                # Lower ids come first: they win at equal depth.
                if (row, column) not in best or z < best[row, column]:
                    best[row, column] = z
                    ids[row, column], depths[row, column] = number, float(z)
    return ids, depths


def _edges(loops):
    """Top corner, bottom corner, direction of every edge that is not horizontal."""
    for loop in loops:
        for p, q in zip(loop, loop[1:] + loop[:1], strict=True):
            if p[1] != q[1]:
                yield (p, q, 1) if p[1] < q[1] else (q, p, -1)


def _crossings(edges, y):
    """Of the edges with y_min <= y < y_max: where they cross the row, and which way."""
    for top, bottom, way in edges:
        if top[1] <= y < bottom[1]:
            yield top[0] + (y - top[1]) * (bottom[0] - top[0]) / (bottom[1] - top[1]), way


def _plane(loops):
    """z = a x + b y + c from three corners that span it in the image."""
    corners = [p for loop in loops for p in loop]
    o = corners[0]
    for p in corners:
        for q in corners:
            det = (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0])
            if det:
                a = ((p[2] - o[2]) * (q[1] - o[1]) - (q[2] - o[2]) * (p[1] - o[1])) / det
                b = ((p[0] - o[0]) * (q[2] - o[2]) - (q[0] - o[0]) * (p[2] - o[2])) / det
                c = o[2] - a * o[0] - b * o[1]
                assert all(a * r[0] + b * r[1] + c == r[2] for r in corners), "the oracle wants planar polygons"
                return a, b, c
    return None
