"""Rich texts of a FreeCAD page: lines of HTML with their sizes, colours, bold and slanted letters."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from html.parser import HTMLParser
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from hlr.common.text_width import text_width
from hlr.drawing.view_marks import FONT, Point
from hlr.source.freecad.document import Object

MM_PER_POINT = 25.4 / 72.0

USUAL = 10.0 * MM_PER_POINT
"""Size of letters where a text says none, millimetres."""

LINE, MARGIN, BOLDER = 1.25, 0.4, 1.08
"""Height of a line in its size; millimetres between a text and its frame; how much wider bold letters are."""


@dataclass(frozen=True, slots=True)
class Style:
    """How letters look: size in millimetres."""

    size: float = USUAL
    color: str = "#000000"
    bold: bool = False
    slanted: bool = False


Line = list[tuple[str, Style]]


def rich_text(thing: Object, place: Point, height: float) -> str:
    """A rich text about its place on the page, in its frame. height: of the page."""
    values, view = thing.values, thing.view
    reader = _Reader()
    reader.feed(values.text("AnnoText"))
    lines = list(_wrapped([line for line in reader.lines if line], values.number("MaxWidth", -1.0)))
    wide = max((_width(line) for line in lines), default=0.0) + 2.0 * MARGIN
    sizes = [max(style.size for _, style in line) for line in lines]
    deep = LINE * sum(sizes) + 2.0 * MARGIN
    x, y = place[0], height - place[1]
    group = Element("g", {"font-family": FONT})
    group.set("transform", f"translate({x:g} {y:g}) rotate({0.0 - values.number('Rotation', 0.0):g})")
    if values.flag("ShowFrame", True):
        box = {"x": -0.5 * wide, "y": -0.5 * deep, "width": wide, "height": deep}
        frame = ElementTree.SubElement(group, "rect", {key: f"{value:.4f}" for key, value in box.items()})
        color = int(view.number("LineColor", 0.0)) >> 8 & 0xFFFFFF
        frame.attrib.update({"fill": "none", "stroke": f"#{color:06x}"})
        frame.set("stroke-width", f"{view.number('LineWidth', 0.35):g}")
    below = MARGIN - 0.5 * deep
    for line, size in zip(lines, sizes, strict=True):
        below += LINE * size
        group.extend(_letters(line, MARGIN - 0.5 * wide, below - 0.25 * size))
    return ElementTree.tostring(group, encoding="unicode") + "\n"


def _letters(line: Line, x: float, y: float) -> Iterator[Element]:
    for words, style in line:
        # Blanks at the ends of an element do not count in SVG.
        x += _width([(words[: len(words) - len(words.lstrip())], style)])
        text = Element("text", {"x": f"{x:.4f}", "y": f"{y:.4f}", "font-size": f"{style.size:g}", "fill": style.color})
        if style.bold:
            text.set("font-weight", "bold")
        if style.slanted:
            text.set("font-style", "italic")
        text.text = words.strip()
        x += _width([(words.lstrip(), style)])
        yield text


def _width(line: Line) -> float:
    return sum(text_width(words) * style.size * (BOLDER if style.bold else 1.0) for words, style in line)


def _wrapped(lines: list[Line], most: float) -> Iterator[Line]:
    """Lines that are at most this wide, millimetres, as far as their words allow; not positive: as they are."""
    for line in lines:
        begun: Line = []
        words = [(word, style) for text, style in line for word in re.findall(r"\S+\s*|\s+", text)]
        for word, style in words if most > 0.0 else ():
            if begun and _width([*begun, (word.rstrip(), style)]) > most:
                yield begun
                begun = []
            before = begun.pop()[0] if begun and begun[-1][1] == style else ""
            begun.append((before + word, style))
        yield begun or line


class _Reader(HTMLParser):
    """Collects the lines of a text. Unknown elements count for the text in them."""

    def __init__(self) -> None:
        super().__init__()
        self.lines: list[Line] = [[]]
        self._open: list[tuple[str, Style]] = []
        self._silent = 0

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag in _BREAKS:
            self.lines.append([])
        if tag in _VOID:
            return
        style = self._open[-1][1] if self._open else Style()
        style = replace(style, bold=style.bold or tag in _BOLD, slanted=style.slanted or tag in _SLANTED)
        self._open.append((tag, _styled(style, dict(attrs).get("style") or "")))
        self._silent += tag in _SILENT

    def handle_endtag(self, tag: str) -> None:
        while any(name == tag for name, _ in self._open):
            name, _ = self._open.pop()
            self._silent -= name in _SILENT
            if name == tag:
                break

    def handle_data(self, data: str) -> None:
        words = re.sub(r"\s+", " ", data)
        if self._silent or (not words.strip() and not self.lines[-1]):
            return
        self.lines[-1].append((words, self._open[-1][1] if self._open else Style()))


def _styled(style: Style, css: str) -> Style:
    said = {name.strip(): value.strip() for name, _, value in (each.partition(":") for each in css.lower().split(";"))}
    if size := re.fullmatch(r"(\d{1,4}(?:\.\d+)?)(pt|px)", said.get("font-size", "")):
        style = replace(style, size=float(size[1]) * (MM_PER_POINT if size[2] == "pt" else 25.4 / 96.0))
    if re.fullmatch(r"#[0-9a-f]{6}", color := said.get("color", "")):
        style = replace(style, color=color)
    if weight := said.get("font-weight"):
        style = replace(style, bold=weight == "bold" or (weight.isdigit() and int(weight) >= 600))
    if slant := said.get("font-style"):
        style = replace(style, slanted=slant in ("italic", "oblique"))
    return style


_BREAKS = {"p", "br", "div", "li", "tr", "h1", "h2", "h3"}
_VOID = {"br", "meta", "hr", "img", "link", "input"}
_SILENT = {"style", "script", "title", "head"}
_BOLD, _SLANTED = {"b", "strong", "h1", "h2", "h3"}, {"i", "em"}
