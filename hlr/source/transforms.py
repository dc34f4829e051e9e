"""Placements as matrices: composition, sign of the determinant, application to points."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hlr.common.types import Floats

MatrixRows = tuple[float, ...]
"""The twelve numbers of a (3, 4) matrix, row by row: faster than an array for a single placement."""

IDENTITY: MatrixRows = (1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0)
"""The placement that moves nothing."""


def compose(outer: MatrixRows, inner: MatrixRows) -> MatrixRows:
    """The placement that applies `inner`, then `outer`."""
    if inner is IDENTITY:
        return outer
    if outer is IDENTITY:
        return inner
    p, q, r = inner[0:4], inner[4:8], inner[8:12]
    out = []
    for i in (0, 4, 8):
        a, b, c, d = outer[i : i + 4]
        shift = (0.0, 0.0, 0.0, d)
        out += [a * x + b * y + c * z + s for x, y, z, s in zip(p, q, r, shift, strict=True)]
    return tuple(out)


def matrix4(rows: MatrixRows) -> Floats:
    """The matrix (4, 4) of a placement; minus zeros become zeros."""
    whole: Floats = matrices4([rows])[0]
    return whole


def matrices4(placements: Sequence[MatrixRows]) -> Floats:
    """The matrices (n, 4, 4) of placements; minus zeros become zeros."""
    whole: Floats = np.array([(*rows, 0.0, 0.0, 0.0, 1.0) for rows in placements], np.float64).reshape(-1, 4, 4)
    whole += 0.0
    return whole


def determinant_sign(matrix: Floats) -> int:
    """-1 where a (3, 4) or (4, 4) matrix mirrors, else 1."""
    m = matrix
    value = (
        m[0, 0] * (m[1, 1] * m[2, 2] - m[1, 2] * m[2, 1])
        - m[0, 1] * (m[1, 0] * m[2, 2] - m[1, 2] * m[2, 0])
        + m[0, 2] * (m[1, 0] * m[2, 1] - m[1, 1] * m[2, 0])
    )
    return -1 if value < 0 else 1


def transform_points(points: Floats, matrix: Floats) -> Floats:
    """Points (n, 3) transformed by a (3, 4) or (4, 4) matrix, element by element: the same bits on every machine."""
    x, y, z = points[:, 0], points[:, 1], points[:, 2]
    result = np.empty_like(points)
    for i in range(3):
        a, b, c, d = (float(v) for v in matrix[i])
        result[:, i] = a * x + b * y + c * z + d
    return result
