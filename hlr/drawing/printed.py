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
    if sheet is None:
        return ""
    if not sheet.method:
        return sheet.template
    pens, page = usual_pens_of(drawing), drawing.area
    pen, wide = pens.pen("smooth", True), pens.pen("sharp", True)
    color = wide.solid if solid else wide.color
    marks = ""
    if sheet.marks:
        from hlr.drawing.section_marks import marks_svg

        marks = marks_svg(sheet.marks, page.height, color, (wide.width, pen.width))
    if sheet.template:
        return sheet.template + marks
    return marks + projection_symbol(
        sheet.method, page.width, page.height, pen.solid if solid else pen.color, pen.width
    )
