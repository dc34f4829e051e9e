"""Functions whose keywords are the fields of a record: `help` shows them, and a wrong one is refused in a sentence."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from difflib import get_close_matches
from inspect import Parameter, signature
from typing import Any, TypeVar

from hlr.errors import OptionError

Record = TypeVar("Record")
Function = TypeVar("Function", bound=Callable[..., Any])

_LISTED = 25
"""Names that a sentence may list."""


def record_of(kind: type[Record], keywords: Mapping[str, Any], function: str, own: Sequence[str] = ("view",)) -> Record:
    """The record with these fields. Raises OptionError for an unknown keyword, and names the nearest known one.

    own: parameters of the function that are no fields
    """
    fields = kind.__dataclass_fields__  # type: ignore[attr-defined]
    for name in keywords:
        if name not in fields:
            known = list(fields)
            near = get_close_matches(name, [*known, *own], 1)
            others = f"use {', '.join(known)}" if len(known) <= _LISTED else f"help({function}) lists its {len(known)}"
            advice = f"did you mean {near[0]}?" if near else others
            raise OptionError(f"{function}() has no option {name!r}: {advice}")
    return kind(**keywords)


def expect_record(
    kind: type[Record], given: Record | None, function: str, keywords: Mapping[str, Any] | None = None
) -> Record:
    """The record that was given, or one with these fields, or of the defaults.

    Raises OptionError for anything else, such as a dictionary, for both at once, and for an unknown keyword.
    """
    if keywords:
        if given is not None:
            raise OptionError(
                f"{function}() has its options in hlr.{kind.__name__} and {', '.join(keywords)} besides: "
                "put all of them into one, or give all as keywords"
            )
        return record_of(kind, keywords, function, ("views",))
    if given is None:
        return kind()
    if not isinstance(given, kind):
        name = f"hlr.{kind.__name__}"
        raise OptionError(f"{function}() needs {name} for its options, not {type(given).__name__}: write {name}(...)")
    return given


def shown(kind: type) -> Callable[[Function], Function]:
    """Let `help` show the fields of `kind` in place of a function's **keywords."""

    def named(function: Function) -> Function:
        found = signature(function)
        own = [p for p in found.parameters.values() if p.kind is not Parameter.VAR_KEYWORD]
        more = [p.replace(kind=Parameter.KEYWORD_ONLY) for p in signature(kind).parameters.values()]
        function.__signature__ = found.replace(parameters=[*own, *more])  # type: ignore[attr-defined]
        return function

    return named
