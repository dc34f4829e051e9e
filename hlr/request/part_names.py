"""Patterns of parts: as the options `only` and `hide` take them, and styles."""

from __future__ import annotations

import re
from fnmatch import fnmatchcase


def matches(name: str, pattern: str) -> bool:
    """Whether a pattern matches the name of a part. Case does not count; * ? and [abc] are wildcards, as in file names.

    The pattern may stand for the whole name, the name without its number (bolt for bolt:2), or an assembly of the part.
    """
    name, pattern = name.lower(), pattern.lower()
    steps = name.split("/")
    candidates = [name, without_number(name), *("/".join(steps[:i]) for i in range(1, len(steps)))]
    return any(candidate == pattern or fnmatchcase(candidate, pattern) for candidate in candidates)


def without_number(name: str) -> str:
    """The name that equal parts share: bolt for bolt:2."""
    return re.sub(r"(:loose)?(:\d+)?$", "", name)
