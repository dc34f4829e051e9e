"""Placements as matrices: put one upon the other, and applied to points."""

from __future__ import annotations

import numpy as np

from hlr.source.model import Floats


def chained(outer: Floats, inner: Floats) -> Floats:
    """The (3, 4) matrix that moves by `inner`, then by `outer`; no BLAS, so every machine gets the same bits."""
    result = np.empty((3, 4))
    for i in range(3):
        a, b, c, d = (float(v) for v in outer[i])
        for j in range(4):
            result[i, j] = a * inner[0, j] + b * inner[1, j] + c * inner[2, j] + (d if j == 3 else 0.0)
    return result


def determinant_sign(matrix: Floats) -> int:
    """-1 where a (3, 4) or (4, 4) matrix mirrors, else 1."""
    m = matrix
    value = (
        m[0, 0] * (m[1, 1] * m[2, 2] - m[1, 2] * m[2, 1])
        - m[0, 1] * (m[1, 0] * m[2, 2] - m[1, 2] * m[2, 0])
        + m[0, 2] * (m[1, 0] * m[2, 1] - m[1, 1] * m[2, 0])
    )
    return -1 if value < 0 else 1


def moved(points: Floats, matrix: Floats) -> Floats:
    """(n, 3) points moved by one (3, 4) or (4, 4) matrix, elementwise."""
    x, y, z = points[:, 0], points[:, 1], points[:, 2]
    result = np.empty_like(points)
    for i in range(3):
        a, b, c, d = (float(v) for v in matrix[i])
        result[:, i] = a * x + b * y + c * z + d
    return result


def moved_each(points: Floats, matrices: Floats) -> Floats:
    """(n, 3) points, each moved by its own (n, 3, 4) matrix, elementwise."""
    x, y, z = points[:, 0], points[:, 1], points[:, 2]
    result = np.empty_like(points)
    for i in range(3):
        m = matrices[:, i]
        result[:, i] = m[:, 0] * x + m[:, 1] * y + m[:, 2] * z + m[:, 3]
    return result
