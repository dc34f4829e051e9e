"""PDF: one page of the drawing's size, vector lines, one layer (optional content group) per line class and visibility.

The same drawing gives the same bytes: there are no dates, and the file identifier is a digest of the content.
"""

from __future__ import annotations

import io
import math
import zlib

import pydyf

from hlr.drawing.drawing import Drawing
from hlr.drawing.fill import Fill
from hlr.tables.line_classes import by_number
from hlr.writers import style
from hlr.writers.number import number
from hlr.writers.strokes import Strokes, strokes
from hlr.writers.svg import accuracies, reached, title

_POINTS_PER_MM = 72.0 / 25.4
# The largest page side that PDF 1.7 allows, in its user units; beyond it the unit itself grows.
_MAX_SIDE = 14400.0
# Four times as fast as the highest level of compression, and 6 % larger.
_LEVEL = 4


def pdf(drawing: Drawing) -> bytes:
    """The drawing as a PDF file. Raises WriteError where a point is not finite."""
    page = strokes(drawing, cubic=True)
    document = pydyf.PDF()
    layers = []
    labels = [layer_name(by_number()[layer.kind].name, layer.visible) for layer in page.layers]
    if drawing.fill is not None:
        labels.insert(0, "Fill")
    for name in labels:
        group = pydyf.Dictionary({"Type": "/OCG", "Name": pydyf.String(name)})
        document.add_object(group)
        layers.append(group.reference)

    side = max(page.width, page.height) * _POINTS_PER_MM
    user_unit = max(1, math.ceil(side / _MAX_SIDE))
    factor = _POINTS_PER_MM / user_unit
    content = zlib.compress(_content(page, factor, drawing.fill), _LEVEL)
    stream = pydyf.Stream([content], {"Filter": "/FlateDecode"})
    document.add_object(stream)

    names = {f"L{i}": reference for i, reference in enumerate(layers)}
    resources = {"Properties": pydyf.Dictionary(names)}
    if drawing.fill is not None:
        from hlr.writers.fill import pdf_resources

        for name, held in pdf_resources(drawing.fill, _matrix(page, factor)).items():
            resources[name] = pydyf.Dictionary(held)
    sheet = {
        "Type": "/Page",
        "Parent": document.pages.reference,
        "MediaBox": pydyf.Array([0, 0, _real(page.width * factor), _real(page.height * factor)]),
        "Contents": stream.reference,
        "Resources": pydyf.Dictionary(resources),
    }
    if user_unit > 1:
        sheet["UserUnit"] = user_unit
    document.add_page(pydyf.Dictionary(sheet))
    if layers:
        # The layer list of a viewer reads from the top: visible lines first.
        order = pydyf.Array(layers[::-1])
        shown = pydyf.Dictionary({"Order": order, "ON": pydyf.Array(layers), "Name": pydyf.String("Drawing")})
        document.catalog["OCProperties"] = pydyf.Dictionary({"OCGs": pydyf.Array(layers), "D": shown})
    document.info["Title"] = pydyf.String(title(drawing).encode("utf-8", "replace").decode("utf-8"))
    document.info["Creator"] = pydyf.String("hlr")
    told = accuracies(drawing)
    document.info["Accuracy"], document.info["AccuracyAsked"] = map(pydyf.String, told.values())
    errors = ", ".join(f"{name} {value}" for name, value in reached(drawing).items())
    if errors:
        document.info["AccuracyReached"] = pydyf.String(errors)
    out = io.BytesIO()
    document.write(out, version=b"1.7", identifier=True)
    return out.getvalue()


def layer_name(kind: str, visible: bool) -> str:
    """The name of a layer as a viewer lists it: "Visible sharp"."""
    return f"{'Visible' if visible else 'Hidden'} {kind}"


def _content(page: Strokes, factor: float, fill: Fill | None) -> bytes:
    """The page's drawing commands, in millimetres."""
    matrix = " ".join(map(_real, _matrix(page, factor)))
    out = [f"{matrix} cm 1 j\n".encode("ascii")]
    if fill is not None:
        from hlr.writers.fill import pdf_content

        out += [b"/OC /L0 BDC ", pdf_content(fill, page.places), b"EMC\n"]
    for index, layer in enumerate(page.layers, 0 if fill is None else 1):
        row = by_number()[layer.kind]
        # Round caps would lengthen each dash by the line width.
        cap = 1 if style.dash(row, layer.visible) is None else 0
        width = number(style.width(row, layer.visible))
        out += [f"/OC /L{index} BDC {width} w {cap} J [] 0 d\n".encode("ascii"), page.pdf(layer), b"EMC\n"]
    return b"".join(out)


def _matrix(page: Strokes, factor: float) -> tuple[float, ...]:
    """From millimetres to the page."""
    return (factor, 0.0, 0.0, factor, -page.left * factor, -page.bottom * factor)


def _real(value: float) -> str:
    """A number as PDF wants it: no exponent."""
    return number(value, 9)
