"""What a page has printed on it, in DXF: the lines, filled areas and texts of its template, on a layer of their own.

Curves are polylines. What is filled white is left out: it is paper, and DXF shows white as black on paper. R12 has no
filled areas, and no widths.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import atan2, ceil, degrees, hypot, sqrt
from typing import TYPE_CHECKING, Any

from hlr.common.colors import hex_of
from hlr.errors import WriteError
from hlr.writers.dxf_layers import CONTRAST, TEMPLATE, lineweight, nearest_color
from hlr.writers.dxf_text import clean
from hlr.writers.template_elements import dashes_of, shown_elements

if TYPE_CHECKING:
    from ezdxf.document import Drawing as Document

PAPER = "#ffffff"

ERROR = 0.01
"""Millimetres between a curve and its polyline."""

MOST_PIECES = 200
"""Of one curve."""

CAPITALS = 0.7
"""Height of capitals in sizes of a font: the height of a text in DXF."""

ALIGNED = {"middle": "CENTER", "end": "RIGHT"}

Point = tuple[float, float]


def add_template(document: Document, template: str, left: float, top: float, modern: bool, true_colors: bool) -> None:
    """Add a template to the model space.

    template: as of `hlr.drawing.sheet.Sheet`; left, top: of the page, in the drawing's coordinates; modern: the version
        is not R12; true_colors: it has other colours than the 255

    Raises:
        WriteError: the template is no SVG that can be drawn.
    """
    from svgelements import Text

    document.layers.add(TEMPLATE, color=CONTRAST)
    target = _Target(document, left, top, modern, true_colors)
    try:
        for element in shown_elements(template):
            if isinstance(element, Text):
                _add_text(target, element)
            else:
                _add_shape(target, element)
    except Exception as error:  # whatever a broken file makes the library raise
        raise WriteError(
            f"the template of the page cannot be drawn in DXF ({type(error).__name__}): write SVG"
        ) from None


@dataclass(frozen=True, slots=True)
class _Target:
    document: Document
    left: float
    top: float
    modern: bool
    true_colors: bool

    def at(self, point: Any) -> Point:
        """A point of the template, in the drawing's coordinates."""
        return round(self.left + float(point[0]), 6), round(self.top - float(point[1]), 6)

    def look(self, color: Any) -> dict[str, Any] | None:
        """Layer and colour; None: nothing is painted."""
        if color is None or color.value is None or color.opacity == 0.0:
            return None
        shown = hex_of((color.red, color.green, color.blue))
        if shown == PAPER:
            return None
        number, rgb = nearest_color(shown)
        own = {} if number == CONTRAST else {"color": number}
        if rgb is not None and self.true_colors:
            own["true_color"] = rgb
        return {"layer": TEMPLATE, **own}

    def linetype(self, lengths: Sequence[float]) -> str:
        """The name of a linetype with these dashes and gaps."""
        even = [*lengths, *lengths] if len(lengths) % 2 else lengths
        pattern = [round(-length if k % 2 else length, 3) for k, length in enumerate(even)]
        name = "TEMPLATE_" + "_".join(f"{abs(length):g}".replace(".", "-") for length in pattern)
        if name not in self.document.linetypes:
            self.document.linetypes.add(name, [round(sum(map(abs, pattern)), 3), *pattern])
        return name


def _add_shape(target: _Target, shape: Any) -> None:
    from svgelements import Path

    scale = abs(shape.transform.determinant) ** 0.5
    path = abs(Path(shape))  # with its transforms applied
    path.approximate_arcs_with_cubics()
    runs = [(points, closed) for points, closed in _runs(target, path) if len(points) > 1]
    model = target.document.modelspace()
    areas = [points for points, _ in runs if len(points) > 2]
    if areas and target.modern and (filled := target.look(shape.fill)):
        hatch = model.add_hatch(color=filled.pop("color", CONTRAST), dxfattribs={"hatch_style": 0, **filled})
        for points in areas:
            hatch.paths.add_polyline_path(points, is_closed=True)
    stroked = target.look(shape.stroke)
    if stroked is None:
        return
    if target.modern:
        stroked["lineweight"] = lineweight(float(shape.stroke_width or 0.0) * scale)
    if lengths := dashes_of(shape, scale):
        stroked["linetype"] = target.linetype(lengths)
    for points, closed in runs:
        if len(points) == 2:
            model.add_line(*points, dxfattribs=stroked)
        elif target.modern:
            model.add_lwpolyline(points, close=closed, dxfattribs=stroked)
        else:
            model.add_polyline2d(points, close=closed, dxfattribs=stroked)


def _runs(target: _Target, path: Any) -> Iterator[tuple[list[Point], bool]]:
    """The polylines of a path, and whether each is closed."""
    from svgelements import Close, Line, Move

    points: list[Point] = []
    for segment in path:
        if isinstance(segment, Move):
            yield points, False
            points = [target.at(segment.end)]
        elif isinstance(segment, Close):
            yield points, True
            points = [target.at(segment.end)] if segment.end is not None else []
        else:
            pieces = 1 if isinstance(segment, Line) else _pieces(segment)
            points += [target.at(segment.point(k / pieces)) for k in range(1, pieces + 1)]
    yield points, False


def _pieces(curve: Any) -> int:
    """Into how many chords a Bezier curve is divided."""
    names = ("start", "control", "control1", "control2", "end")
    controls = [getattr(curve, name) for name in names if hasattr(curve, name)]
    bend: float = max(
        hypot(a[0] - 2 * b[0] + c[0], a[1] - 2 * b[1] + c[1])
        for a, b, c in zip(controls, controls[1:], controls[2:], strict=False)
    )
    return min(max(1, ceil(sqrt(0.75 * bend / ERROR))), MOST_PIECES)


def _add_text(target: _Target, text: Any) -> None:
    words, look = " ".join((text.text or "").split()), target.look(text.fill)
    m = text.transform
    size = float(text.font_size or 0.0) * hypot(m.c, m.d)
    if not words or look is None or size <= 0.0:
        return
    from ezdxf.enums import TextEntityAlignment

    x, y = float(text.x or 0.0), float(text.y or 0.0)
    added = target.document.modelspace().add_text(
        clean(words), height=round(CAPITALS * size, 6), rotation=round(degrees(atan2(-m.b, m.a)), 6), dxfattribs=look
    )
    place = target.at((m.a * x + m.c * y + m.e, m.b * x + m.d * y + m.f))
    added.set_placement(place, align=TextEntityAlignment[ALIGNED.get(text.anchor, "LEFT")])
