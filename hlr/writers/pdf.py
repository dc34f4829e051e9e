"""PDF: one page of the drawing's size, vector lines, one layer (optional content group) per line class and visibility.

Where the style has the layers by part, there is one for each part as well: a line shows where both its layers do. The
same drawing gives the same bytes: there are no dates, and the file identifier is a digest of the content.
"""

from __future__ import annotations

import io
import math
import zlib
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import groupby
from typing import Any

import pydyf

from hlr.common.colors import rgb_of
from hlr.drawing.drawing import Drawing
from hlr.drawing.fill import Fill
from hlr.drawing.underlay import underlay
from hlr.writers.number import number
from hlr.writers.page_fonts import PageFonts
from hlr.writers.strokes import Inked, Strokes, strokes
from hlr.writers.svg import accuracies, reached, stated_view, title

_POINTS_PER_MM = 72.0 / 25.4
# The largest page side that PDF 1.7 allows, in its user units; beyond it the unit itself grows.
_MAX_SIDE = 14400.0
# Four times as fast as the highest level of compression, and 6 % larger.
_LEVEL = 4
_CAPS = {"butt": 0, "round": 1, "square": 2}
PAPER = "#ffffff"
"""A background that is not painted: it is that of the page."""


@dataclass(frozen=True, slots=True)
class Sheet:
    """A page of PDF. width, height: units of the page; factor: units per millimetre; left, bottom: to the drawing's own
    page; user_unit: points per unit."""

    width: float
    height: float
    factor: float
    left: float = 0.0
    bottom: float = 0.0
    user_unit: int = 1


@dataclass(slots=True)
class _Layers:
    """The optional content groups of a file, by name. Each has a number, which the page's commands call it by."""

    document: pydyf.PDF
    numbers: dict[str, int] = field(default_factory=dict)
    references: list[Any] = field(default_factory=list)

    def begin(self, key: str, label: str) -> str:
        """The command that begins content of a layer, which is added if there is none with this key."""
        if key not in self.numbers:
            group = pydyf.Dictionary({"Type": "/OCG", "Name": pydyf.String(_told(label))})
            self.document.add_object(group)
            self.numbers[key] = len(self.references)
            self.references.append(group.reference)
        return f"/OC /L{self.numbers[key]} BDC"


def pdf(drawing: Drawing) -> bytes:
    """The drawing as a PDF file. Raises WriteError where a point is not finite."""
    page = strokes(drawing, cubic=True)
    wide, high = page.width * _POINTS_PER_MM, page.height * _POINTS_PER_MM
    user_unit = max(1, math.ceil(max(wide, high) / _MAX_SIDE))
    factor = _POINTS_PER_MM / user_unit
    return document(drawing, page, Sheet(wide / user_unit, high / user_unit, factor, user_unit=user_unit))


def document(drawing: Drawing, page: Strokes, sheet: Sheet) -> bytes:
    """A drawing on a sheet; page: its cubic strokes."""
    made = pydyf.PDF()
    layers = _Layers(made)
    fonts = PageFonts()
    content = zlib.compress(_content(drawing, page, sheet, layers, fonts), _LEVEL)
    stream = pydyf.Stream([content], {"Filter": "/FlateDecode"})
    made.add_object(stream)

    names = {f"L{i}": reference for i, reference in enumerate(layers.references)}
    resources = {"Properties": pydyf.Dictionary(names)}
    if underlay(drawing):
        resources["Font"] = pydyf.Dictionary(fonts.resources(made))
    if drawing.fill is not None:
        from hlr.writers.fill import painted, pdf_resources

        for name, held in pdf_resources(painted(drawing, drawing.fill), _matrix(page, sheet)).items():
            resources[name] = pydyf.Dictionary(held)
    leaf = {
        "Type": "/Page",
        "Parent": made.pages.reference,
        "MediaBox": pydyf.Array([0, 0, _real(sheet.width), _real(sheet.height)]),
        "Contents": stream.reference,
        "Resources": pydyf.Dictionary(resources),
    }
    if sheet.user_unit > 1:
        leaf["UserUnit"] = sheet.user_unit
    made.add_page(pydyf.Dictionary(leaf))
    if layers.references:
        # The layer list of a viewer reads from the top: visible lines first.
        order = pydyf.Array(layers.references[::-1])
        shown = pydyf.Dictionary(
            {"Order": order, "ON": pydyf.Array(layers.references), "Name": pydyf.String("Drawing")}
        )
        made.catalog["OCProperties"] = pydyf.Dictionary({"OCGs": pydyf.Array(layers.references), "D": shown})
    made.info["Title"] = pydyf.String(_told(title(drawing)))
    made.info["Creator"] = pydyf.String("hlr")
    told = accuracies(drawing)
    made.info["Accuracy"], made.info["AccuracyAsked"] = map(pydyf.String, told.values())
    if view := stated_view(drawing):
        made.info["View"] = pydyf.String(view)
    errors = ", ".join(f"{name} {value}" for name, value in reached(drawing).items())
    if errors:
        made.info["AccuracyReached"] = pydyf.String(errors)
    out = io.BytesIO()
    made.write(out, version=b"1.7", identifier=True)
    return out.getvalue()


def layer_name(kind: str, visible: bool) -> str:
    """The name of a layer as a viewer lists it: "Visible sharp"."""
    return f"{'Visible' if visible else 'Hidden'} {kind}"


def _content(drawing: Drawing, page: Strokes, sheet: Sheet, layers: _Layers, fonts: PageFonts) -> bytes:
    """The page's drawing commands, in millimetres."""
    matrix = " ".join(map(_real, _matrix(page, sheet)))
    out = []
    if drawing.style.background not in (None, PAPER):
        begin = layers.begin("background", "Background")
        area = f"0 0 {_real(sheet.width)} {_real(sheet.height)} re f"
        out.append(f"{begin} {_color(drawing.style.background or PAPER)} rg {area} EMC\n".encode("ascii"))
    out.append(f"{matrix} cm 1 j\n".encode("ascii"))
    if under := underlay(drawing, solid=True):
        from hlr.writers.template_pdf import template_commands

        begin = layers.begin("template", "Template")
        commands = template_commands(under, page.left, page.bottom + page.height, fonts)
        out += [f"{begin} ".encode("ascii"), commands, b"EMC\n"]
    if drawing.fill is not None:
        out += _filled(drawing, drawing.fill, page.places, layers)
    if drawing.style.layers == "class":
        out += _lines(page.inked, layers)
    else:
        for pens, of_part in groupby(page.inked, lambda inked: inked.pens):
            (index,) = pens.parts
            begin = layers.begin(f"part {index}", drawing.parts[index].name)
            out += [f"{begin}\n".encode("ascii"), *_lines(list(of_part), layers), b"EMC\n"]
    return b"".join(out)


def _filled(drawing: Drawing, fill: Fill, places: int, layers: _Layers) -> list[bytes]:
    from hlr.writers.fill import painted, pdf_content

    begin = layers.begin("fill", "Fill")
    return [f"{begin} ".encode("ascii"), pdf_content(painted(drawing, fill), places), b"EMC\n"]


def _lines(inked: Sequence[Inked], layers: _Layers) -> list[bytes]:
    """Each line class in its layer."""
    out = []
    for name, of_class in groupby(inked, lambda each: layer_name(each.row.name, each.visible)):
        begin = layers.begin(name, name)
        for each in of_class:
            pen = each.pen
            look = f"{_color(pen.solid)} RG {number(pen.width)} w {_CAPS[pen.cap]} J [] 0 d"
            out += [f"{begin} {look}\n".encode("ascii"), each.pdf(), b"EMC\n"]
    return out


def _matrix(page: Strokes, sheet: Sheet) -> tuple[float, ...]:
    """From millimetres to the page."""
    factor = sheet.factor
    return (factor, 0.0, 0.0, factor, sheet.left - page.left * factor, sheet.bottom - page.bottom * factor)


def _color(color: str) -> str:
    return " ".join(number(channel / 255.0, 4) for channel in rgb_of(color))


def _told(text: str) -> str:
    """Text for PDF, which carries no half characters."""
    return text.encode("utf-8", "replace").decode("utf-8")


def _real(value: float) -> str:
    """A number as PDF wants it: no exponent."""
    return number(value, 9)
