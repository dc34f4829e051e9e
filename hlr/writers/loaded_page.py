"""A page of several views out of its JSON, which `hlr/docs/json.md` describes."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from hlr.drawing.drawing import Drawing, DrawnPart, DrawnView
from hlr.drawing.line import Line
from hlr.drawing.section_marks import SectionMark
from hlr.drawing.sheet import Sheet, SheetView
from hlr.source.freecad.template import is_safe
from hlr.tables.projection_methods import PROJECTION_METHODS
from hlr.writers.loaded_records import common, direction, lines_of, objects, page_of, positive
from hlr.writers.revive import revived

Pair = tuple[float, float]

_ENDS = 2
"""Of a cutting line, which may have corners between them."""


def drawing_of_page(document: dict[str, Any], name: str) -> Drawing:
    """The page in a document. name: of its file, for errors. Raises KeyError, ValueError, SourceError."""
    parts: list[DrawnPart] = []
    lines: list[Line] = []
    views = objects(document["views"], "views")
    names = [revived(str, view["name"], f"views[{i}].name") for i, view in enumerate(views)]
    if len(set(names)) < len(names) or any("/" in each for each in names):
        raise ValueError("views should each have a name of their own, without a slash")
    for i, view in enumerate(views):
        first, what = len(parts), f"views[{i}]."
        own: tuple[DrawnPart, ...] = revived(tuple[DrawnPart, ...], view["parts"], f"{what}parts")
        parts += [replace(part, name=f"{names[i]}/{part.name}") for part in own]
        lines += [_from(first, line) for line in lines_of(view["lines"], len(own), what)]
    page = page_of(document["page"])
    return Drawing(
        **common(document),
        view=DrawnView(
            revived(str, document["name"], "name"), "orthographic", (0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
        ),
        origin=(0.0, 0.0),
        parts=tuple(parts),
        # The hatches of all views are drawn last.
        lines=(*(x for x in lines if x.kind != "hatch"), *(x for x in lines if x.kind == "hatch")),
        page=page,
        sheet=Sheet(
            tuple(_view(view, f"views[{i}]") for i, view in enumerate(views)),
            _template(document["template"], name),
            _method(document["method"]),
            tuple(_mark(mark, f"sections[{i}]") for i, mark in enumerate(objects(document["sections"], "sections"))),
            revived(Mapping[str, str], document["texts"], "texts"),
        ),
    )


def _from(first: int, line: Line) -> Line:
    """The line with the numbers of its parts counted from the first of the page."""
    return replace(line, part=line.part + first, other=None if line.other is None else line.other + first)


def _view(entry: dict[str, Any], what: str) -> SheetView:
    view: SheetView = revived(SheetView, entry, what)
    positive(view.scale, f"{what}.scale")
    plane = (*(view.section or ()), *(c for corner in view.corners for c in corner))
    _finite((*view.place, view.rotation, *(view.origin or ()), *plane), what)
    for name in ("direction", "right"):
        direction(getattr(view, name), f"{what}.{name}")
    if view.letter:
        _letter(view.letter, what)
    return view


def _mark(entry: dict[str, Any], what: str) -> SectionMark:
    mark = SectionMark(
        _letter(entry["letter"], what),
        revived(Pair, entry["place"], f"{what}.place"),
        revived(tuple[Pair, ...] | None, entry["line"], f"{what}.line"),
        revived(Pair, entry["back"], f"{what}.back"),
    )
    if mark.line is not None and len(mark.line) < _ENDS:
        raise ValueError(f"{what}.line should have two ends")
    _finite((*mark.name, *mark.back, *(x for end in mark.line or () for x in end)), what)
    return mark


def _finite(numbers: Iterable[float], what: str) -> None:
    """Raise ValueError for places that are none."""
    if not all(map(math.isfinite, numbers)):
        raise ValueError(f"{what} has coordinates that are no numbers")


def _letter(value: Any, what: str) -> str:
    # The letter is written into SVG as it is.
    if not isinstance(value, str) or not re.fullmatch("[A-Z][0-9]{0,6}", value):
        raise ValueError(f"{what}.letter should be a letter such as A")
    return value


def _method(value: Any) -> str:
    if value is None:
        return ""
    if not isinstance(value, str) or value not in PROJECTION_METHODS:
        raise ValueError(f"method should be null, or one of {', '.join(PROJECTION_METHODS)}")
    return value


def _template(value: Any, name: str) -> str:
    svg: str = revived(str, value, "template")
    # It is written into SVG as it is.
    if svg and not is_safe(svg, Path(name)):
        raise ValueError("template holds what could run, or leads out of the file")
    return svg
