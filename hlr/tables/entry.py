"""Entries of the tables: what a row calls, imported when it is called."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from importlib import import_module
from typing import Any


def called(entry: str) -> Callable[..., Any]:
    """The function that "module:function" names."""
    module, _, name = entry.partition(":")
    found: Callable[..., Any] = getattr(import_module(module), name)
    return found


def listed(words: Iterable[str], last: str) -> str:
    """Words for people: a, b and c. last: the word before the last one."""
    *most, end = words
    return f"{', '.join(most)} {last} {end}" if most else end
