"""Placements of sub-shapes: composed, compared and cancelled exactly as TopLoc_Location does.

OpenCASCADE says that two sub-shapes are the same when their underlying shape and their *location* agree, and a
location is not a matrix but a chain of elementary transformations with powers. Two chains with equal matrices may
differ; a chain times its inverse vanishes. The index maps of a part depend on this, so chains are composed here.
"""

from __future__ import annotations

import numpy as np

from hlr.source.model import Floats, Ints

Chain = tuple[tuple[int, int], ...]
"""(elementary transformation, power) from the outermost to the innermost."""

IDENTITY = 0


class Locations:
    """A growing table of locations; number 0 is the identity."""

    def __init__(self, chains: list[Chain], datums: list[Floats]) -> None:
        """`chains` as numbered in a dump, 0 being the empty one; `datums`: (3, 4) matrices of elementary moves."""
        self._datums = datums
        self._chains = list(chains)
        self._numbers: dict[Chain, int] = {}
        # Equal chains share the first number, so that numbers can be compared instead of chains.
        self.first = np.array([self._numbers.setdefault(chain, i) for i, chain in enumerate(chains)], dtype=np.int32)
        self._products: dict[tuple[int, int], int] = {}
        self._matrices: dict[int, Floats] = {}

    def product(self, outer: int, inner: int) -> int:
        """The number of the location `outer` * `inner`."""
        if outer == IDENTITY:
            return int(inner)
        if inner == IDENTITY:
            return int(outer)
        known = self._products.get((outer, inner))
        if known is None:
            chain = list(self._chains[outer])
            for datum, power in self._chains[inner]:
                # Only neighbours of one and the same elementary move merge: what TopLoc_Location::Multiplied does.
                total = power + chain.pop()[1] if chain and chain[-1][0] == datum else power
                if total:
                    chain.append((datum, total))
            known = self._products[outer, inner] = self._number(tuple(chain))
        return known

    def quotients(self, outer: Ints, inner: Ints) -> Ints:
        """Elementwise outer^-1 * inner."""
        keys = outer.astype(np.int64) << 32 | inner
        unique, inverse = np.unique(keys, return_inverse=True)
        values = [self.product(self._inverse(int(key >> 32)), int(key & 0xFFFFFFFF)) for key in unique]
        return np.array(values, dtype=np.int32)[inverse]

    def _inverse(self, number: int) -> int:
        return self._number(tuple((datum, -power) for datum, power in reversed(self._chains[number])))

    def _number(self, chain: Chain) -> int:
        known = self._numbers.get(chain)
        if known is None:
            known = self._numbers[chain] = len(self._chains)
            self._chains.append(chain)
        return known

    def products(self, outer: Ints, inner: Ints) -> Ints:
        """Elementwise `product` of two arrays of numbers."""
        result = outer.copy()
        both = np.flatnonzero(inner)
        if len(both):
            keys = outer[both].astype(np.int64) << 32 | inner[both]
            unique, inverse = np.unique(keys, return_inverse=True)
            values = [self.product(int(key >> 32), int(key & 0xFFFFFFFF)) for key in unique]
            result[both] = np.array(values, dtype=np.int32)[inverse]
        return result

    def matrix(self, number: int) -> Floats:
        """(3, 4) matrix of a location."""
        known = self._matrices.get(number)
        if known is None:
            known = np.eye(3, 4)
            for datum, power in self._chains[number]:
                step = self._datums[datum] if power > 0 else inverted(self._datums[datum])
                for _ in range(abs(power)):
                    known = chained(known, step)
            self._matrices[number] = known
        return known

    def matrices(self, numbers: Ints) -> Floats:
        """(n, 3, 4) matrices of an array of numbers."""
        unique, inverse = np.unique(numbers, return_inverse=True)
        stack = np.array([self.matrix(int(n)) for n in unique]).reshape(-1, 3, 4)
        return stack[inverse]


def chained(outer: Floats, inner: Floats) -> Floats:
    """The (3, 4) matrix that moves by `inner`, then by `outer`; no BLAS, so every machine gets the same bits."""
    result = np.empty((3, 4))
    for i in range(3):
        a, b, c, d = (float(v) for v in outer[i])
        for j in range(4):
            result[i, j] = a * inner[0, j] + b * inner[1, j] + c * inner[2, j] + (d if j == 3 else 0.0)
    return result


def inverted(matrix: Floats) -> Floats:
    """The inverse of a (3, 4) matrix, by cofactors."""
    a = [[float(v) for v in row] for row in matrix]
    cofactors = [
        [
            a[(j + 1) % 3][(i + 1) % 3] * a[(j + 2) % 3][(i + 2) % 3]
            - a[(j + 1) % 3][(i + 2) % 3] * a[(j + 2) % 3][(i + 1) % 3]
            for j in range(3)
        ]
        for i in range(3)
    ]
    determinant = sum(a[0][k] * cofactors[k][0] for k in range(3))
    result = np.empty((3, 4))
    for i in range(3):
        row = [cofactors[i][j] / determinant for j in range(3)]
        result[i, :3] = row
        result[i, 3] = -(row[0] * a[0][3] + row[1] * a[1][3] + row[2] * a[2][3])
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
