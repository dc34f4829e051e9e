"""Selection of parts: all, only those that patterns name, or all but those."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from difflib import get_close_matches
from fnmatch import fnmatchcase
from typing import Any, Protocol

from hlr.errors import OptionError
from hlr.request.options import Parameter
from hlr.source import open_source
from hlr.source.model import Source

MAX_LISTED = 5
"""Parts that an error names where a pattern matches none."""


class PartSelection(Protocol):
    """The options that select parts."""

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
    def parameters(self) -> Mapping[str, Parameter] | None:
        """Values for variables of a script."""

    @property
    def annotations(self) -> bool:
        """Whether faces of annotation are read as well."""


def open_selected(thing: Any, options: PartSelection) -> Source:
    """Open anything that `open_source` opens, with the selected parts only.

    Raises:
        SourceError: it cannot be opened.
        OptionError: a pattern matches no part, or no part is left.
    """
    source = open_source(thing, options.var, options.annotations, options.parameters)
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
    """Names that match any of the patterns. Raises OptionError for a pattern that matches none."""
    found: set[str] = set()
    for pattern in patterns:
        some = {name for name in names if matches(name, pattern)}
        if not some:
            raise OptionError(f'{option} "{pattern}" matches no part: {_suggestion(pattern, names)}.')
        found |= some
    return found


def matches(name: str, pattern: str) -> bool:
    """Whether a pattern matches the name of a part. Case does not count; * ? and [abc] are wildcards, as in file names.

    The pattern may stand for the whole name, the name without its number (bolt for bolt:2), or an assembly of the part.
    """
    name, pattern = name.lower(), pattern.lower()
    steps = name.split("/")
    candidates = [name, re.sub(r"(:loose)?(:\d+)?$", "", name), *("/".join(steps[:i]) for i in range(1, len(steps)))]
    return any(candidate == pattern or fnmatchcase(candidate, pattern) for candidate in candidates)


def _suggestion(pattern: str, names: Sequence[str]) -> str:
    close = get_close_matches(pattern, names, 3, 0.5)
    if close:
        return "perhaps " + " or ".join(f'"{name}"' for name in close)
    shown = ", ".join(f'"{name}"' for name in names[:MAX_LISTED])
    return f"there are {shown}" + (f" and {len(names) - MAX_LISTED} more" if len(names) > MAX_LISTED else "")
