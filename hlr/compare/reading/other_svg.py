"""SVG of other programs: which of its shapes are lines of the drawing, and which of those are hidden.

FreeCAD's TechDraw writes fragments of a view (`viewPartAsSvg`: the visible lines, then the hidden ones, thinner),
of a projection (`projectToSVG`: the hidden ones dashed) and pages (`exportPageAsSvg`: the template, and then the group
`DrawingContent` with faces, edges and dimensions of one view after another). Others dash hidden lines, or say so in
the names of groups.
"""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Callable
from typing import TYPE_CHECKING

from hlr.compare.lines.sketch import About, Sketch, Trait
from hlr.compare.reading.affine import Y_UP, Affine
from hlr.compare.reading.path_data import add_path
from hlr.compare.reading.svg_elements import TEXTS, Shape, height_mm, shapes, to_millimetres

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

_CONTENT = "DrawingContent"
"""Name of the group in which TechDraw puts what is drawn; all else is the template."""

_HAIR = 1.0
"""Width of every edge in pages of FreeCAD 0.20; dimensions keep theirs."""

_WORDS = ((re.compile(r"hidden|verdeckt|invisible"), 0), (re.compile(r"visible|sichtbar"), 1))
"""In names of groups and layers, and whether their lines are visible."""


def read_other(root: Element, sketch: Sketch, fragment: bool) -> About:
    """Add the lines of a document of another program, or of a fragment of one.

    Raises ValueError where numbers are damaged.
    """
    content = next((each for each in root.iter() if each.get("id") == _CONTENT), None)
    start = Y_UP if fragment else to_millimetres(root)
    if content is not None:
        start = Affine(f=height_mm(root)).after(start)  # from the lower left corner of the page
    every = list(shapes(root, start, content))
    left_out: Counter[str] = Counter()
    lines = []
    for shape in every:
        sort = _sort(shape)
        if sort == "lines":
            lines.append(shape)
        else:
            left_out[sort] += 1
    if content is not None:
        edges = _edges_of_pages(lines)
        left_out["lines of dimensions and hatches"] = len(lines) - len(edges)
        lines = edges
    seen = _visibility(lines, fragment)
    views: dict[tuple[float, float], int] = {}
    for shape, visible in zip(lines, seen, strict=True):
        view = -1
        if content is not None:
            place = round(shape.to_paper.e, 3), round(shape.to_paper.f, 3)
            view = views.setdefault(place, len(views))
        sketch.begin(Trait(-1, visible, view=view))
        _add(sketch, shape)
    names = tuple(f"at ({x:g}, {y:g})" for x, y in views)
    return About((), None, views=names, foreign=True, left_out={key: n for key, n in left_out.items() if n})


def _sort(shape: Shape) -> str:
    """What a shape is: a line, or what it is counted as."""
    if shape.name in TEXTS:
        return "texts and pictures"
    if shape.style.stroke == "none":
        return "faces"
    return "lines" if shape.style.fill == "none" or shape.name == "line" else "arrows and filled shapes"


def _edges_of_pages(lines: list[Shape]) -> list[Shape]:
    """The edges of views: TechDraw draws each as one path without a gap, with round ends and bevelled corners."""
    edges = [
        shape
        for shape in lines
        if shape.name == "path"
        and (shape.style.cap, shape.style.join) == ("round", "bevel")
        and sum(shape.element.get("d", "").count(letter) for letter in "Mm") == 1
    ]
    return [shape for shape in edges if shape.style.width == _HAIR] or edges


def _visibility(lines: list[Shape], fragment: bool) -> list[int]:
    """1 visible, 0 hidden, -1 where nothing tells, of each line."""
    dashed = any(shape.style.dashed for shape in lines)
    widths = sorted({shape.style.width for shape in lines})
    thin = widths[0] if fragment and not dashed and len(widths) == 2 else None
    return [_visible(shape, dashed, thin, fragment) for shape in lines]


def _visible(shape: Shape, dashed: bool, thin: float | None, fragment: bool) -> int:
    for word, visible in _WORDS:
        if word.search(shape.style.words):
            return visible
    if dashed:
        return 0 if shape.style.dashed else 1
    if thin is not None:
        return 0 if shape.style.width == thin else 1
    return 1 if fragment else -1


def _add(sketch: Sketch, shape: Shape) -> None:
    element, to_paper = shape.element, shape.to_paper

    def number(key: str) -> float:
        return float(element.get(key, "0").strip().removesuffix("mm").removesuffix("px"))

    if shape.name == "path":
        add_path(sketch, element.get("d", ""), to_paper)
    elif shape.name in ("circle", "ellipse"):
        rx, ry = (number("r"), number("r")) if shape.name == "circle" else (number("rx"), number("ry"))
        axes = to_paper.way((rx, 0.0)), to_paper.way((0.0, ry))
        sketch.arc(to_paper.point((number("cx"), number("cy"))), axes, (0.0, math.tau))
    else:
        sketch.polyline([to_paper.point(each) for each in _corners(shape, number)])


def _corners(shape: Shape, number: Callable[[str], float]) -> list[tuple[float, float]]:
    if shape.name == "line":
        return [(number("x1"), number("y1")), (number("x2"), number("y2"))]
    if shape.name == "rect":
        x, y, wide, high = (number(key) for key in ("x", "y", "width", "height"))
        return [(x, y), (x + wide, y), (x + wide, y + high), (x, y + high), (x, y)]
    numbers = [float(each) for each in shape.element.get("points", "").replace(",", " ").split()]
    if len(numbers) % 2:
        raise ValueError("a polyline has an odd number of coordinates")
    points = list(zip(numbers[::2], numbers[1::2], strict=True))
    return points + points[:1] if shape.name == "polygon" else points
