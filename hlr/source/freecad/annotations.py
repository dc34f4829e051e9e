"""Annotations, balloons, leaders and texts of dimensions of a FreeCAD page, as SVG in mm from its upper left corner."""

from __future__ import annotations

import math
from collections.abc import Iterator
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from hlr.common.text_width import text_width
from hlr.drawing.view_marks import ARROW, FONT, HALF_ARROW, Point
from hlr.source.freecad.document import Object


def annotation(thing: Object, height: float) -> str:
    """The lines of an annotation, about its place. height: of the page."""
    values = thing.values
    size = values.number("TextSize", 5.0)
    lines = values.strings("Text")
    spacing = LINE * size * values.number("LineSpace", 80.0) / 100.0
    wide = max((text_width(line) for line in lines), default=0.0) * size
    x, y = values.number("X", 0.0), height - values.number("Y", 0.0)
    turn = values.number("Rotation", 0.0)
    group = Element("g", {"fill": _color(values.number("TextColor", 0.0)), "font-size": _n(size), "font-family": FONT})
    group.set("transform", f"translate({_n(x)} {_n(y)}) rotate({_n(-turn)})")
    for number, line in enumerate(lines):
        below = (number - 0.5 * (len(lines) - 1)) * spacing
        text = ElementTree.SubElement(group, "text", {"x": _n(-0.5 * wide), "y": _n(below)})
        text.text = line
    return _written(group)


LINE = 1.65
"""Height of a line of FreeCAD's font, in its size."""


def balloon(thing: Object, place: Point, scale: float, height: float) -> str:
    """A balloon with its line. place, scale: of the view that it belongs to; height: of the page."""
    values, view = thing.values, thing.view

    def on_page(x: str, y: str) -> Point:
        return place[0] + scale * values.number(x, 0.0), height - place[1] - scale * values.number(y, 0.0)

    tip, middle = on_page("OriginX", "OriginY"), on_page("X", "Y")
    size, color = view.number("Fontsize", 5.0), _color(view.number("Color", 0.0))
    words = values.text("Text")
    half = max(0.95 * size, 0.5 * text_width(words) * size + 0.35 * size) * values.number("ShapeScale", 1.0)
    shape = values.count("BubbleShape")
    group = Element("g", {"stroke": color, "stroke-width": _n(view.number("LineWidth", 0.35)), "fill": "none"})
    group.set("stroke-linejoin", "round")
    if view.flag("LineVisible", True):
        side = 1.0 if middle[0] >= tip[0] else -1.0
        reach = 0.0 if shape == NO_SHAPE else half
        kink = (middle[0] - side * (reach + values.number("KinkLength", 5.0)), middle[1])
        group.append(_path([tip, kink, (middle[0] - side * reach, middle[1])], close=False))
        group.extend(_end(values.count("EndType"), tip, kink, values.number("EndTypeScale", 1.0), color))
    group.extend(_bubble(shape, middle, half, 0.75 * size))
    text = {"x": _n(middle[0]), "y": _n(middle[1] + 0.35 * size), "font-size": _n(size), "font-family": FONT}
    letters = ElementTree.SubElement(group, "text", {**text, "text-anchor": "middle", "fill": color, "stroke": "none"})
    letters.text = words
    return _written(group)


def leader(thing: Object, place: Point, scale: float, height: float) -> str:
    """A leader of a view; empty where it has no two points. place, scale: of the view; height: of the page."""
    values, view = thing.values, thing.view
    # Up to 0.21 the points are kept in tenths of a millimetre, and their view does not scale them; y is down.
    old = "UseOldCoords" not in view or view.flag("UseOldCoords", False)
    unit = 0.1 if old else scale if values.flag("Scalable", False) else 1.0
    x, y = place[0] + scale * values.number("X", 0.0), height - place[1] - scale * values.number("Y", 0.0)
    points = [(x + unit * dx, y + unit * dy) for dx, dy, _ in values.vectors("WayPoints")]
    if len(points) < 2:
        return ""
    color = _color(view.number("Color", 0.0))
    group = Element("g", {"stroke": color, "stroke-width": _n(view.number("LineWidth", 0.35)), "fill": "none"})
    group.set("stroke-linejoin", "round")
    group.append(_path(points, close=False))
    group.extend(_end(values.count("StartSymbol"), points[0], points[1], 1.0, color))
    group.extend(_end(values.count("EndSymbol"), points[-1], points[-2], 1.0, color))
    return _written(group)


def dimension_text(thing: Object, place: Point, height: float) -> str:
    """The text of a dimension, where a user has written it; a value is not stored. place: of its view."""
    values, view = thing.values, thing.view
    if not values.flag("Arbitrary", False) or not values.text("FormatSpec").strip():
        return ""
    size = view.number("Fontsize", 5.0)
    text = Element("text", {"font-size": _n(size), "font-family": FONT, "text-anchor": "middle"})
    text.set("fill", _color(view.number("Color", 0.0)))
    # The place of a text is the middle of its box, which is higher than its letters.
    text.set("x", _n(place[0] + values.number("X", 0.0)))
    text.set("y", _n(height - place[1] - values.number("Y", 0.0) + 0.9 * size))
    text.text = values.text("FormatSpec")
    return _written(text)


def frame(thing: Object, height: float) -> str:
    """The frame of a clip; an empty group where it shows none. height: of the page."""
    values = thing.values
    group = Element("g", {"stroke": "#000000", "stroke-width": "0.35", "fill": "none"})
    if values.flag("ShowFrame", True):
        wide, high = values.number("Width", 0.0), values.number("Height", 0.0)
        x, y = values.number("X", 0.0) - 0.5 * wide, height - values.number("Y", 0.0) - 0.5 * high
        box = {"x": _n(x), "y": _n(y), "width": _n(wide), "height": _n(high)}
        ElementTree.SubElement(group, "rect", box)
    return _written(group)


NO_SHAPE, LINE_BELOW = 1, 7
"""Shapes of balloons as FreeCAD numbers them: 0 circle, 2 triangle, 3 inspection, 4 hexagon, 5 square, 6 rectangle."""

SIDES = {2: 3, 4: 6}
"""Of the shapes that are regular."""


def _bubble(shape: int, middle: Point, half: float, low: float) -> Iterator[Element]:
    """half: of its width; low: of its height, where that is another."""
    x, y = middle
    if shape == 0:
        yield Element("circle", {"cx": _n(x), "cy": _n(y), "r": _n(half)})
    elif shape in SIDES:
        count = SIDES[shape]
        # A triangle around the text is twice as large, with a corner up; a hexagon has one on each side.
        radius, first = (2.0 * half, -0.5 * math.pi) if count == 3 else (1.15 * half, 0.0)
        turns = [first + math.tau * i / count for i in range(count)]
        yield _path([(x + radius * math.cos(t), y + radius * math.sin(t)) for t in turns])
    elif shape == LINE_BELOW:
        yield _path([(x - half, y + low), (x + half, y + low)], close=False)
    elif shape != NO_SHAPE:
        high = half if shape == 5 else low
        box = {"x": _n(x - half), "y": _n(y - high), "width": _n(2.0 * half), "height": _n(2.0 * high)}
        yield Element("rect", {**box, **({"rx": _n(high)} if shape == 3 else {})})


def _end(kind: int, tip: Point, toward: Point, scale: float, color: str) -> Iterator[Element]:
    """What is at the end of a line: dot, circle, nothing, or else an arrow."""
    length = math.dist(tip, toward)
    if kind == 7 or length == 0.0:
        return
    if kind in (3, 4):
        radius = _n(HALF_ARROW * scale)
        yield Element(
            "circle", {"cx": _n(tip[0]), "cy": _n(tip[1]), "r": radius, "fill": color if kind == 3 else "none"}
        )
        return
    x, y = ((b - a) / length * scale for a, b in zip(tip, toward, strict=True))
    back = tip[0] + ARROW * x, tip[1] + ARROW * y
    left = back[0] - HALF_ARROW * y, back[1] + HALF_ARROW * x
    right = back[0] + HALF_ARROW * y, back[1] - HALF_ARROW * x
    arrow = _path([tip, left, right])
    arrow.set("fill", color)
    yield arrow


def _path(points: list[Point], *, close: bool = True) -> Element:
    steps = " L ".join(f"{_n(x)} {_n(y)}" for x, y in points)
    return Element("path", {"d": f"M {steps}{' Z' if close else ''}"})


def _color(packed: float) -> str:
    return f"#{int(packed) >> 8 & 0xFFFFFF:06x}"


def _n(value: float) -> str:
    return f"{value:.4f}".rstrip("0").rstrip(".") or "0"


def _written(element: Element) -> str:
    return ElementTree.tostring(element, encoding="unicode") + "\n"
