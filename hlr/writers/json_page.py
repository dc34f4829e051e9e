"""A page of several views as JSON: each with its place, its parts and its lines. hlr/docs/json.md describes it."""

from __future__ import annotations

from dataclasses import asdict, replace
from typing import Any

import numpy as np

from hlr.drawing.drawing import Drawing
from hlr.drawing.section_marks import SectionMark
from hlr.drawing.sheet import Sheet, SheetView, views_of_parts
from hlr.errors import WriteError
from hlr.tables import documents
from hlr.writers.json_records import accuracies, dumped, ending, listed, model_record, numbers

PAGE_FORMAT = "hlr-page"


def page_document(drawing: Drawing, sheet: Sheet) -> bytes:
    """The page as JSON, one line of text per part and per line.

    Raises WriteError where a point is not finite, or a part is of no view.
    """
    head = {
        **documents.head(PAGE_FORMAT),
        "source": drawing.source,
        "units": "mm",
        "accuracy": accuracies(drawing),
        "name": drawing.view.name,
        "method": sheet.method or None,
        "scale": float(drawing.scale),
        "page": None if drawing.page is None else asdict(drawing.page),
        "model": model_record(drawing),
        "texts": dict(sheet.texts),
        "template": sheet.template,
        "sections": [_section(mark) for mark in sheet.marks],
    }
    views = ",\n".join(_views(drawing, sheet))
    text = f'{dumped(head)[:-1]},\n"views": [\n{views}\n],\n{dumped(ending(drawing))[1:]}\n'
    return text.encode("ascii")


def _section(mark: SectionMark) -> dict[str, Any]:
    return {
        "letter": mark.letter,
        "title": mark.title,
        "place": numbers(mark.name),
        "line": None if mark.line is None else numbers(mark.line),
        "back": numbers(mark.back),
    }


def _views(drawing: Drawing, sheet: Sheet) -> list[str]:
    """Each view with its own parts and lines."""
    of_parts = views_of_parts([part.name for part in drawing.parts], [view.name for view in sheet.views])
    if -1 in of_parts:
        stray = drawing.parts[of_parts.index(-1)].name
        raise WriteError(f"cannot write the page as JSON: its part {stray!r} is of none of its views")
    own = [[k for k, view in enumerate(of_parts) if view == number] for number in range(len(sheet.views))]
    numbered = {part: number for parts in own for number, part in enumerate(parts)}
    lines: list[list[Any]] = [[] for _ in sheet.views]
    for line in drawing.lines:
        other = None if line.other is None else numbered[line.other]
        lines[of_parts[line.part]].append(replace(line, part=numbered[line.part], other=other))
    made = []
    for number, view in enumerate(sheet.views):
        parts = [
            replace(part, name=part.name.removeprefix(f"{view.name}/"))
            for part in (drawing.parts[k] for k in own[number])
        ]
        made.append(f"{dumped(_view(view))[:-1]},\n{listed(parts, lines[number])}}}")
    return made


def _view(view: SheetView) -> dict[str, Any]:
    return {
        "name": view.name,
        "label": view.label,
        **({"letter": view.letter} if view.letter else {}),
        "scale": float(view.scale),
        "place": numbers(view.place),
        "rotation": float(view.rotation),
        "direction": numbers(view.direction),
        "right": numbers(view.right),
        "up": numbers(np.cross(view.direction, view.right)),
        "origin": None if view.origin is None else numbers(view.origin),
        **({} if view.section is None else {"section": numbers(view.section)}),
        **({"corners": numbers(view.corners)} if view.corners else {}),
    }
