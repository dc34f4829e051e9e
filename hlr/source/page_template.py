"""A page template: an SVG with a frame, a title block and fields to fill in, as FreeCAD's TechDraw has them.

Comments in the file say where views may lie, as in FreeCAD's own templates, in the units of its viewBox::

    <!-- Working space 10 10 287 200 -->      left, top, right, bottom
    <!-- Title block 107 162 287 200 -->
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from hlr.errors import OptionError, SourceError
from hlr.source.archive import xml_tree
from hlr.source.file_checks import check_readable
from hlr.source.freecad.properties import DamagedError
from hlr.source.freecad.template import SVG, editable, field_texts, filled_template
from hlr.tables.entry import listed
from hlr.tables.sheets import LARGEST_SIDE

MOST_BYTES = 20_000_000
"""A larger file is no template."""

BESIDE = 5.0
"""Millimetres between the frame or the title block and the views."""

UNITS = {"mm": 1.0, "cm": 10.0, "in": 25.4, "pt": 25.4 / 72.0, "pc": 25.4 / 6.0, "px": 25.4 / 96.0, "": 1.0}
"""Millimetres of each unit of length in an SVG; FreeCAD takes lengths without one for millimetres."""

SCALES = {"scale", "sc", "масштаб"}
"""Keys of fields, in small letters and without FreeCAD's FC-, that hold the scale of the views."""

_NO_XML = re.compile(r"[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""What is no character of XML."""

Rectangle = tuple[float, float, float, float]
"""x0, y0, x1, y1, millimetres from the lower left corner of a page."""


@dataclass(frozen=True, slots=True)
class PageTemplate:
    """A template.

    width, height  of the page, millimetres
    rooms          rectangles of which each is free for views; empty: the file does not say
    fields         the keys of its fields
    """

    path: Path
    data: bytes
    width: float
    height: float
    rooms: tuple[Rectangle, ...]
    fields: tuple[str, ...]

    def check(self, texts: Mapping[str, str]) -> None:
        """Raise OptionError for a text that no field has a place for, or that an SVG cannot hold."""
        unknown = [key for key in texts if key not in self.fields]
        if unknown:
            known = f"its fields are {listed(self.fields, 'and')}" if self.fields else "it has no fields"
            raise OptionError(f"{self.path.name} has no field {unknown[0]!r}: {known}")
        for key, text in texts.items():
            if wrong := _NO_XML.search(text):
                raise OptionError(
                    f"the text for {key} has the character {wrong[0]!r}, which SVG cannot hold: leave it out"
                )

    def filled(self, texts: Mapping[str, str], scale: str) -> str:
        """The template as an SVG element with texts in its fields; the scale goes into a field of that name."""
        return filled_template(self.data, self._given(texts, scale), (self.width, self.height), self.path)

    def texts(self, texts: Mapping[str, str], scale: str) -> dict[str, str]:
        """What then stands in each of its fields, by its key."""
        return field_texts(self.data, self._given(texts, scale), self.path)

    def _given(self, texts: Mapping[str, str], scale: str) -> dict[str, str]:
        scales = {key: scale for key in self.fields if key.lower().removeprefix("fc-") in SCALES}
        return {**scales, **texts}


def read_page_template(path: Path) -> PageTemplate:
    """The template in a file. Raises SourceError where it is none."""
    check_readable(path)
    if path.stat().st_size > MOST_BYTES:
        raise SourceError(f"{path.name} is no page template: it is larger than {MOST_BYTES / 1e6:g} MB.")
    data = path.read_bytes()
    root = xml_tree(data, path, "it", "a page template")
    if root.tag != f"{SVG}svg":
        raise SourceError(f"{path.name} is no page template: it is no SVG.")
    width, height = (_length(root.get(name, ""), name, path) for name in ("width", "height"))
    fields = (key for text in root.iter(f"{SVG}text") if (key := editable(text)))
    across = _across(root.get("viewBox", ""))
    rooms = _rooms(data.decode("utf-8", "replace"), width / across if across else 1.0, height)
    template = PageTemplate(path, data, width, height, rooms, tuple(dict.fromkeys(fields)))
    try:
        template.filled({}, "")
    except DamagedError as error:
        raise SourceError(f"{path.name} is no page template: {error}.") from None
    return template


def _length(text: str, name: str, path: Path) -> float:
    found = re.fullmatch(r"\s*(\d{1,9}(?:\.\d*)?)\s*([a-z]*)\s*", text)
    size = float(found[1]) * UNITS[found[2]] if found and found[2] in UNITS else 0.0
    if not 0.0 < size <= LARGEST_SIDE:
        raise SourceError(f"{path.name} is no page template: its {name} is no length such as 297mm, but {text!r}.")
    return round(size, 3)


def _across(box: str) -> float:
    """The width of a viewBox; 0 where there is none."""
    numbers = re.fullmatch(r"[\s,]*(?:-?[\d.]+[\s,]+){2}([\d.]+)[\s,]+[\d.]+[\s,]*", box)
    try:
        return float(numbers[1]) if numbers else 0.0
    except ValueError:
        return 0.0


def _rooms(text: str, unit: float, height: float) -> tuple[Rectangle, ...]:
    """Where views may lie: above the title block, or beside it. unit: of the comments, millimetres."""
    space, block = (_stated(text, name, unit) for name in ("Working space", "Title block"))
    if space is None:
        return ()
    left, top, right, bottom = space[0] + BESIDE, space[1] + BESIDE, space[2] - BESIDE, space[3] - BESIDE
    rooms = [(left, top, right, bottom)]
    if block is not None:
        rooms = [(left, top, right, block[1] - BESIDE), (left, top, block[0] - BESIDE, bottom)]
    return tuple((x0, height - y1, x1, height - y0) for x0, y0, x1, y1 in rooms if x1 > x0 and y1 > y0)


def _stated(text: str, name: str, unit: float) -> Rectangle | None:
    """The rectangle that a comment states, from left and top to right and bottom, millimetres."""
    number = r"\s+(\d{1,6}(?:\.\d{1,6})?)"
    found = re.search(rf"<!--\s*{name}{number * 4}\s*-->", text)
    if found is None:
        return None
    x0, y0, x1, y1 = (unit * float(each) for each in found.groups())
    return x0, y0, x1, y1
