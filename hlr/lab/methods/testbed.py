"""Scenes of a given number of polygons for timing, as in the textbook's comparison.

The more polygons, the smaller each of them. So the number of layers over a pixel is the same in all scenes, and only
the number of polygons to sort grows.
"""

from __future__ import annotations

import math

import numpy as np

from hlr.common.types import Floats
from hlr.lab.methods.polygons import Polygons

COUNTS = (100, 250, 550, 2_500, 8_000, 60_000, 1_000_000)
LAYERS = 4.0
"""Polygons over one another at a pixel, on average."""
DEEP = 1000.0
"""Extent in depth, in pixels of a picture 1024 wide."""


def polygons(count: int, size: tuple[int, int], crossing: bool = False, seed: int = 1) -> Polygons:
    """Triangles and quadrangles in pixels, spread evenly over the picture and in depth.

    Each lies in a slice of depth of its own; crossing: they are steep instead, and pass through one another.
    """
    rng = np.random.default_rng(seed)
    width, height = size
    corners = rng.integers(3, 5, count)
    # The corners lie on a circle, one in each equal part of it, so the polygon is convex and has about half its area.
    radius = math.sqrt(LAYERS * width * height / (count * 0.5 * math.pi))
    owner = np.repeat(np.arange(count), corners)
    first = np.cumsum(corners) - corners
    part = np.arange(len(owner)) - first[owner]
    angle = 2.0 * math.pi * (part + rng.uniform(0.1, 0.9, len(owner))) / corners[owner]
    centre = rng.uniform(0.0, 1.0, (count, 2)) * (width, height)
    flat = centre[owner] + radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    away = flat - centre[owner]
    if crossing:
        depth = rng.uniform(0.0, DEEP, count)
        slope = rng.uniform(-1.0, 1.0, (count, 2)) * 0.5 * DEEP / radius
    else:
        depth = rng.permutation(count).astype(np.float64) * (DEEP / count)
        slope = rng.uniform(-1.0, 1.0, (count, 2)) * 0.3 * DEEP / count / radius
    z = depth[owner] + (away * slope[owner]).sum(axis=1)
    points: Floats = np.empty((len(z), 3), np.float64)
    points[:, :2], points[:, 2] = flat, z
    offsets = np.append(first, len(owner)).astype(np.int32)
    return Polygons(
        points,
        np.arange(len(owner), dtype=np.int32),
        offsets,
        np.arange(count + 1, dtype=np.int32),
        np.zeros(count, np.bool_),
    )
