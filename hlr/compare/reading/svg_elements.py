"""What an SVG file draws: its shapes, each with the map to paper and the style that hold for it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from hlr.compare.reading.affine import Y_UP, Affine, scaling, transform_of

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

SVG = "{http://www.w3.org/2000/svg}"

GROUPS = frozenset(("svg", "g", "a"))
SHAPES = frozenset(("path", "line", "polyline", "polygon", "rect", "circle", "ellipse"))
TEXTS = frozenset(("text", "image"))

_UNITS = {"mm": 1.0, "cm": 10.0, "in": 25.4, "pt": 25.4 / 72.0, "pc": 25.4 / 6.0, "px": 25.4 / 96.0, "": 25.4 / 96.0}
_LENGTH = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([a-z]*)\s*")


@dataclass(frozen=True, slots=True)
class Style:
    """How lines are drawn, as far as it tells what they are. words: of the names of all groups around, in small."""

    fill: str = "black"
    stroke: str = "none"
    width: float = 1.0
    dash: str = "none"
    cap: str = "butt"
    join: str = "miter"
    words: str = ""

    @property
    def dashed(self) -> bool:
        """Whether the line has gaps."""
        return self.dash not in ("none", "", "0")


@dataclass(frozen=True, slots=True)
class Shape:
    """An element that is drawn. group: number of the group that it stands in."""

    name: str
    element: Element
    to_paper: Affine
    style: Style
    group: int


def shapes(root: Element, start: Affine, top: Element | None = None) -> Iterator[Shape]:
    """All that is drawn, in the order of the file, texts and images too. top: draw what is inside this element only."""
    open_groups: list[tuple[Element, Affine, Style, bool, int]] = [(root, start, Style(), top is None, 0)]
    groups = 0
    while open_groups:
        element, outer, outer_style, inside, group = open_groups.pop()
        name = element.tag.removeprefix(SVG) if isinstance(element.tag, str) else ""
        if name not in GROUPS | SHAPES | TEXTS or element.get("display") == "none":
            continue
        to_paper = outer.after(transform_of(element.get("transform", "")))
        style = _style(element, outer_style, name in GROUPS)
        if name in GROUPS:
            groups += 1
            within = inside or element is top
            open_groups.extend((child, to_paper, style, within, groups) for child in reversed(element))
        elif inside:
            yield Shape(name, element, to_paper, style, group)


def to_millimetres(root: Element) -> Affine:
    """From the coordinates of a document to paper, y up: by its width and its viewBox."""
    box = [float(each) for each in root.get("viewBox", "").replace(",", " ").split()]
    size = _LENGTH.fullmatch(root.get("width", ""))
    if size is None or size[2] not in _UNITS:
        return Y_UP
    width = float(size[1]) * _UNITS[size[2]]
    if len(box) != 4:
        return Y_UP.after(scaling(_UNITS[size[2]]))
    if box[2] <= 0.0 or width <= 0.0:
        raise ValueError("its page has no width")
    return Y_UP.after(scaling(width / box[2])).after(Affine(e=-box[0], f=-box[1]))


def height_mm(root: Element) -> float:
    """Of the page; 0 where it does not say."""
    size = _LENGTH.fullmatch(root.get("height", ""))
    return float(size[1]) * _UNITS[size[2]] if size is not None and size[2] in _UNITS else 0.0


_KEYS = {
    "fill": "fill",
    "stroke": "stroke",
    "stroke-dasharray": "dash",
    "stroke-linecap": "cap",
    "stroke-linejoin": "join",
}


def _style(element: Element, outer: Style, group: bool) -> Style:
    """The style that holds for an element: attributes, and over them what its attribute `style` says."""
    said = dict(element.attrib)
    for rule in element.get("style", "").split(";"):
        key, _, value = rule.partition(":")
        said[key.strip()] = value.strip()
    found = {field: said[key].strip() for key, field in _KEYS.items() if key in said}
    width = _LENGTH.fullmatch(said.get("stroke-width", ""))
    words = outer.words
    if group:
        named = (value for key, value in element.attrib.items() if key.rpartition("}")[2] in ("id", "class", "label"))
        words = " ".join([words, *named]).strip().lower()
    return replace(outer, width=float(width[1]) if width else outer.width, words=words, **found)
