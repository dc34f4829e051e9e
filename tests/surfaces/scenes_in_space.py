"""Random polygons anywhere in space, and views of them: rotated, in perspective, far away, close together."""

from __future__ import annotations

import numpy as np

from hlr.image.camera import resolve
from hlr.request.options import Options, Perspective
from hlr.source.model import Frame

SIZE = (24, 18)


def _outline(rng, warped):
    """Loops in a plane of their own: triangles, quads, self-crossing ones whose lobes cancel or do not, holes."""
    kind = rng.integers(6)
    if kind == 0:
        return [rng.uniform(-1, 1, (3, 2))]
    if kind == 1:
        return [np.array([(-1, -1), (1, -0.8), (0.9, 1), (-0.7, 0.8)]) * rng.uniform(0.4, 1, 2)]
    if kind == 2:  # a bow tie: two lobes of one size, run in opposite ways
        return [np.array([(-1, -1), (1, 1), (1, -1), (-1, 1)]) * rng.uniform(0.3, 1, 2)]
    if kind == 3:  # a figure of eight along a slant
        return [np.array([(-1, 0), (0, 0.7), (0.1, -0.7), (1, 0), (0, 0.7), (-0.1, -0.7)]) * rng.uniform(0.6, 1)]
    if kind == 4:
        return [rng.uniform(-1, 1, (int(rng.integers(4, 8)), 2))]
    square = np.array([(-1.0, -1.0), (1, -1), (1, 1), (-1, 1)])
    return [square, square[::-1] * rng.uniform(0.2, 0.7)]


def polygons(rng, count=7, warp=0.0):
    """Lists of loops, within a few units of the origin; warp: how far some corners leave their plane."""
    out = []
    for _ in range(count):
        axes = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        centre, size = rng.uniform(-1.5, 1.5, 3), rng.uniform(0.5, 2.5)
        loops = []
        for loop in _outline(rng, warp):
            bent = warp * rng.normal(size=len(loop)) if rng.random() < 0.5 else np.zeros(len(loop))
            loops.append(centre + size * (loop @ axes[:2] + bent[:, None] * axes[2]))
        out.append(loops)
    return out


def moved(scene, shift, scale=1.0):
    return [[loop * scale + shift for loop in loops] for loops in scene]


def camera(rng, kind, shift=(0.0, 0.0, 0.0), scale=1.0):
    """A parallel view along anything, or an eye at some distance, of what lies around `shift`."""
    shift = np.asarray(shift, float)
    bounds = np.array([shift - 4 * scale, shift + 4 * scale])
    direction = rng.normal(size=3)
    direction /= np.linalg.norm(direction)
    if kind == "iso":
        return resolve("iso", Options(), Frame(), bounds)
    if kind == "parallel":
        return resolve(tuple(direction), Options(), Frame(), bounds)
    eye = tuple((shift + 12 * scale * direction).tolist())
    return resolve("front", Options(perspective=Perspective(eye, tuple(shift.tolist()), 30.0)), Frame(), bounds)
