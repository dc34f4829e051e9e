"""Styles as people write them: the name of a built-in one, a TOML file, or the same tables in Python.

A file says what differs from a built-in style. Nothing in it is run, and it has to be small.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import replace
from difflib import get_close_matches
from pathlib import Path
from typing import Any

from hlr.common.toml import parsed
from hlr.errors import OptionError, respelled
from hlr.request.style import LineRule, Style
from hlr.request.style_check import checked_color
from hlr.request.styles import STYLES
from hlr.tables.entry import listed
from hlr.tables.line_classes import LINE_CLASSES

LARGEST = 100_000
"""Bytes of a file."""

MOST_RULES = 1000

PEN = ("width", "color", "dash", "cap")
"""Keys of a rule for lines."""

WHOLE = ("wide", "narrow", "background", "layers", "part-colors", "size", "dpi", "dxf")
"""Keys of the style itself."""

SCOPES: dict[str, bool | None] = {"lines": None, "visible": True, "hidden": False}
"""Tables of rules: for all lines, visible ones, hidden ones."""

StyleLike = str | os.PathLike[str] | Mapping[str, Any] | Style
"""What `style_of` takes."""


def style_of(asked: StyleLike | None) -> Style:
    """The style of this name, of a TOML file, or of the tables of one.

    Raises OptionError that names the file and the key, and says what is allowed.
    """
    if asked is None:
        return STYLES["iso"]
    if isinstance(asked, Style):
        return asked
    if isinstance(asked, Mapping):
        return from_tables(asked, "the style")
    if not isinstance(asked, (str, os.PathLike)):
        raise OptionError(f"style needs {_names()}, a TOML file or an hlr.Style, not {asked!r}")
    if isinstance(asked, str) and asked.strip().lower() in STYLES:
        return STYLES[asked.strip().lower()]
    path = file_of(asked)
    if path is None and _is_file(asked):
        raise OptionError(f"the style {asked} is a file that does not end in .toml: rename it")
    if path is None:
        raise OptionError(f"there is no style {str(asked)!r}: give {_names()}, or a file that ends in .toml")
    return from_tables(_read(path), f"the style {path.name}")


def file_of(asked: str | os.PathLike[str]) -> Path | None:
    """The file that a style's name stands for; None: it is no file."""
    path = Path(asked)
    return path if path.suffix.lower() == ".toml" else None


def _is_file(asked: str | os.PathLike[str]) -> bool:
    with suppress(OSError, ValueError):
        return Path(asked).is_file()
    return False


def from_tables(tables: Mapping[str, Any], where: str) -> Style:
    """The style that a TOML file describes; where: what errors call it. Raises OptionError."""
    asked = {_key(key): value for key, value in tables.items()}
    base = asked.pop("base", "iso")
    if base not in STYLES:
        raise OptionError(f"{where}: base is {_names()}, not {base!r}")
    whole: dict[str, Any] = {}
    rules: list[LineRule] = []
    for key, value in asked.items():
        if key in WHOLE:
            whole[key.replace("-", "_")] = value
        elif key in SCOPES:
            rules += _rules(value, where, key, visible=SCOPES[key])
        elif key == "parts":
            for pattern, table in _table(value, where, key).items():
                rules += _rules(table, where, f'parts."{pattern}"', parts=str(pattern))
        else:
            raise OptionError(f"{where}: {_unknown(key, ('base', *WHOLE, *SCOPES, 'parts'))}")
    if len(rules) > MOST_RULES:
        raise OptionError(f"{where} has {len(rules)} rules for lines: {MOST_RULES} are the most")
    start = STYLES[base]
    if whole.get("wide") is not None and "narrow" not in whole:
        whole["narrow"] = None
    with _naming(where):
        return replace(start, lines=(*start.lines, *rules), **whole)


def overridden(
    style: Style,
    line_width: float | None = None,
    color: str | None = None,
    hidden_color: str | None = None,
    **whole: Any,
) -> Style:
    """The style with single values in place of all that it says about them.

    line_width: millimetres of wide lines, narrow ones are half as wide; color: of all lines; hidden_color: of hidden
    ones; whole: other fields of the style. Raises OptionError for a value that is not allowed.
    """
    lines = style.lines
    if line_width is not None:
        named = (None, "wide", "narrow")
        lines = tuple(rule if rule.width in named else replace(rule, width=None) for rule in lines)
        whole |= {"wide": line_width, "narrow": None}
    if color is not None:
        lines = (*(replace(rule, color=None) for rule in lines), LineRule(color=color))
    if hidden_color is not None:
        hidden_color = checked_color("hidden_color", hidden_color)
        lines = (*_visible_colors(lines), LineRule(visible=False, color=hidden_color))
    return replace(style, lines=lines, **whole)


def _visible_colors(lines: tuple[LineRule, ...]) -> Iterator[LineRule]:
    """The same rules; none but the most general says the colour of hidden lines."""
    for rule in sorted(lines, key=lambda rule: rule.weight):
        if rule.visible or rule.color is None or rule.weight == 0:
            yield rule
            continue
        yield replace(rule, color=None)
        if rule.visible is None:
            yield LineRule(visible=True, kind=rule.kind, parts=rule.parts, color=rule.color)


def _rules(
    value: Any, where: str, key: str, parts: str | None = None, visible: bool | None = None, kind: Any = None
) -> Iterator[LineRule]:
    """The rules of a table and of the tables in it, the table's own first."""
    own: dict[str, Any] = {}
    inner: list[tuple[Any, str, bool | None, str | None]] = []
    for raw, entry in _table(value, where, key).items():
        name = _key(raw)
        if name in PEN:
            own[name] = entry
        elif name in LINE_CLASSES and kind is None:
            inner.append((entry, f"{key}.{name}", visible, name))
        elif SCOPES.get(name) is not None and parts is not None and visible is None and kind is None:
            inner.append((entry, f"{key}.{name}", SCOPES[name], None))
        else:
            known = [*PEN, *(() if kind else LINE_CLASSES)]
            known += ["visible", "hidden"] if parts is not None and visible is None and kind is None else []
            raise OptionError(f"{where}: in [{key}] {_unknown(name, tuple(known))}")
    if own:
        with _naming(f"{where}: [{key}]"):
            yield LineRule(visible=visible, kind=kind, parts=parts, **own)
    for entry, deeper, seen, of_class in inner:
        yield from _rules(entry, where, deeper, parts, seen, of_class)


def _read(path: Path) -> dict[str, Any]:
    try:
        with path.open("rb") as file:
            data = file.read(LARGEST + 1)
    except OSError as error:
        raise OptionError(f"the style {path} cannot be read: {error.strerror or error}") from None
    except ValueError as error:
        raise OptionError(f"the style {path} cannot be read: {error}") from None
    if len(data) > LARGEST:
        raise OptionError(f"the style {path} is larger than {LARGEST // 1000} kB, which no style needs")
    try:
        return parsed(data.decode("utf-8-sig"))
    except UnicodeDecodeError:
        raise OptionError(f"the style {path.name} is no text in UTF-8: save it as UTF-8") from None
    except (ValueError, RecursionError) as error:
        raise OptionError(f"the style {path.name} is no TOML: {error}") from None


def _table(value: Any, where: str, key: str) -> Mapping[str, Any]:
    if not isinstance(value, Mapping):
        raise OptionError(f"{where}: {key} is a table, such as [{key}], not {value!r}")
    return value


def _key(key: Any) -> str:
    """Part_Colors and part-colors are the same key."""
    return str(key).lower().replace("_", "-")


def _unknown(key: str, known: tuple[str, ...]) -> str:
    near = get_close_matches(key, known, 1)
    return f"there is no key {key!r}: " + (f"did you mean {near[0]}?" if near else f"use {listed(known, 'or')}")


def _names() -> str:
    return listed(STYLES, "or")


@contextmanager
def _naming(where: str) -> Iterator[None]:
    """Errors about a value say where it stands, and name its key as it is."""
    try:
        yield
    except OptionError as error:
        raise OptionError(f"{where}: {respelled(str(error), _key)}") from None
