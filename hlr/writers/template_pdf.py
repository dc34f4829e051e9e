"""The template of a page in PDF: its paths, and its texts in the fonts of `page_fonts`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from hlr.errors import WriteError
from hlr.writers.number import number
from hlr.writers.page_fonts import PageFonts
from hlr.writers.template_elements import dashes_of, shown_elements

CAPS = {"butt": 0, "round": 1, "square": 2}
JOINS = {"miter": 0, "round": 1, "bevel": 2}


def template_commands(template: str, left: float, top: float, fonts: PageFonts) -> bytes:
    """The commands that draw a template, in millimetres with y up.

    template: as of `hlr.drawing.sheet.Sheet`. left, top: of the page, in the drawing's coordinates. fonts: are told
        the letters of the texts.

    Raises:
        WriteError: the template is no SVG that can be drawn.
    """
    from svgelements import Path, Text

    out = [f"q 1 0 0 -1 {number(left)} {number(top)} cm"]
    try:
        for element in shown_elements(template):
            if isinstance(element, Text):
                out += _text(element, fonts)
            else:
                out += _shape(element, Path(element))
    except Exception as error:  # whatever a broken file makes the library raise
        raise WriteError(
            f"the template of the page cannot be drawn in PDF ({type(error).__name__}): write SVG or DXF"
        ) from None
    return "\n".join([*out, "Q\n"]).encode("ascii")


def _shape(shape: Any, path: Any) -> Iterator[str]:
    fill, stroke = _color(shape.fill), _color(shape.stroke)
    width, scale = float(shape.stroke_width or 0.0), abs(shape.transform.determinant) ** 0.5
    path = abs(path)  # with its transforms applied
    path.approximate_arcs_with_cubics()
    if len(path) == 0 or not (fill or stroke):
        return
    if fill:
        yield f"{fill} rg"
    if stroke:
        cap = CAPS.get(shape.values.get("stroke-linecap", "butt"), 0)
        join = JOINS.get(shape.values.get("stroke-linejoin", "miter"), 0)
        yield f"{stroke} RG {number(width * scale)} w {cap} J {join} j {_dashes(shape, scale)} d"
    yield from _segments(path)
    rule = "*" if fill and shape.values.get("fill-rule") == "evenodd" else ""
    yield f"B{rule}" if fill and stroke else f"f{rule}" if fill else "S"


def _segments(path: Any) -> Iterator[str]:
    from svgelements import Close, CubicBezier, Line, Move, QuadraticBezier

    for segment in path:
        match segment:
            case Move():
                yield f"{_point(segment.end)} m"
            case Close():
                yield "h"
            case Line():
                yield f"{_point(segment.end)} l"
            case CubicBezier():
                yield f"{_point(segment.control1)} {_point(segment.control2)} {_point(segment.end)} c"
            case QuadraticBezier():
                a, b, c = segment.start, segment.control, segment.end
                yield f"{_point(a + (b - a) * (2 / 3))} {_point(c + (b - c) * (2 / 3))} {_point(c)} c"


def _text(text: Any, fonts: PageFonts) -> Iterator[str]:
    words, fill = (text.text or "").strip(), _color(text.fill)
    if not words or not fill:
        return
    size, shown = float(text.font_size or 0.0), fonts.set_text(words)
    back = {"middle": 0.5, "end": 1.0}.get(text.anchor, 0.0) * size * shown.width
    m = text.transform
    x, y = float(text.x or 0.0) - back, float(text.y or 0.0)
    placed = (m.a, m.b, -m.c, -m.d, m.a * x + m.c * y + m.e, m.b * x + m.d * y + m.f)
    font, matrix = f"/{shown.font} {number(size)} Tf", " ".join(number(v, 6) for v in placed)
    yield f"BT {fill} rg {font} {matrix} Tm <{shown.data.hex()}> Tj ET"


def _color(color: Any) -> str:
    """Red, green and blue from 0 to 1; empty where there is none."""
    if color is None or color.value is None or color.opacity == 0.0:
        return ""
    return " ".join(number(channel / 255.0, 4) for channel in (color.red, color.green, color.blue))


def _dashes(shape: Any, scale: float) -> str:
    return f"[{' '.join(number(length) for length in dashes_of(shape, scale))}] 0"


def _point(point: Any) -> str:
    return f"{number(point.x, 4)} {number(point.y, 4)}"
