"""Patterns of parts: as the options `only` and `hide` take them, and styles."""

from __future__ import annotations

import re
from fnmatch import translate
from functools import lru_cache


def matches(name: str, pattern: str) -> bool:
    """Whether a pattern matches the name of a part. Case does not count; * ? and [abc] are wildcards, as in file names.

    The pattern may stand for the whole name, the name without its number (bolt for bolt:2), or an assembly of the part.
    Of a name that says its assemblies (trolley/axle/wheel) it may leave out the first ones: wheel, or axle.
    """
    return _expression(pattern.lower()).match(name.lower()) is not None


@lru_cache(maxsize=1000)
def _expression(pattern: str) -> re.Pattern[str]:
    """What the names look like that a pattern matches, in small letters."""
    wild = translate(pattern)
    wild = wild[wild.index(":") + 1 : wild.rindex(")")]
    return re.compile(rf"(?s:(?:.*/)?(?:{re.escape(pattern)}|{wild})(?:(?::loose)?(?::\d+)?|/.*))\Z")


def without_number(name: str) -> str:
    """The name that equal parts share: bolt for bolt:2."""
    return re.sub(r"(:loose)?(:\d+)?$", "", name)
