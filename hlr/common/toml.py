"""TOML files that may be hostile."""

from __future__ import annotations

from typing import Any

MOST_DOTS = 1000
"""Points in one line. The reader's time grows with the square of the names in a key: 40,000 take half a minute."""


def parsed(text: str) -> dict[str, Any]:
    """The tables of a TOML text. Raises ValueError for what is none, RecursionError for what is nested too deep."""
    import tomllib

    for number, line in enumerate(text.splitlines(), 1):
        if line.partition("#")[0].count(".") > MOST_DOTS:
            raise ValueError(f"line {number} has more than {MOST_DOTS} points, which no key needs")
    return tomllib.loads(text)
