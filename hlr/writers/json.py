"""The exchange format: all fields of a drawing, as JSON. hlr/docs/json.md describes it."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from hlr.drawing.drawing import Drawing, DrawnView
from hlr.drawing.section import Section
from hlr.tables import documents
from hlr.writers.json_records import accuracies, dumped, ending, listed, model_record, numbers, record

FORMAT = "hlr-drawing"


def document(drawing: Drawing) -> bytes:
    """The drawing as JSON, one line of text per part and per line. Raises WriteError where a point is not finite."""
    if drawing.sheet is not None:
        from hlr.writers.json_page import page_document

        return page_document(drawing, drawing.sheet)
    head = {
        **documents.head(FORMAT),
        "source": drawing.source,
        "units": "mm",
        "accuracy": accuracies(drawing),
        "view": _view(drawing.view),
        "scale": float(drawing.scale),
        "origin": numbers(drawing.origin),
        **({} if drawing.window is None else {"window": numbers(drawing.window)}),
        **({} if drawing.section is None else {"section": _section(drawing.section)}),
        **({} if drawing.page is None else {"page": asdict(drawing.page)}),
        "model": model_record(drawing),
    }
    tail = ending(drawing)
    if drawing.fill is not None:
        tail = {"fill": record(drawing.fill), **tail}
    text = f"{dumped(head)[:-1]},\n{listed(drawing.parts, drawing.lines)},\n{dumped(tail)[1:]}\n"
    return text.encode("ascii")


def _section(section: Section) -> dict[str, Any]:
    fields = asdict(section)
    if not section.corners:
        del fields["corners"]
    return fields


def _view(view: DrawnView) -> dict[str, Any]:
    fields = {k: v if isinstance(v, str) else numbers(v) for k, v in asdict(view).items() if v is not None}
    # In perspective, what is unknown is null.
    return fields if view.projection == "orthographic" else dict.fromkeys(asdict(view)) | fields
