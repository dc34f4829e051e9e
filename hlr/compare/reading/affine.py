"""Affine maps of the plane: what a transform of SVG does, and the way from a file's coordinates to paper."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass

from hlr.compare.lines.sketch import Pair


@dataclass(frozen=True, slots=True)
class Affine:
    """(x, y) becomes (a x + c y + e, b x + d y + f), as in SVG's `matrix(a, b, c, d, e, f)`."""

    a: float = 1.0
    b: float = 0.0
    c: float = 0.0
    d: float = 1.0
    e: float = 0.0
    f: float = 0.0

    def point(self, at: Pair) -> Pair:
        """Where a point comes to lie."""
        x, y = at
        return self.a * x + self.c * y + self.e, self.b * x + self.d * y + self.f

    def way(self, along: Pair) -> Pair:
        """What a vector becomes."""
        x, y = along
        return self.a * x + self.c * y, self.b * x + self.d * y

    def after(self, first: Affine) -> Affine:
        """Both, `first` first."""
        e, f = self.point((first.e, first.f))
        return Affine(*self.way((first.a, first.b)), *self.way((first.c, first.d)), e, f)


Y_UP = Affine(d=-1.0)
"""From millimetres with y down to millimetres with y up."""


def scaling(x: float, y: float | None = None) -> Affine:
    """x times as wide and y times as high."""
    return Affine(a=x, d=x if y is None else y)


def _rotation(degrees: float, x: float = 0.0, y: float = 0.0) -> Affine:
    turn = math.radians(degrees)
    c, s = math.cos(turn), math.sin(turn)
    return Affine(e=x, f=y).after(Affine(c, s, -s, c)).after(Affine(e=-x, f=-y))


_ACTION = re.compile(r"\s*,?\s*([a-zA-Z]+)\s*\(([^()]*)\)")
_ACTIONS: dict[str, tuple[tuple[int, ...], Callable[..., Affine]]] = {
    "matrix": ((6,), Affine),
    "translate": ((1, 2), lambda x, y=0.0: Affine(e=x, f=y)),
    "scale": ((1, 2), scaling),
    "rotate": ((1, 3), _rotation),
    "skewX": ((1,), lambda degrees: Affine(c=math.tan(math.radians(degrees)))),
    "skewY": ((1,), lambda degrees: Affine(b=math.tan(math.radians(degrees)))),
}


def transform_of(text: str) -> Affine:
    """The map that SVG's attribute `transform` says. Raises ValueError where it says none."""
    found, end = Affine(), 0
    for action in _ACTION.finditer(text):
        numbers = [float(each) for each in action[2].replace(",", " ").split()]
        counts, made = _ACTIONS.get(action[1], ((), scaling))
        if action.start() != end or len(numbers) not in counts:
            break
        found, end = found.after(made(*numbers)), action.end()
    if text[end:].strip():
        raise ValueError(f'"{text[:60]}" is no transform')
    return found
