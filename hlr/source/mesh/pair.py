"""Pairs (vertices, faces) of number tables, told from lists of anything else."""

from __future__ import annotations

from numbers import Number
from typing import Any


def is_pair(thing: Any) -> bool:
    """Whether this is a pair of number tables, without asking CAD objects to become arrays.

    A list of two such pairs is none: its numbers are one level further down.
    """
    return isinstance(thing, tuple | list) and len(thing) == 2 and all(map(_is_table, thing))


def _is_table(item: Any) -> bool:
    """An array, or a list that begins with a row: all rows of a large mesh would take long to look at."""
    return hasattr(item, "dtype") or (isinstance(item, list | tuple) and bool(item) and _is_row(item[0]))


def _is_row(row: Any) -> bool:
    """A list that begins with a number, or an array of numbers; not a table. Texts are no numbers, as is said later."""
    if isinstance(row, list | tuple):
        return not row or isinstance(row[0], Number | str | bytes) or getattr(row[0], "ndim", 1) == 0
    return hasattr(row, "dtype") and getattr(row, "ndim", 0) < 2
