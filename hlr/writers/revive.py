"""Records from JSON: a value is checked against a type and converted to it."""

from __future__ import annotations

import types
from collections.abc import Mapping
from dataclasses import MISSING, fields, is_dataclass
from functools import cache
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

import numpy as np


def revived(kind: Any, value: Any, what: str) -> Any:  # noqa: PLR0911 - one answer for each type of value
    """A value from JSON as a `kind`: a number, text, tuple, mapping, array, or a dataclass of these.

    Raises ValueError, which says what `what` should be.
    """
    origin, arguments = get_origin(kind), get_args(kind)
    if is_dataclass(kind) and isinstance(kind, type):
        return _record(kind, value, what)
    if origin in (Union, types.UnionType):
        if value is None and type(None) in arguments:
            return None
        return revived(next(a for a in arguments if a is not type(None)), value, what)
    if origin is Literal:
        return value if value in arguments else _refuse(what, f"one of {', '.join(map(str, arguments))}")
    if origin is np.ndarray:
        return array(value, get_args(arguments[1])[0], what)
    if origin is tuple:
        return _tuple(arguments, value, what)
    if origin is not None and issubclass(origin, Mapping):
        found = value if isinstance(value, dict) else _refuse(what, "an object")
        return {str(key): revived(arguments[1], each, f"{what}.{key}") for key, each in found.items()}
    if kind is float:
        return float(value) if type(value) in (int, float) else _refuse(what, "a number")
    return value if type(value) is kind else _refuse(what, _NAMES.get(kind, kind.__name__))


_NAMES = {int: "a whole number", str: "text", bool: "true or false"}


def array(value: Any, kind: Any, what: str, width: int | None = None) -> np.ndarray[Any, Any]:
    """Nested lists of numbers as an array, read-only; width: of a list of points, how many numbers each has."""
    try:
        found = np.array(value, kind)
    except (TypeError, ValueError, OverflowError):
        _refuse(what, "an array of numbers")
    if width is not None and (found.ndim != 2 or found.shape[1] != width):
        _refuse(what, f"a list of points of {width} numbers")
    found.flags.writeable = False
    return found


def _record(kind: Any, value: Any, what: str) -> Any:
    if not isinstance(value, dict):
        _refuse(what, "an object")
    hints, given = _hints(kind), {}
    for f in fields(kind):
        if f.name in value:
            given[f.name] = revived(hints[f.name], value[f.name], f"{what}.{f.name}")
        elif f.default is MISSING and f.default_factory is MISSING:
            _refuse(what, f"an object with {f.name!r}")
    return kind(**given)


def _tuple(kinds: tuple[Any, ...], value: Any, what: str) -> tuple[Any, ...]:
    several = kinds[-1] is Ellipsis
    if not isinstance(value, list) or not (several or len(value) == len(kinds)):
        _refuse(what, "a list" if several else f"a list of {len(kinds)}")
    each = [kinds[0]] * len(value) if several else kinds
    return tuple(revived(k, v, f"{what}[{i}]") for i, (k, v) in enumerate(zip(each, value, strict=True)))


@cache
def _hints(kind: Any) -> dict[str, Any]:
    return get_type_hints(kind)


def _refuse(what: str, wanted: str) -> Any:
    raise ValueError(f"{what} should be {wanted}")
