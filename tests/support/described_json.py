"""The tables of a page that describes JSON documents, and a check of documents against them, key by key."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

OTHERS = "any other"
"""Stands in place of a key: for all names that have no row of their own."""


@dataclass(frozen=True)
class Row:
    """What a page says of a key. types: the alternatives, without the unit."""

    key: str
    types: tuple[str, ...]
    always: bool


IMPLIED = Row("", ("object",), True)
"""Of a key that is only named on the way to others."""


@dataclass
class Description:
    """The tables of a page by the anchors of their sections, and what documents have shown of them.

    met: (anchor, key, what), where what is "there", "null" or "absent"
    """

    tables: dict[str, dict[str, Row]]
    met: set[tuple[str, str, str]] = field(default_factory=set)

    def problems(self, value: Any, anchor: str) -> list[str]:
        """What a document has that the table of this section does not say, or the other way round, as sentences."""
        return list(self._object(value, anchor, "", anchor))

    def promised(self) -> set[tuple[str, str, str]]:
        """All that documents may show: each key, null where it may be, and absent where it may be."""
        found = set()
        for anchor, rows in self.tables.items():
            for row in rows.values():
                found.add((anchor, row.key, "there"))
                found |= {(anchor, row.key, "null")} if "null" in row.types else set()
                found |= set() if row.always or row.key == OTHERS else {(anchor, row.key, "absent")}
        return found

    def _object(self, value: Any, anchor: str, prefix: str, where: str) -> Iterator[str]:
        rows = self.tables[anchor]
        inside = {key[len(prefix) :] for key in rows if key.startswith(prefix) and key != prefix}
        names = {re.split(r"\.|\[\]", key)[0] for key in inside} - {OTHERS}
        if not isinstance(value, dict):
            yield f"{where} is no object"
            return
        for name in sorted(names - value.keys()):
            row = rows.get(prefix + name, IMPLIED)
            self.met.add((anchor, row.key, "absent"))
            if row.always:
                yield f"{where}.{name} is missing"
        for name, each in value.items():
            key = prefix + name if name in names else OTHERS
            row = rows.get(key, IMPLIED)
            if name not in names and OTHERS not in rows:
                yield f"{where}.{name} is not described"
                continue
            self.met.add((anchor, row.key, "null" if each is None else "there"))
            yield from self._any_of(each, row.types, anchor, prefix + name, f"{where}.{name}")

    def _any_of(self, value: Any, types: tuple[str, ...], anchor: str, key: str, where: str) -> Iterator[str]:
        tried = [list(self._of(value, kind, anchor, key, where)) for kind in types]
        yield from min(tried, key=len)

    def _of(self, value: Any, kind: str, anchor: str, key: str, where: str) -> Iterator[str]:
        if link := re.fullmatch(r"\[.*\]\(#(.*)\)", kind):
            yield from self._object(value, link[1], "", where)
        elif kind == "object":
            yield from self._object(value, anchor, f"{key}.", where)
        elif kind == "list of objects":
            yield from self._each(value, "object", anchor, f"{key}[]", where)
        elif made := re.fullmatch(r"list of (.*)", kind):
            yield from self._each(value, made[1], anchor, key, where)
        elif made := re.fullmatch(r"(\d+)(?: x)? (.*)", kind):
            yield from self._each(value, made[2], anchor, key, where, int(made[1]))
        elif made := re.fullmatch(r"tables? of (.*)", kind):
            if not isinstance(value, dict):
                yield f"{where} is no table"
            for name, each in value.items() if isinstance(value, dict) else ():
                yield from self._any_of(each, _types(made[1]), anchor, key, f"{where}.{name}")
        elif not _PLAIN[kind.removesuffix("s")](value):
            yield f"{where} is no {kind}, but {value!r}"

    def _each(
        self, value: Any, kind: str, anchor: str, key: str, where: str, count: int | None = None
    ) -> Iterator[str]:
        if not isinstance(value, list) or count not in (None, len(value)):
            yield f"{where} is no list{'' if count is None else f' of {count}'}"
            return
        for each in value:
            yield from self._of(each, kind, anchor, key, f"{where}[]")


_PLAIN = {
    "text": lambda value: isinstance(value, str),
    "number": lambda value: isinstance(value, int | float) and not isinstance(value, bool),
    "whole number": lambda value: isinstance(value, int) and not isinstance(value, bool),
    "true or false": lambda value: isinstance(value, bool),
    "null": lambda value: value is None,
    "anything": lambda value: True,
}


def _types(text: str) -> tuple[str, ...]:
    """The alternatives that a cell names."""
    if text.startswith("table of "):
        return (text,)
    whole = text.replace("true or false", "bool")
    return tuple(kind.replace("bool", "true or false") for kind in whole.split(" or "))


def described(page: str) -> Description:
    """The tables of a page whose columns are key, type, when and meaning."""
    tables: dict[str, dict[str, Row]] = {}
    anchor = ""
    for line in page.splitlines():
        if heading := re.match(r"#+ (.*)", line):
            anchor = re.sub(r"[^\w\- ]", "", heading[1].lower()).replace(" ", "-")
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if cells == ["key", "type", "when", "meaning"]:
            tables[anchor] = {}
        elif anchor in tables and len(cells) == 4 and not cells[0].startswith("---"):
            key, kind = cells[0].strip("`"), cells[1]
            link = kind.rpartition(")")[0]
            unit = kind[len(link) :].partition(", ")[0]
            tables[anchor][key] = Row(key, _types(link + unit), cells[2] == "always")
    return Description(tables)
