"""Curved patches z = f(x, y), drawn together with polygons (see the kernel's `methods/src/patch.rs`)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr.common.types import Floats
from hlr.errors import OptionError

TERMS = 4
"""Number of coefficients of a polynomial of the third degree."""

FARTHEST = 8192.0
"""Pixels that a patch may reach beyond the picture."""

METHODS = (("z-buffer", None), ("scan-line z-buffer", None), ("scan line", "both ends"))
"""Methods, and their variants (None: any), that take curved patches: those that compare depths at pixels."""

KernelPatch = tuple[int, list[list[float]], list[float], list[float]]


@dataclass(frozen=True, slots=True)
class Patch:
    """A piece of the surface z = f(x, y), x and y in pixels; f is a polynomial of degree at most three in each.

    coefficients  c[i][j] of (x - origin x)^i (y - origin y)^j, at most four by four
    bounds        (x0, y0, x1, y1): the rectangle that the patch covers, unless an outline is given
    outline       loops of (x, y) within the bounds, instead of the rectangle; inner loops are holes
    origin        (x, y) of the polynomial; choose it near the patch, so that the coefficients are small and exact

    Raises OptionError for arguments that do not make a patch.

    >>> bowl = Patch(((30.0, 0.0, 0.1), (0.0,), (0.1,)), (0, 0, 40, 40), origin=(20, 20))
    >>> bowl.at(20.0, 30.0).item()
    40.0
    """

    coefficients: tuple[tuple[float, ...], ...]
    bounds: tuple[float, float, float, float]
    outline: tuple[tuple[tuple[float, float], ...], ...] = ()
    origin: tuple[float, float] = (0.0, 0.0)

    def __post_init__(self) -> None:
        try:
            table = tuple(tuple(float(c) for c in row) for row in self.coefficients)
            x0, y0, x1, y1 = (float(b) for b in self.bounds)
            u, v = (float(o) for o in self.origin)
            loops = tuple(tuple((float(x), float(y)) for x, y in loop) for loop in self.outline)
        except (TypeError, ValueError):
            raise OptionError(
                "a patch needs rows of coefficients, bounds (x0, y0, x1, y1), an origin (x, y) and loops of (x, y)"
            ) from None
        if not 1 <= len(table) <= TERMS or any(not 1 <= len(row) <= TERMS for row in table):
            raise OptionError("a patch has one to four rows of one to four coefficients: degree three in x and in y")
        numbers = [
            *(c for row in table for c in row),
            x0,
            y0,
            x1,
            y1,
            u,
            v,
            *(c for loop in loops for p in loop for c in p),
        ]
        if not np.isfinite(numbers).all():
            raise OptionError("a patch has numbers that are not finite")
        if not (x0 < x1 and y0 < y1):
            raise OptionError(
                f"the bounds {(x0, y0, x1, y1)} of a patch are empty: give x0, y0, x1, y1 with x0 < x1, y0 < y1"
            )
        if any(len(loop) < 3 for loop in loops):
            raise OptionError("the outline of a patch needs at least three points in each loop")
        if not all(x0 <= x <= x1 and y0 <= y <= y1 for loop in loops for x, y in loop):
            raise OptionError("the outline of a patch leaves its bounds")
        for name, value in (
            ("coefficients", table),
            ("bounds", (x0, y0, x1, y1)),
            ("outline", loops),
            ("origin", (u, v)),
        ):
            object.__setattr__(self, name, value)

    @classmethod
    def of(
        cls,
        function: Callable[[Floats, Floats], Any],
        bounds: tuple[float, float, float, float],
        across: int = 1,
        down: int = 1,
    ) -> list[Patch]:
        """Approximate a smooth function of arrays x and y by `across` x `down` bicubic patches side by side.

        Each interpolates the function at sixteen Chebyshev nodes, so a bicubic function is met exactly. The function
        is called once for each patch. Raises OptionError where it returns numbers that are not finite.
        """
        x0, y0, x1, y1 = bounds
        xs, ys = np.linspace(x0, x1, across + 1), np.linspace(y0, y1, down + 1)
        return [
            _through(function, (left, top, right, bottom))
            for top, bottom in pairwise(ys.tolist())
            for left, right in pairwise(xs.tolist())
        ]

    def table(self) -> Floats:
        """(4, 4) the coefficients, filled up with zeros."""
        table = np.zeros((TERMS, TERMS))
        for i, row in enumerate(self.coefficients):
            table[i, : len(row)] = row
        return table

    def at(self, x: npt.ArrayLike, y: npt.ArrayLike) -> Floats:
        """Depths at points (x, y) in pixels."""
        u, v = self.origin
        found = np.polynomial.polynomial.polyval2d(np.asarray(x, float) - u, np.asarray(y, float) - v, self.table())
        return np.asarray(found, np.float64)

    def loops(self) -> tuple[tuple[tuple[float, float], ...], ...]:
        """The outline's loops; the rectangle of the bounds if no outline was given."""
        x0, y0, x1, y1 = self.bounds
        return self.outline or (((x0, y0), (x1, y0), (x1, y1), (x0, y1)),)

    def range(self) -> tuple[float, float]:
        """Bounds of its depth: the least and the largest Bernstein coefficient over its rectangle."""
        x0, y0, x1, y1 = self.bounds
        u, v = self.origin
        control = _bernstein(x0 - u, x1 - u) @ self.table() @ _bernstein(y0 - v, y1 - v).T
        return float(control.min()), float(control.max())

    def kernel(self, polygon: int) -> KernelPatch:
        """The kernel's form of the patch, which stands for the polygon of this number."""
        return polygon, self.table().tolist(), list(self.origin), list(self.range())


def _bernstein(low: float, high: float) -> Floats:
    """(4, 4) matrix from coefficients of powers of x to Bernstein coefficients on the interval low..high."""
    # Blossoming: coefficient i is the polar form of x^k at 3 - i times the low end and i times the high one.
    ends = [[low] * (3 - i) + [high] * i for i in range(4)]
    return np.array([[1.0, (a + b + c) / 3.0, (a * b + b * c + c * a) / 3.0, a * b * c] for a, b, c in ends])


def _through(function: Callable[[Floats, Floats], Any], bounds: tuple[float, float, float, float]) -> Patch:
    x0, y0, x1, y1 = bounds
    places = np.cos((2 * np.arange(TERMS) + 1) * np.pi / (2 * TERMS))
    middle, half = (0.5 * (x0 + x1), 0.5 * (y0 + y1)), (0.5 * (x1 - x0), 0.5 * (y1 - y0))
    x, y = np.meshgrid(middle[0] + half[0] * places, middle[1] + half[1] * places, indexing="ij")
    try:
        values = np.broadcast_to(np.asarray(function(x, y), np.float64), x.shape)
    except (TypeError, ValueError):
        raise OptionError("the function of a patch must take arrays x and y and yield as many depths") from None
    if not np.isfinite(values).all():
        raise OptionError("the function of a patch yields numbers that are not finite")
    powers = np.vander(places, TERMS, increasing=True)
    scaled = np.linalg.solve(powers, np.linalg.solve(powers, values).T).T
    scale = [np.array([h**-k for k in range(TERMS)]) for h in half]
    table = scaled * scale[0][:, None] * scale[1][None, :]
    return Patch(tuple(tuple(row) for row in table.tolist()), bounds, origin=middle)


def checked_patches(patches: Sequence[tuple[int, Patch]], method: str, variant: str, size: tuple[int, int]) -> None:
    """Raises OptionError if the method cannot draw patches, or if a patch reaches too far beyond the picture."""
    if not patches:
        return
    if not any(method == m and (v is None or variant in ("", v)) for m, v in METHODS):
        known = "; ".join(m for m, _ in METHODS)
        told = f"{method}, {variant}" if variant else method
        raise OptionError(f"{told} cannot draw curved patches: use {known}, or polygons")
    for number, patch in patches:
        x0, y0, x1, y1 = patch.bounds
        if min(x0, y0) < -FARTHEST or x1 > size[0] + FARTHEST or y1 > size[1] + FARTHEST:
            raise OptionError(f"polygon {number}, a patch, reaches more than {FARTHEST:g} pixels beyond the picture")
