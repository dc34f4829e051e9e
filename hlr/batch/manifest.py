"""The manifest of a batch: `hlr.toml`, or the table [tool.hlr] of `pyproject.toml`.

Its top holds what all sources share. Each table [[source]] names some sources, and what is different for them; without
such a table the top names them itself.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path
from typing import Any

from hlr.batch.lines import line_of
from hlr.batch.request import NAMES
from hlr.batch.schema import KEYS
from hlr.common.toml import parsed
from hlr.errors import OptionError, respelled
from hlr.tables.projection_methods import PROJECTION_METHODS
from hlr.tables.writers import WRITERS, formats

FILE, PROJECT = "hlr.toml", "pyproject.toml"
_IN_PROJECT = ("tool", "hlr")
"""Keys of the table of a project that is the manifest."""

_TABLE = "source"
_LARGEST = 1_000_000
"""Bytes: a larger file is no manifest."""

Where = tuple[str | int, ...]
"""Keys that lead to a value."""


@dataclass(frozen=True, slots=True)
class Rule:
    """Some sources, and what is asked of them: a value for each key of the schema, and options of drawings.

    where: keys that lead to its table in the manifest.
    own: the keys of that table; others come from the top.
    """

    values: Mapping[str, Any]
    options: Mapping[str, Any]
    where: Where = ()
    own: frozenset[str] = frozenset()


@dataclass(frozen=True, slots=True)
class Manifest:
    """What is asked of a batch.

    root                the folder that patterns start from
    file                the manifest's own; None: there is none
    text                of that file
    total_time_limit_s  seconds after which a run ends; 0: there is no limit
    """

    root: Path
    output: str
    rules: tuple[Rule, ...]
    file: Path | None = None
    text: str = ""
    total_time_limit_s: float = 0.0

    def error(self, where: Where, message: str) -> OptionError:
        """An error about a value of the manifest: it names the file, the line and the key."""
        if self.file is None:
            return OptionError(message)
        return _error(self.file, self.text, where, message)


def without_file(root: Path, **given: Any) -> Manifest:
    """The manifest of a batch that has no file. given: values of keys."""
    return manifest_of({name: value for name, value in given.items() if value}, root)


def find(folder: Path) -> Path | None:
    """The manifest in a folder; None: there is none."""
    if os.path.isfile(folder / FILE):
        return folder / FILE
    project = folder / PROJECT
    if os.path.isfile(project):
        try:
            tools = parsed(project.read_text("utf-8-sig")).get("tool")
            if isinstance(tools, dict) and "hlr" in tools:
                return project
        except (OSError, ValueError, RecursionError):  # another program's file, which that one complains about
            return None
    return None


def read(file: Path, **given: Any) -> Manifest:
    """The manifest in a file. given: values of keys that take the place of those in it, where there are any.

    Raises OptionError, with line and key, for whatever is wrong in it.
    """
    try:
        if file.stat().st_size > _LARGEST:
            raise OptionError(f"{file} is no manifest: it is larger than {_LARGEST / 1e6:g} MB")
        text = file.read_text("utf-8-sig")
        found = parsed(text)
    except OSError as error:
        raise OptionError(f"{file} cannot be read: {(error.strerror or str(error)).lower()}") from None
    except UnicodeDecodeError:
        raise OptionError(f"{file} is no text in UTF-8: save it as UTF-8") from None
    except (ValueError, RecursionError) as error:  # TOMLDecodeError says the line
        raise OptionError(f"{file} is no TOML: {error}") from None
    prefix = _IN_PROJECT if file.name == PROJECT else ()
    for name in prefix:
        if not isinstance(found, dict) or name not in found:
            raise OptionError(f"{file} has no table [tool.hlr]: write one, or name a folder or models")
        found = found[name]
    return manifest_of(found, file.resolve().parent, file, text, prefix, given)


def manifest_of(
    found: Any,
    root: Path,
    file: Path | None = None,
    text: str = "",
    prefix: Where = (),
    given: Mapping[str, Any] | None = None,
) -> Manifest:
    """The manifest of the parsed content of a file. Raises OptionError."""

    def wrong(where: Where, message: str) -> OptionError:
        return OptionError(message) if file is None else _error(file, text, (*prefix, *where), message)

    if not isinstance(found, dict):
        raise wrong((), "a table is needed")
    tables = found.get(_TABLE, [])
    if not isinstance(tables, list) or not all(isinstance(table, dict) for table in tables):
        raise wrong((_TABLE,), f"write [[{_TABLE}]] with double brackets")
    top = {name: value for name, value in found.items() if name != _TABLE}
    _check(top, (), wrong)
    instead = {name: value for name, value in (given or {}).items() if value}
    top |= instead
    rules = []
    for number, table in enumerate(tables):
        _check(table, (_TABLE, number), wrong)
        if "files" not in table:
            raise wrong((_TABLE, number), f"this [[{_TABLE}]] names no files")
        rules.append(_rule({**top, **table, **instead}, (*prefix, _TABLE, number), table))
    output, limit = (top.get(name, KEYS[name].default) for name in ("output", "total_time_limit_s"))
    return Manifest(root, output, tuple(rules) or (_rule(top, prefix, top),), file, text, float(limit))


def _check(table: Mapping[str, Any], where: Where, wrong: Any) -> None:
    """Raise an error for an unknown key, or a value that its key does not allow."""
    known = [name for name, key in KEYS.items() if key.anywhere or not where]
    for name, value in table.items():
        if name not in (*known, *NAMES):
            if name in KEYS:
                raise wrong((*where, name), "it belongs to the top, before the first table")
            if name == _IN_PROJECT[0]:
                raise wrong((*where, name), f"tables [tool] belong to {PROJECT}: write keys without [tool.hlr] here")
            near = get_close_matches(name, (*known, *NAMES, _TABLE), 1)
            advice = f"did you mean {near[0]}?" if near else f"use {', '.join(known)}, or an option of hlr.Options"
            raise wrong((*where, name), f"there is no such key: {advice}")
        if name in KEYS and not KEYS[name].allows(value):
            raise wrong((*where, name), f"{KEYS[name].allowed} is needed, not {value!r}")
        if name == "formats":
            for format in value if isinstance(value, list) else [value]:
                if format not in WRITERS:
                    raise wrong((*where, name), f"there is no format {format!r}: use {formats()}")


def _rule(table: Mapping[str, Any], where: Where, own: Mapping[str, Any]) -> Rule:
    values = {name: table.get(name, key.default) for name, key in KEYS.items()}
    if values["arrange"] and "views" not in table:
        values["views"] = list(PROJECTION_METHODS[values["arrange"]].usual)
    # Parameters are a matrix of variants here, and each variant's own values in the options of its job.
    options = {name: value for name, value in table.items() if name not in KEYS}
    return Rule(values, options, where, frozenset(own))


def _error(file: Path, text: str, where: Where, message: str) -> OptionError:
    line = line_of(text, where)
    place = f"{file.name}, line {line}" if line else file.name
    own = where[len(_IN_PROJECT) :] if file.name == PROJECT else where
    key = ".".join(name for name in own if isinstance(name, str))
    # An option is named as a key of the file.
    return OptionError(f"{place}{', ' + key if key else ''}: {respelled(message, str)}")
