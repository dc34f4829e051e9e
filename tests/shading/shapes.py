"""Meshes with known answers."""

import numpy as np


def box(size=2.0):
    """A closed box about the origin, turned outward."""
    h = size / 2
    points = np.array([(x, y, z) for x in (-h, h) for y in (-h, h) for z in (-h, h)])
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return points, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])


def sheet(corners):
    """One quadrilateral in two triangles."""
    return np.array(corners, float), np.array([(0, 1, 2), (0, 2, 3)])


def joined(*meshes):
    points, faces, first = [], [], 0
    for p, f in meshes:
        points.append(p)
        faces.append(np.asarray(f) + first)
        first += len(p)
    return np.concatenate(points), np.concatenate(faces)


def linear(value):
    """sRGB bytes -> linear light."""
    c = np.asarray(value, float) / 255.0
    return np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)
