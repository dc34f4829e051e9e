"""The keys of a manifest: what each holds, and what it means. What is added to manifests is a row here.

Beside these keys every option of a drawing may be given: the fields of `hlr.Options`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from hlr.common.numbers import is_finite
from hlr.tables.entry import listed
from hlr.tables.projection_methods import PROJECTION_METHODS


@dataclass(frozen=True, slots=True)
class Key:
    """A row: the default, what is allowed in words, whether a value is, and what the key means.

    anywhere  also in a table [[source]]; else only at the top
    """

    default: Any
    allowed: str
    allows: Callable[[Any], bool]
    meaning: str
    anywhere: bool = True


def _is_text(value: Any) -> bool:
    return isinstance(value, str) and bool(value.strip()) and "\0" not in value


def _is_texts(value: Any) -> bool:
    return _is_text(value) or (isinstance(value, list) and bool(value) and all(map(_is_text, value)))


def _is_none_or_texts(value: Any) -> bool:
    return value == [] or _is_texts(value)


def _is_table_of_texts(value: Any) -> bool:
    return isinstance(value, dict) and all(isinstance(text, str) for text in value.values())


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and is_finite(value)


def _is_positive(value: Any) -> bool:
    return _is_number(value) and value > 0.0


def _is_view(value: Any) -> bool:
    return _is_text(value) or (isinstance(value, list) and len(value) == 3 and all(map(_is_number, value)))


def _is_views(value: Any) -> bool:
    return _is_text(value) or (isinstance(value, list) and bool(value) and all(map(_is_view, value)))


def _is_rectangle(value: Any) -> bool:
    return isinstance(value, list) and len(value) == 4 and all(map(_is_number, value))


def _is_parameter(value: Any) -> bool:
    return isinstance(value, str | bool) or _is_number(value)


def _is_matrix(value: Any) -> bool:
    if not isinstance(value, dict):
        return False
    lists = [each if isinstance(each, list) else [each] for each in value.values()]
    return all(name.isidentifier() for name in value) and all(each and all(map(_is_parameter, each)) for each in lists)


_TEXTS = "a text or a list of texts"

KEYS = {
    "output": Key("drawings", "the name of a folder", _is_text, "the folder that is written to", anywhere=False),
    "files": Key([], _TEXTS, _is_none_or_texts, "the sources: names or patterns, such as parts/**/*.step"),
    "exclude": Key([], _TEXTS, _is_none_or_texts, "names or patterns of files that are left out"),
    "views": Key(
        ["front", "top", "right", "iso"],
        "names of views, or directions such as [1, -1, 1]",
        _is_views,
        "the views of each source",
    ),
    "arrange": Key(
        "",
        f"{listed(PROJECTION_METHODS, 'or')}, or an empty text",
        lambda value: isinstance(value, str) and value in ("", *PROJECTION_METHODS),
        "all views of a source on one page, by first-angle or third-angle projection; empty: a page for each view",
    ),
    "template": Key(
        "",
        "the name of an SVG file",
        lambda value: value == "" or _is_text(value),
        "what is printed under arranged views",
    ),
    "texts": Key({}, "a table of texts", _is_table_of_texts, "texts for the fields of the template"),
    "room": Key(
        [],
        "four numbers",
        lambda value: value == [] or _is_rectangle(value),
        "where arranged views may lie on the page: x0, y0, x1, y1 in mm",
    ),
    "formats": Key(["svg"], _TEXTS, _is_texts, "the formats of each view"),
    "name": Key(
        "{folder}/{stem}{variant}-{view}",
        "a text",
        _is_text,
        "the name of a file, without its ending: {folder}, {stem}, {ending}, {view}, {n}, {variant}, and parameters",
    ),
    "parameters": Key(
        {},
        "a table of names with a value, or a list of values, each",
        _is_matrix,
        "parameters of scripts: one variant is drawn for each combination of values",
    ),
    "depends": Key([], _TEXTS, _is_none_or_texts, "files that the sources depend on besides: names or patterns"),
    "time_limit_s": Key(600.0, "a positive number", _is_positive, "seconds after which a source is given up"),
    "total_time_limit_s": Key(
        0.0,
        "a positive number, or 0 for no limit",
        lambda value: _is_number(value) and value >= 0.0,
        "seconds after which the whole run ends, and the next one goes on; 0: it takes as long as it takes",
        anywhere=False,
    ),
    "memory_limit_mb": Key(4000.0, "a positive number", _is_positive, "megabytes above which a source is given up"),
}
"""All keys, in the order in which people are told of them."""


def as_list(value: Any) -> list[Any]:
    """A list as it is; anything else as a list of one."""
    return value if isinstance(value, list) else [value]
