"""What is printed under the lines of a page: its template, or the symbol of its projection method."""

from __future__ import annotations

from hlr.drawing.drawing import Drawing
from hlr.drawing.pens import usual_pens_of
from hlr.drawing.projection_symbol import projection_symbol


def underlay(drawing: Drawing, solid: bool = False, marks: bool = True) -> str:
    """SVG elements in millimetres from the page's upper left corner; empty where nothing is printed.

    solid: for formats that know no currentColor. marks: with those of sections.
    """
    sheet = drawing.sheet
    if sheet is None:
        return ""
    if not sheet.method:
        return sheet.template
    pens, page = usual_pens_of(drawing), drawing.area
    pen, wide = pens.pen("smooth", True), pens.pen("sharp", True)
    color = wide.solid if solid else wide.color
    cuts = ""
    if marks and sheet.marks:
        from hlr.drawing.section_marks import marks_svg

        cuts = marks_svg(sheet.marks, page.height, color, (wide.width, pen.width))
    if sheet.template:
        return sheet.template + cuts
    return cuts + projection_symbol(sheet.method, page.width, page.height, pen.solid if solid else pen.color, pen.width)
