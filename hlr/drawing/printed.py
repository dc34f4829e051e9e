"""What is printed under the lines of a page: its template, or the symbol of its projection method."""

from __future__ import annotations

from hlr.drawing.drawing import Drawing
from hlr.drawing.pens import usual_pens_of
from hlr.drawing.projection_symbol import projection_symbol


def printed(drawing: Drawing, solid: bool = False) -> str:
    """SVG elements in millimetres from the page's upper left corner; empty where nothing is printed.

    solid: for formats that know no currentColor.
    """
    sheet = drawing.sheet
    if sheet is None or sheet.template or not sheet.method:
        return "" if sheet is None else sheet.template
    pen, page = usual_pens_of(drawing).pen("smooth", True), drawing.area
    return projection_symbol(sheet.method, page.width, page.height, pen.solid if solid else pen.color, pen.width)
