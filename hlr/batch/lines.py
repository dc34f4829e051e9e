"""The line of a TOML file in which a value begins.

The parser of the standard library does not tell. So the file is parsed once more, up to more and more of its lines: the
value begins where it is there for the first time.
"""

from __future__ import annotations

import tomllib
from collections.abc import Sequence
from typing import Any


def line_of(text: str, where: Sequence[str | int]) -> int | None:
    """The number of the line, from 1, in which the value begins that these keys lead to; None: there is no such value.

    A number among the keys counts the tables of an array.
    """
    names = [name for name in where if isinstance(name, str)]
    if not names:
        return None
    lines = text.splitlines(keepends=True)
    for number, line in enumerate(lines):
        if names[-1] in line and not _has(_parsed(lines[:number]), where) and _begins(lines, number, where):
            return number + 1
    return None


def _begins(lines: Sequence[str], number: int, where: Sequence[str | int]) -> bool:
    """Whether the value begins in this line, by number from 0: what precedes it is complete without the value."""
    if _parsed(lines[:number]) is None:
        return False
    for end in range(number + 1, len(lines) + 1):
        found = _parsed(lines[:end])
        if found is not None:
            return _has(found, where)
    return False


def _parsed(lines: Sequence[str]) -> Any:
    """The content of these lines; None: they are no TOML by themselves."""
    try:
        return tomllib.loads("".join(lines))
    except (ValueError, RecursionError):
        return None


def _has(found: Any, where: Sequence[str | int]) -> bool:
    for key in where:
        if isinstance(key, int):
            if not isinstance(found, list) or key >= len(found):
                return False
        elif not isinstance(found, dict) or key not in found:
            return False
        found = found[key]
    return True
