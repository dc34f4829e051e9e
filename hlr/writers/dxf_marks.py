"""Marks of sections in DXF: lines, arrows and texts on a layer of their own."""

from __future__ import annotations

from typing import TYPE_CHECKING

from hlr.drawing.drawing import Drawing
from hlr.drawing.pens import usual_pens_of
from hlr.drawing.section_marks import CHAIN, shapes_of
from hlr.drawing.view_marks import LETTER
from hlr.writers.dxf_layers import MARKS, lineweight, nearest_color

if TYPE_CHECKING:
    from ezdxf.document import Drawing as Document

LINETYPE = "SECTION_CHAIN"


def add_marks(document: Document, drawing: Drawing, modern: bool) -> None:
    """Add the marks of a page of arranged views to the model space. modern: the version is not R12."""
    from ezdxf.enums import TextEntityAlignment

    assert drawing.sheet is not None
    pens, model = usual_pens_of(drawing), document.modelspace()
    wide, narrow = pens.pen("sharp", True), pens.pen("smooth", True)
    dash, gap, dot, last = CHAIN
    document.linetypes.add(LINETYPE, [sum(CHAIN), dash, -gap, dot, -last], description="____ _ ____ _ ____")
    number, rgb = nearest_color(wide.solid)
    true_color = {"true_color": rgb} if rgb is not None and drawing.style.dxf not in ("R12", "R2000") else {}
    document.layers.add(MARKS, color=number, lineweight=lineweight(wide.width), **true_color)
    thin = {"lineweight": lineweight(narrow.width)} if modern else {}
    for mark in drawing.sheet.marks:
        shapes = shapes_of(mark)
        for ends in shapes.wide:
            model.add_line(*ends, dxfattribs={"layer": MARKS})
        for ends in shapes.chain:
            model.add_line(*ends, dxfattribs={"layer": MARKS, "linetype": LINETYPE, **thin})
        for corners in shapes.arrows:
            model.add_solid(corners, dxfattribs={"layer": MARKS})
        for place, text in shapes.texts:
            # Capitals are as high as the text.
            added = model.add_text(text, height=0.7 * LETTER, dxfattribs={"layer": MARKS})
            added.set_placement(place, align=TextEntityAlignment.MIDDLE_CENTER)
