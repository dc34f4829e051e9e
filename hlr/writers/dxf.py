"""DXF: millimetres on paper in the drawing's own coordinates, so x and y are the `points` of the exchange format.

ezdxf makes the document: header, layers, linetypes, layouts, hatches. The lines are put into it as text
(`dxf_entities`), one entity for each line, because ezdxf takes ten times as long for an entity. The same drawing gives
the same bytes: dates and identifiers are constants, handles are counted.
"""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Lock
from typing import TYPE_CHECKING

from hlr.drawing.drawing import Drawing
from hlr.drawing.line import Bounds
from hlr.drawing.underlay import underlay
from hlr.writers.dxf_entities import APPLICATION, Target, entities, rounded_length
from hlr.writers.dxf_fill import hatch
from hlr.writers.dxf_layers import CONTRAST, FILL, Layers
from hlr.writers.dxf_text import clean
from hlr.writers.fill import painted
from hlr.writers.strokes import MARGIN
from hlr.writers.svg import accuracies, reached, stated_view, title

if TYPE_CHECKING:
    from ezdxf.document import Drawing as Document

MILLIMETRES = 4
IMPERIAL = (1, 2, 3, 8, 9, 10)
"""Numbers of DXF for units: inches, feet, miles, microinches, mils, yards are the imperial ones."""

_ENTITIES = "  0\nSECTION\n  2\nENTITIES\n"
_END = "  0\nENDSEC\n"
_CHUNK = 1000
"""Entities that are encoded at a time."""

MOST_OF_VIEW = 2000
"""Bytes of what is said of a view; DXF takes 2049."""

_fixed = Lock()


def dxf(drawing: Drawing, unit: int = MILLIMETRES) -> bytes:
    """The drawing as a DXF file of the version that its style names; unit: the number of the one that the file names.

    Raises WriteError where a point is not finite.
    """
    from ezdxf.document import Drawing as Document

    version = drawing.style.dxf
    with _repeatable():
        document = Document.new(version)
        modern, true_colors = version != "R12", version not in ("R12", "R2000")
        _set_header(document, drawing, modern, unit)
        places = Layers(document, drawing, modern, true_colors).tags()
        model = document.modelspace()
        if under := underlay(drawing, solid=True, marks=False):
            from hlr.writers.dxf_template import add_template

            page = _page(drawing)
            add_template(document, under, page.x0, page.y1, modern, true_colors)
        if drawing.fill is not None and modern:
            document.layers.add(FILL, color=CONTRAST)
            hatch(model, painted(drawing, drawing.fill), FILL)
        if drawing.sheet is not None and drawing.sheet.marks:
            from hlr.writers.dxf_marks import add_marks

            add_marks(document, drawing, modern)
        first = int(str(document.entitydb.handles), 16)
        document.entitydb.handles.reset(f"{first + len(drawing.lines):X}")
        for name in sorted(document.entitydb.dxf_types_in_use()):  # ezdxf takes them as they come out of a set
            document.classes.add_class(name)
        stream = io.StringIO()
        document.write(stream)
    head, mark, tail = stream.getvalue().partition(_ENTITIES)
    there, end, rest = tail.partition(_END)
    out = [document.encode(head + mark + there)]
    texts: list[str] = []
    for text in entities(drawing, Target(places, modern, first, model.layout_key)):
        texts.append(text)
        if len(texts) == _CHUNK:
            out.append(document.encode("".join(texts)))
            texts.clear()
    return b"".join([*out, document.encode("".join([*texts, end, rest]))])


@contextmanager
def _repeatable() -> Iterator[None]:
    """Dates and identifiers are constants. ezdxf has one option for the whole process; it is put back."""
    import ezdxf

    with _fixed:
        before = ezdxf.options.write_fixed_meta_data_for_testing
        ezdxf.options.write_fixed_meta_data_for_testing = True
        try:
            yield
        finally:
            ezdxf.options.write_fixed_meta_data_for_testing = before


def _set_header(document: Document, drawing: Drawing, modern: bool, unit: int) -> None:
    """Units, extents, page, and what a program shows when it opens the file."""
    document.header["$LTSCALE"] = 1.0
    document.appids.add(APPLICATION)
    bounds, page = _rounded(drawing.bounds), _rounded(_page(drawing))
    width, height = rounded_length(page.width), rounded_length(page.height)
    model = document.modelspace().dxf
    model.extmin, model.extmax = (bounds.x0, bounds.y0, 0.0), (bounds.x1, bounds.y1, 0.0)
    # ezdxf copies them into the header, but for 0, 0, which it takes for none.
    document.header["$EXTMIN"], document.header["$EXTMAX"] = model.extmin, model.extmax
    model.limmin, model.limmax = (page.x0, page.y0), (page.x1, page.y1)
    centre = (rounded_length(0.5 * (page.x0 + page.x1)), rounded_length(0.5 * (page.y0 + page.y1)))
    document.set_modelspace_vport(max(height, width), centre)
    if not modern:
        document.header["$HANDLING"] = 0
        return
    document.units = unit
    document.header["$MEASUREMENT"] = 0 if unit in IMPERIAL else 1
    document.header["$LWDISPLAY"] = 1
    # Where LibreCAD looks for the scale, the page, and where the drawing lies on it; ezdxf's scale is 0.
    document.header["$PSVPSCALE"] = 1.0
    document.header["$PINSBASE"] = (0.0 - page.x0, 0.0 - page.y0, 0.0)
    sheet = document.active_layout().dxf
    sheet.limmin, sheet.limmax = (0.0, 0.0), (width, height)
    paper = document.modelspace().dxf_layout.dxf
    paper.paper_width, paper.paper_height = width, height
    # Plotted: the limits, one millimetre as one.
    paper.plot_type, paper.plot_paper_units, paper.standard_scale_type = 2, 1, 16
    told = {"Title": title(drawing), **accuracies(drawing), **{f"reached {k}": v for k, v in reached(drawing).items()}}
    for name, value in told.items():
        document.header.custom_vars.append(name, clean(value))
    if view := stated_view(drawing):
        document.header.custom_vars.append("View", clean(view, MOST_OF_VIEW))


def _rounded(bounds: Bounds) -> Bounds:
    return Bounds(*(rounded_length(value) for value in (bounds.x0, bounds.y0, bounds.x1, bounds.y1)))


def _page(drawing: Drawing) -> Bounds:
    """The page as SVG and PDF have it."""
    if drawing.page is not None:
        return drawing.page.bounds
    x0, y0, x1, y1 = drawing.area
    return Bounds(x0 - MARGIN, y0 - MARGIN, x1 + MARGIN, y1 + MARGIN)
