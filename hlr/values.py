"""Records that hold arrays, compared by value: `==` never raises, and equal records have equal hashes."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

import numpy as np


class ByValue:
    """Base of frozen dataclasses declared with eq=False. Fields declared with compare=False do not count.

    Arrays are equal that have the same shape and the same values, a NaN being equal to a NaN. Fields declared with
    hash=False, such as mappings, count in the comparison alone.
    """

    __slots__ = ()

    __array_ufunc__ = None
    """An array is compared with the record as a whole, not number by number."""

    def __eq__(self, other: object) -> bool:
        if self is other:
            return True
        if type(other) is not type(self):
            return NotImplemented
        return all(same(getattr(self, f.name), getattr(other, f.name)) for f in fields(self) if f.compare)  # type: ignore[arg-type]

    def __hash__(self) -> int:
        counted = (f for f in fields(self) if (f.compare if f.hash is None else f.hash))  # type: ignore[arg-type]
        return hash((type(self), *(_key(getattr(self, f.name)) for f in counted)))


def same(one: Any, other: Any) -> bool:
    """Whether two values are equal; arrays count as a whole."""
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        try:
            a, b = np.asarray(one), np.asarray(other)
            if a.shape != b.shape:
                return False
            unequal = a != b
            return not unequal.any() or bool((np.isnan(a[unequal]) & np.isnan(b[unequal])).all())
        except (TypeError, ValueError):
            return False
    try:
        return bool(one == other)
    except (TypeError, ValueError):
        return False


def _key(value: Any) -> Any:
    """What is hashed of a value: of an array its shape and its numbers, whatever their type."""
    if not isinstance(value, np.ndarray):
        return value
    numbers = value.astype(np.float64) + 0.0  # minus zero equals zero
    numbers[np.isnan(numbers)] = np.nan
    return value.shape, numbers.tobytes()
