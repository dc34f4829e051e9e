"""Selection of parts: all, only those that patterns name, or all but those."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from difflib import get_close_matches
from typing import Any, Protocol

from hlr.errors import OptionError
from hlr.request.options import Parameter
from hlr.request.part_names import matches, without_number
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

    @property
    def hidden_objects(self) -> bool:
        """Whether objects that a document hides are read as well."""


def open_selected(thing: Any, options: PartSelection) -> Source:
    """Open anything that `open_source` opens, with the selected parts only.

    Raises:
        SourceError: it cannot be opened.
        OptionError: a pattern matches no part, or no part is left.
    """
    source = open_whole(thing, options)
    only, hide = tuple(options.only), tuple(options.hide)
    if not (only or hide) or getattr(source, "choice", None) == (only, hide):
        return source
    names = source.names()
    kept = set(names) if not only else matching(only, source, "only")
    kept -= matching(hide, source, "hide")
    if not kept:
        why = "do not hide its only part" if len(names) == 1 else f"hide fewer of its {len(names)} parts"
        if only and len(names) > 1:
            why = "`hide` takes all that `only` chooses"
        raise OptionError(f"Of {source.name} no part would be left: {why}.")
    return source.of_parts(kept, (only, hide))


def open_whole(thing: Any, options: PartSelection) -> Source:
    """Open anything that `open_source` opens, with all parts. Raises SourceError where it cannot be opened."""
    return open_source(thing, options.var, options.annotations, options.parameters, options.hidden_objects)


def also_called(source: Source) -> Mapping[str, tuple[str, ...]]:
    """By the names of parts, further names that patterns stand for: of their assemblies, and of their places there."""
    if not hasattr(source, "also_called"):
        return {}
    found: Mapping[str, tuple[str, ...]] = source.also_called()
    return found


def matching(patterns: Sequence[str], source: Source, option: str) -> set[str]:
    """Names of parts of a source that match any of the patterns, or are in an assembly that does.

    Raises OptionError for a pattern that matches none.
    """
    names, above = source.names(), also_called(source)
    found: set[str] = set()
    for pattern in patterns:
        some = {name for name in names if any(matches(each, pattern) for each in (name, *above.get(name, ())))}
        if not some:
            known = list(dict.fromkeys((*names, *(each for assemblies in above.values() for each in assemblies))))
            raise OptionError(f'`{option}` "{pattern}" matches no part: {suggestion(pattern, known)}.')
        found |= some
    return found


def unmatched(patterns: Sequence[str], source: Source) -> list[str]:
    """Those of the patterns that `matching` would refuse."""
    missed = []
    for pattern in dict.fromkeys(patterns):
        try:
            matching([pattern], source, "")
        except OptionError:
            missed.append(pattern)
    return missed


def suggestion(pattern: str, names: Sequence[str]) -> str:
    """The names that come nearest to a pattern, else the first ones that there are: the end of a sentence."""
    if ":" not in pattern:
        names = list(dict.fromkeys(map(without_number, names)))
    close = get_close_matches(pattern, names, 3, 0.5)
    if close:
        return "perhaps " + " or ".join(f'"{name}"' for name in close)
    shown = ", ".join(f'"{name}"' for name in names[:MAX_LISTED])
    return f"there are {shown}" + (f" and {len(names) - MAX_LISTED} more" if len(names) > MAX_LISTED else "")
