"""Which parts of a source are drawn: all, only those named, or all but those named."""

from __future__ import annotations

import re
from collections.abc import Sequence
from difflib import get_close_matches
from fnmatch import fnmatchcase
from typing import Any, Protocol

from hlr.errors import OptionError
from hlr.source import open_source
from hlr.source.model import Source

_NAMED = 5
"""So many parts are named where a pattern matches none."""


class PartSelection(Protocol):
    """The options that choose what is drawn."""

    @property
    def only(self) -> Sequence[str]:
        """Patterns of parts."""

    @property
    def hide(self) -> Sequence[str]:
        """Patterns of parts."""

    @property
    def var(self) -> str | None:
        """Variable of a script."""

    @property
    def annotations(self) -> bool:
        """Also faces of annotation."""


def open_selected(thing: Any, options: PartSelection) -> Source:
    """Open whatever `open_source` opens, and leave out what the options leave out.

    Raises SourceError; OptionError for a pattern that matches no part, and where no part would be left.
    """
    source = open_source(thing, options.var, options.annotations)
    only, hide = tuple(options.only), tuple(options.hide)
    if not (only or hide) or getattr(source, "choice", None) == (only, hide):
        return source
    names = source.names()
    kept = set(names) if not only else _matching(only, names, "only")
    kept -= _matching(hide, names, "hide")
    if not kept:
        raise OptionError(f"Of {source.name} no part would be left: hide fewer of its {len(names)} parts.")
    return source.of_parts(kept, (only, hide))


def _matching(patterns: Sequence[str], names: Sequence[str], option: str) -> set[str]:
    """Names that match any of the patterns; each must match some."""
    found: set[str] = set()
    for pattern in patterns:
        some = {name for name in names if matches(name, pattern)}
        if not some:
            raise OptionError(f'{option} "{pattern}" matches no part: {_instead(pattern, names)}.')
        found |= some
    return found


def matches(name: str, pattern: str) -> bool:
    """Whether a pattern means a part: letters of any case, * and ? and [abc] as in file names.

    It may be the whole name, the name without its number (bolt for bolt:2), or an assembly that the part is in.
    """
    name, pattern = name.lower(), pattern.lower()
    steps = name.split("/")
    meant = [name, re.sub(r"(:loose)?(:\d+)?$", "", name), *("/".join(steps[:i]) for i in range(1, len(steps)))]
    return any(each == pattern or fnmatchcase(each, pattern) for each in meant)


def _instead(pattern: str, names: Sequence[str]) -> str:
    close = get_close_matches(pattern, names, 3, 0.5)
    if close:
        return "perhaps " + " or ".join(f'"{name}"' for name in close)
    shown = ", ".join(f'"{name}"' for name in names[:_NAMED])
    return f"there are {shown}" + (f" and {len(names) - _NAMED} more" if len(names) > _NAMED else "")
