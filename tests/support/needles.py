"""A prism of a mesh with needles, as exporters make them where a vertex lies on an edge of its neighbour."""

from __future__ import annotations

import numpy as np

from support.meshes import rotation

HEIGHT, RADIUS = 60.0, 20.0


def prism(sides, size=1.0, turn=(1, 2, 3), off=3.0):
    """(points, triangles): every upright edge has a needle, its corner `off` roundings beside the edge's middle."""
    angle = 2 * np.pi * np.arange(sides) / sides
    ring = np.stack([RADIUS * np.cos(angle), RADIUS * np.sin(angle), np.zeros(sides)], axis=1)
    rng = np.random.default_rng(5)
    points = np.concatenate([ring, ring + (0, 0, HEIGHT), ring + (0, 0, HEIGHT / 2), [(0, 0, 0), (0, 0, HEIGHT)]])
    points = size * points @ rotation(turn, 0.7).T
    points[2 * sides : 3 * sides] += off * 2.0**-24 * 60.0 * size * rng.uniform(-1, 1, (sides, 3))
    faces = []
    for i in range(sides):
        j = (i + 1) % sides
        p, q, r, bottom, top = i, sides + i, 2 * sides + i, 3 * sides, 3 * sides + 1
        s, t = j, sides + j
        faces += [(p, q, r), (p, r, s), (r, q, s), (q, t, s), (bottom, p, s), (top, t, q)]
    triangles = np.array(faces)[:, [0, 2, 1]]
    triangles[4::6] = triangles[4::6][:, [0, 2, 1]]
    triangles[5::6] = triangles[5::6][:, [0, 2, 1]]
    return points.astype(np.float32).astype(np.float64), triangles
