"""Records with arrays, compared by value; and sequences whose records are made on first use."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import fields
from typing import Any, TypeVar, overload

import numpy as np

R = TypeVar("R")


class ByValue:
    """Base of frozen dataclasses declared with eq=False. Fields declared with compare=False do not count.

    Arrays are equal if they have the same shape and the same values; NaN equals NaN. Fields declared with hash=False,
    such as mappings, count in comparisons but not in the hash.
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


class LateRecords(Sequence[R]):
    """A sequence whose records are made on first use. It equals a tuple of the same records.

    It is pickled and copied as that tuple.
    """

    __slots__ = ("_known",)

    def __init__(self) -> None:
        self._known: tuple[R, ...] | None = None

    @abstractmethod
    def made(self) -> tuple[R, ...]:
        """All of them; called once."""

    @property
    def records(self) -> tuple[R, ...]:
        """All of them."""
        if self._known is None:
            self._known = self.made()
        return self._known

    def __len__(self) -> int:
        return len(self.records)

    def __iter__(self) -> Iterator[R]:
        return iter(self.records)

    @overload
    def __getitem__(self, index: int) -> R: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[R, ...]: ...
    def __getitem__(self, index: int | slice) -> R | tuple[R, ...]:
        return self.records[index]

    def __eq__(self, other: object) -> bool:
        if isinstance(other, LateRecords):
            return self is other or self.records == other.records
        return self.records == other if isinstance(other, tuple) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.records)

    def __repr__(self) -> str:
        return repr(self.records)

    def __reduce__(self) -> tuple[Any, ...]:
        return tuple, (self.records,)
