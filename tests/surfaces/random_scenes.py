"""Random polygons on coarse grids, full of ties: corners on pixel centres, shared edges, equal depths."""

from __future__ import annotations

import random

SIZE = (12, 9)
HALVES = 2


def _corner(rng, margin=1):
    """On a grid of half pixels, so that many edges run through pixel centres; a little beyond the frame as well."""
    return tuple(rng.randint(-margin * HALVES, (side + margin) * HALVES) / HALVES for side in SIZE)


def _on_plane(loops, plane):
    a, b, c = plane
    return [[(x, y, a * x + b * y + c) for x, y in loop] for loop in loops]


def _outline(rng):
    """Triangles, concave and self-crossing loops, and squares with a hole."""
    kind = rng.randrange(5)
    if kind <= 1:
        return [[_corner(rng) for _ in range(3)]]
    if kind == 2:
        return [[_corner(rng) for _ in range(rng.randint(4, 7))]]
    if kind == 3:
        x, y = _corner(rng)
        w, h = rng.randint(3, 8), rng.randint(3, 8)
        square = [(x, y), (x + w, y), (x + w, y + h), (x, y + h)]
        hole = [(x + 1, y + 1), (x + 1, y + h - 1), (x + w - 1, y + h - 1), (x + w - 1, y + 1)]
        return [square, hole if rng.random() < 0.7 else hole[::-1]]
    x, y = _corner(rng)
    return [[(x, y), (x + 6, y + 1), (x + 2, y + 2), (x + 5, y + 6), (x - 1, y + 3)]]


def disjoint(seed):
    """Each in its own slice of depth, in any order of ids."""
    rng = random.Random(seed)
    slices = list(range(rng.randint(3, 10)))
    rng.shuffle(slices)
    return [_on_plane(_outline(rng), (rng.choice((0, 0.25, -0.5)), rng.choice((0, 0.5)), 100 * s)) for s in slices]


def touching(seed):
    """A bent net of triangles, some doubled, and polygons in the planes of others."""
    rng = random.Random(seed)
    n, m = rng.randint(2, 4), rng.randint(2, 3)
    heights = [[rng.randint(0, 4) for _ in range(n + 1)] for _ in range(m + 1)]
    spread = rng.choice((2, 3, 3.5))
    grid = [
        [(i * spread + rng.choice((0, 0.5)), j * spread + 0.5, heights[j][i]) for i in range(n + 1)]
        for j in range(m + 1)
    ]
    out = []
    for j in range(m):
        for i in range(n):
            a, b, c, d = grid[j][i], grid[j][i + 1], grid[j + 1][i + 1], grid[j + 1][i]
            out += [[[a, b, c]], [[a, c, d]]] if rng.random() < 0.5 else [[[b, c, d]], [[a, b, d]]]
    for _ in range(3):
        plane = rng.choice(((0, 0, 2), (0.5, 0, 0), (0, 0.25, 1)))
        out += [_on_plane(_outline(rng), plane) for _ in range(2)]
    out.append(rng.choice(out))
    rng.shuffle(out)
    return out


def interpenetrating(seed):
    """Planes that cross one another anywhere."""
    rng = random.Random(seed)
    slope = lambda: rng.randint(-6, 6) / 4  # noqa: E731
    return [_on_plane(_outline(rng), (slope(), slope(), rng.randint(-6, 12))) for _ in range(rng.randint(3, 9))]


def cyclic(seed):
    """Strips around a centre, each over the next and under the one before; and some more polygons in between."""
    rng = random.Random(seed)
    x, y = rng.randint(4, 9), rng.randint(4, 7)
    r, thick, rise = rng.randint(3, 6), rng.choice((1, 1.5, 2)), rng.choice((0.25, 0.5, 1))
    # Along x at the top, along y at the right, and so on; each rises in the way around.
    out = [
        _on_plane(
            [[(x - r, y - 3), (x + r, y - 3), (x + r, y - 3 + thick), (x - r, y - 3 + thick)]], (rise, 0, -rise * x)
        ),
        _on_plane(
            [[(x + 3, y - r), (x + 3, y + r), (x + 3 - thick, y + r), (x + 3 - thick, y - r)]], (0, rise, -rise * y)
        ),
        _on_plane(
            [[(x + r, y + 3), (x - r, y + 3), (x - r, y + 3 - thick), (x + r, y + 3 - thick)]], (-rise, 0, rise * x)
        ),
        _on_plane(
            [[(x - 3, y + r), (x - 3, y - r), (x - 3 + thick, y - r), (x - 3 + thick, y + r)]], (0, -rise, rise * y)
        ),
    ]
    if rng.random() < 0.5:
        out.pop(rng.randrange(4))
    for _ in range(rng.randint(0, 3)):
        out.append(_on_plane(_outline(rng), (rng.choice((0, 0.25)), 0, rng.randint(-8, 8))))
    rng.shuffle(out)
    return out


KINDS = {"disjoint": disjoint, "touching": touching, "interpenetrating": interpenetrating, "cyclic": cyclic}
