"""How a section and a detail are marked in the view that they are made of: a line with arrows, a circle. As SVG."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

Point = tuple[float, float]

FONT = "osifont, Arial, Helvetica, sans-serif"

ARROW, HALF_ARROW = 5.0, 0.85
"""Millimetres: an arrow's length, and half of its width."""

BEYOND, TAIL, LETTER = 10.0, 12.0, 5.0
"""Millimetres: how far a section line reaches beyond what it cuts, length of an arrow and its tail, size of letters."""

WIDTH = 0.7
"""Of the lines, millimetres."""


@dataclass(frozen=True, slots=True)
class Mark:
    """The mark of a section or a detail. base: the name of the view in which it is; letter: A, X."""

    base: str
    letter: str
    color: str
    dashes: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class SectionEnd:
    """An end of a section line, on the page.

    arrow   its three corners, the tip first; tail: from its end to the arrow
    letter  the middle of the letter
    """

    arrow: tuple[Point, Point, Point]
    tail: tuple[Point, Point]
    letter: Point


def section_ends(
    ends: Sequence[Point], back: Point, tail: float = TAIL, aside: float = 0.0
) -> tuple[SectionEnd, SectionEnd]:
    """Both ends of a section line: each has an arrow that looks as the viewer of the section does.

    ends: two, on the page; back: from there to the viewer, of length one; tail: of the arrow with its tail, millimetres
    aside: from the line to the letter, toward the viewer, millimetres
    """
    a, b = ends
    along = _unit((b[0] - a[0], b[1] - a[1]))
    one, other = (_section_end(end, side, along, back, tail, aside) for end, side in ((a, -1.0), (b, 1.0)))
    return one, other


def _section_end(end: Point, side: float, along: Point, back: Point, tail: float, aside: float) -> SectionEnd:
    x, y = end
    neck = (x + ARROW * back[0], y + ARROW * back[1])
    left, right = (
        (neck[0] + turn * HALF_ARROW * back[1], neck[1] - turn * HALF_ARROW * back[0]) for turn in (1.0, -1.0)
    )
    begin = (x + tail * back[0], y + tail * back[1])
    beyond = (side * LETTER * along[0] + aside * back[0], side * LETTER * along[1] + aside * back[1])
    letter = (x + beyond[0], y + beyond[1])
    return SectionEnd((end, left, right), (begin, neck), letter)


def section_line(mark: Mark, ends: tuple[Point, Point], back: Point, height: float) -> str:
    """A section line as SVG, from end to end; arguments as of `section_ends`, and the height of the page."""
    group = _group(mark)
    _line(group, mark, list(ends), height)
    for end in section_ends(ends, back):
        _line(group, mark, list(end.tail), height)
        arrow = ElementTree.SubElement(group, "path", {"d": _steps(list(end.arrow), height) + " Z"})
        arrow.attrib.update({"fill": mark.color, "stroke": "none"})
        _letter(group, mark, end.letter, height)
    return _written(group)


def detail_circle(mark: Mark, middle: Point, radius: float, letter: Point, height: float) -> str:
    """The circle around what a detail shows, and its letter, as SVG.

    middle, letter: on the page; radius: millimetres; height: of the page
    """
    group = _group(mark)
    circle = ElementTree.SubElement(group, "circle", {"cx": _n(middle[0]), "cy": _n(height - middle[1])})
    circle.attrib.update({"r": _n(radius), **_dashed(mark)})
    _letter(group, mark, letter, height)
    return _written(group)


def border_circle(middle: Point, radius: float, width: float, height: float) -> str:
    """The circle in which a detail is shown, as SVG; arguments as of `detail_circle`."""
    around = {"cx": _n(middle[0]), "cy": _n(height - middle[1]), "r": _n(radius), "stroke-width": _n(width)}
    return _written(Element("circle", {**around, "stroke": "#000000", "fill": "none"}))


def _group(mark: Mark) -> Element:
    return Element("g", {"stroke": mark.color, "stroke-width": _n(WIDTH), "fill": "none", "font-family": FONT})


def _line(group: Element, mark: Mark, points: list[Point], height: float) -> None:
    ElementTree.SubElement(group, "path", {"d": _steps(points, height), **_dashed(mark)})


def _dashed(mark: Mark) -> dict[str, str]:
    return {"stroke-dasharray": " ".join(_n(WIDTH * each) for each in mark.dashes)} if mark.dashes else {}


def _letter(group: Element, mark: Mark, middle: Point, height: float) -> None:
    place = {"x": _n(middle[0]), "y": _n(height - middle[1] + 0.35 * LETTER), "text-anchor": "middle"}
    text = ElementTree.SubElement(group, "text", {**place, "font-size": _n(LETTER)})
    text.attrib.update({"fill": mark.color, "stroke": "none"})
    text.text = mark.letter


def _steps(points: list[Point], height: float) -> str:
    return "M " + " L ".join(f"{_n(x)} {_n(height - y)}" for x, y in points)


def _unit(vector: Point) -> Point:
    length = (vector[0] ** 2 + vector[1] ** 2) ** 0.5 or 1.0
    return vector[0] / length, vector[1] / length


def _n(value: float) -> str:
    return f"{value:.4f}".rstrip("0").rstrip(".") or "0"


def _written(element: Element) -> str:
    return ElementTree.tostring(element, encoding="unicode") + "\n"
