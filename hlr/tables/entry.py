"""Entries of the tables: what a row calls, imported when it is called."""

from __future__ import annotations

from collections import UserDict
from collections.abc import Callable, Iterable
from functools import wraps
from importlib import import_module
from types import ModuleType
from typing import Any, TypeVar

Row = TypeVar("Row")
Derived = TypeVar("Derived")


class Table(UserDict[str, Row]):
    """Rows by name. What is derived from them is worked out once, and anew after a row was added or taken out."""

    def __init__(self, rows: Iterable[tuple[str, Row]]) -> None:
        self._kept: dict[Callable[[], Any], Any] = {}
        super().__init__(rows)

    def __setitem__(self, name: str, row: Row) -> None:
        self._kept.clear()
        super().__setitem__(name, row)

    def __delitem__(self, name: str) -> None:
        self._kept.clear()
        super().__delitem__(name)

    def derived(self, make: Callable[[], Derived]) -> Callable[[], Derived]:
        """Decorates a function of the table alone; its result must not be changed, for all callers get the same."""

        @wraps(make)
        def found() -> Derived:
            try:
                kept: Derived = self._kept[make]
            except KeyError:
                kept = self._kept[make] = make()
            return kept

        return found


_IMPORTED: dict[str, ModuleType] = {}
"""Modules that were imported to the end: asking the import system again takes ten times as long."""


def called(entry: str) -> Callable[..., Any]:
    """The function that "module:function" names."""
    path, _, name = entry.partition(":")
    module = _IMPORTED.get(path)
    if module is None:
        module = _IMPORTED[path] = import_module(path)
    found: Callable[..., Any] = getattr(module, name)
    return found


def listed(words: Iterable[str], last: str) -> str:
    """Words for people: a, b and c. last: the word before the last one."""
    *most, end = words
    return f"{', '.join(most)} {last} {end}" if most else end
