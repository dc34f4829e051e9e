"""CadQuery's picture (size, placement, groups, axes) with hlr's lines, as SVG and PDF.

Coordinates in the file are those of the projected model, in model units with y up, as in CadQuery's own files: the
outer group scales and moves them into the picture. Where CadQuery has one path per edge, there is one per stroke here,
with its part and edge, in a group per line class.
"""

from __future__ import annotations

import io
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.compat.cadquery_options import DEFAULT_DIRECTION, PictureOptions
from hlr.compat.viewport import ViewportDrawing
from hlr.drawing.drawing import Drawing
from hlr.drawing.lines import Lines, held
from hlr.tables.line_classes import EdgeClass, by_number
from hlr.writers.number import number
from hlr.writers.strokes import layers_of, places_of

POINTS_PER_PIXEL = 0.75
"""A pixel of CSS is a 96th of an inch."""

AXES_FROM = (30, -30)
AXES = (("X", (75, -33), (80, -30)), ("Y", (30, -75), (25, -85)), ("Z", (58, -15), (65, -5)))
"""Name, end, and place of the name: CadQuery's picture of the axes, pixels with y down."""
AXES_LEFT, AXES_UP = 20, 30
"""Where that picture stands: from the left, and from the bottom."""
AXES_WIDTH = 3
LETTER_HEIGHT = 16
"""Height of letters where nothing says otherwise."""


@dataclass(frozen=True, slots=True)
class Page:
    """A drawing and its place in the picture.

    drawing        lines in model units; hidden tangent edges, which CadQuery leaves out, are not among them
    shift          (2,) what to add to its points to get those of the projected model
    width, height  pixels
    unit_scale     pixels per model unit
    place          model units to add to x and y (up) of the projected model, before they are scaled
    stroke_width   model units
    """

    options: PictureOptions
    drawing: Drawing
    shift: npt.NDArray[np.float64]
    width: float
    height: float
    unit_scale: float
    place: tuple[float, float]
    stroke_width: float

    @property
    def axes(self) -> bool:
        """Whether the axes are drawn: they fit one direction only."""
        return self.options.showAxes and self.options.projectionDir == DEFAULT_DIRECTION

    def layers(self, cubic: bool) -> list[_kernel.Layer]:
        """Layers with coordinates of the projected model."""
        drawing = self.drawing
        places = places_of(drawing, drawing.bounds)
        step = 10.0**places
        x, y = (round(shift * step) for shift in self.shift.tolist())
        layers = layers_of(held(drawing.lines), places, drawing.accuracy.used, cubic)
        return [layer.moved(x, y) for layer in layers]


def lay_out(picture: ViewportDrawing, options: PictureOptions) -> Page:
    """Size, scale and place of a drawing as CadQuery chooses them."""
    drawing = picture.drawing
    if drawing.counters["smooth_lines"]:
        whole = held(drawing.lines)
        drawing = replace(drawing, lines=Lines(whole.chosen(whole.visible() | (whole.kinds() != EdgeClass.SMOOTH))))
    x0, y0, x1, y1 = drawing.bounds
    scale = options.unit_scale(x1 - x0, y1 - y0)
    width, height = options.size(x1 - x0, y1 - y0, scale)
    left, top = x0 + float(picture.shift[0]), y1 + float(picture.shift[1])
    return Page(
        options=options,
        drawing=drawing,
        shift=picture.shift,
        width=width,
        height=height,
        unit_scale=scale,
        place=(options.marginLeft / scale - left, -top - options.marginTop / scale),
        stroke_width=1.0 / scale if options.strokeWidth == -1.0 else options.strokeWidth,
    )


def to_svg(page: Page) -> bytes:
    """The picture as SVG, in the groups of CadQuery's template."""
    layers = page.layers(cubic=False)
    # The writer turns y down, and this picture's transform does so as well.
    upright = [layer.mirrored() for layer in layers]
    options, scale, width = page.options, f"{page.unit_scale:.12g}", f"{page.stroke_width:.9g}"
    out = [
        '<?xml version="1.0" encoding="UTF-8" standalone="no"?>\n'
        '<svg xmlns:svg="http://www.w3.org/2000/svg" xmlns="http://www.w3.org/2000/svg" '
        f'width="{page.width:.12g}" height="{page.height:.12g}">\n'
        f'<g transform="scale({scale}, -{scale}) translate({page.place[0]:.12g},{page.place[1]:.12g})" '
        f'stroke-width="{width}" fill="none">\n'
    ]
    colors = {False: options.hiddenColor, True: options.strokeColor}
    for visible in (False, True):
        dash = "" if visible else f' stroke-dasharray="{width},{width}"'
        out.append(f"<!-- {'solid' if visible else 'hidden'} lines -->\n")
        out.append(f'<g stroke="rgb({",".join(str(v) for v in colors[visible])})" fill="none"{dash}>\n')
        for layer in upright:
            if layer.visible == visible:
                out.append(f'<g class="{by_number()[layer.kind].name}">\n{layer.svg().decode("ascii")}</g>\n')
        out.append("</g>\n")
    out.append("</g>\n")
    if page.axes:
        out.append(_axes_svg(page.height))
    out.append("</svg>\n")
    return "".join(out).encode("utf-8")


def _axes_svg(height: float) -> str:
    x0, y0 = AXES_FROM
    out = [f'<g transform="translate({AXES_LEFT},{height - AXES_UP:.12g})" stroke="rgb(0,0,255)">\n']
    for name, (x1, y1), (x, y) in AXES:
        out.append(f'<line x1="{x0}" y1="{y0}" x2="{x1}" y2="{y1}" stroke-width="{AXES_WIDTH}" stroke="#000000"/>\n')
        out.append(f'<text x="{x}" y="{y}" style="stroke:#000000">{name} </text>\n')
    return "".join((*out, "</g>\n"))


def to_pdf(page: Page) -> bytes:
    """The same picture as a PDF page; a pixel is three quarters of a point."""
    import pydyf

    layers = page.layers(cubic=True)
    options, k = page.options, POINTS_PER_PIXEL
    # Points of the page, y up from its lower edge, by one matrix from the projected model.
    scale = page.unit_scale * k
    right, up = page.place[0] * scale, page.height * k + page.place[1] * scale
    width = _real(page.stroke_width)
    out = [f"q {_real(scale)} 0 0 {_real(scale)} {_real(right)} {_real(up)} cm {width} w\n".encode("ascii")]
    colors = {False: options.hiddenColor, True: options.strokeColor}
    for visible in (False, True):
        dash = "[] 0 d" if visible else f"[{width} {width}] 0 d"
        out.append(f"{' '.join(_real(v / 255.0) for v in colors[visible])} RG {dash}\n".encode("ascii"))
        for layer in layers:
            if layer.visible == visible:
                out.append(layer.pdf())
    out.append(b"Q\n")
    if page.axes:
        out.append(_axes_pdf())
    document = pydyf.PDF()
    font = pydyf.Dictionary({"Type": "/Font", "Subtype": "/Type1", "BaseFont": "/Helvetica"})
    stream = pydyf.Stream([b"".join(out)], compress=True)
    for thing in (font, stream):
        document.add_object(thing)
    sheet = {
        "Type": "/Page",
        "Parent": document.pages.reference,
        "MediaBox": pydyf.Array([0, 0, _real(page.width * k), _real(page.height * k)]),
        "Contents": stream.reference,
        "Resources": pydyf.Dictionary({"Font": pydyf.Dictionary({"F": font.reference})}),
    }
    document.add_page(pydyf.Dictionary(sheet))
    document.info["Creator"] = pydyf.String("hlr")
    file = io.BytesIO()
    document.write(file, version=b"1.7", identifier=True)
    return file.getvalue()


def _axes_pdf() -> bytes:
    k = _real(POINTS_PER_PIXEL)
    left, up = _real(AXES_LEFT * POINTS_PER_PIXEL), _real(AXES_UP * POINTS_PER_PIXEL)
    x0, y0 = AXES_FROM
    out = [f"q {k} 0 0 {k} {left} {up} cm {AXES_WIDTH} w 0 G 0 g [] 0 d\n"]
    for name, (x1, y1), (x, y) in AXES:
        out.append(f"{x0} {-y0} m {x1} {-y1} l S BT /F {LETTER_HEIGHT} Tf {x} {-y} Td ({name}) Tj ET\n")
    return "".join((*out, "Q\n")).encode("ascii")


def _real(value: float) -> str:
    """A number as PDF wants it: no exponent."""
    return number(value, 9)
