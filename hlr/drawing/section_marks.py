"""How a section is marked on a page of arranged views (ISO 128): by a cutting line in another view, and by its name.

The view sees the plane from its edge; the line has thick ends, arrows and letters. The name stands above the section.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from hlr.drawing.view_marks import FONT, LETTER, Point, SectionEnd, section_ends

EDGE_ON = 1e-6
"""Sine of the angle by which the plane of a section may be turned to be seen as a line."""

BEYOND = 5.0
"""Millimetres: how far a cutting line goes beyond the view, with its thick ends."""

TAIL = 9.0
"""Millimetres: length of an arrow and its tail."""

ASIDE = 0.5 * TAIL
"""Millimetres from a line to the middle of its letters, over the arrows: those of opposite views lie apart."""

ABOVE = 3.0
"""Millimetres from a view to the name above it."""

REACH = BEYOND + 1.5 * LETTER
"""Millimetres from a view to the farthest point of its marks."""

FARTHER = 9.0
"""Millimetres by which an end of a cutting line goes farther where its arrow would lie over the end beside it."""

JOG = 2.5
"""Millimetres: how long a cutting line is thick on both sides of a corner, where it jogs."""

CHAIN = (6.0, 1.0, 1.0, 1.0)
"""Millimetres: dashes and gaps of a cutting line."""


@dataclass(frozen=True, slots=True)
class SectionMark:
    """The marks of one section on a page.

    letter  A for the section A-A
    name    the middle of that name, above the view: millimetres from the lower left corner of the page
    line    the cutting line from end to end, with its corners where the plane steps, in the same millimetres; None
            where no view sees the plane from its edge
    back    the direction on the page from the line to the viewer of the section, of length 1
    """

    letter: str
    name: Point
    line: tuple[Point, ...] | None = None
    back: Point = (0.0, 0.0)

    @property
    def title(self) -> str:
        """A-A."""
        return f"{self.letter}-{self.letter}"


@dataclass(frozen=True, slots=True)
class MarkShapes:
    """What is drawn of a mark. wide, chain: lines, the latter thin, dashed and dotted; texts: by their middles."""

    wide: list[tuple[Point, Point]]
    chain: list[tuple[Point, Point]]
    arrows: list[tuple[Point, Point, Point]]
    texts: list[tuple[Point, str]]


def shapes_of(mark: SectionMark) -> MarkShapes:
    """The lines, arrows and texts of a mark."""
    texts = [(mark.name, mark.title)]
    if mark.line is None:
        return MarkShapes([], [], [], texts)
    line = mark.line
    ends: Sequence[SectionEnd] = [
        section_ends(line[:2], mark.back, TAIL, ASIDE)[0],
        section_ends(line[-2:], mark.back, TAIL, ASIDE)[1],
    ]
    inner = _toward(line[0], line[1], BEYOND), _toward(line[-1], line[-2], BEYOND)
    wide = [(line[0], inner[0]), (line[-1], inner[1]), *(end.tail for end in ends)]
    for before, corner, after in zip(line, line[1:], line[2:], strict=False):
        wide += [(corner, _toward(corner, other, JOG)) for other in (before, after)]
    chain = list(pairwise((inner[0], *line[1:-1], inner[1])))
    return MarkShapes(wide, chain, [end.arrow for end in ends], [*((end.letter, mark.letter) for end in ends), *texts])


def marks_svg(marks: Sequence[SectionMark], height: float, color: str, widths: tuple[float, float]) -> str:
    """The marks as SVG, in millimetres from the upper left corner of a page of this height.

    widths: of wide and narrow lines
    """
    return "".join(_svg(shapes_of(mark), height, color, widths) for mark in marks)


def _svg(shapes: MarkShapes, height: float, color: str, widths: tuple[float, float]) -> str:
    def steps(points: Sequence[Point]) -> str:
        return "M" + "L".join(f"{_n(x)} {_n(height - y)}" for x, y in points)

    wide, narrow = (_n(width) for width in widths)
    out = [f'<g class="section" fill="none" stroke="{color}" stroke-width="{wide}">']
    if shapes.wide:
        out.append(f'<path d="{"".join(map(steps, shapes.wide))}"/>')
    dashes = " ".join(map(_n, CHAIN))
    out += [f'<path stroke-width="{narrow}" stroke-dasharray="{dashes}" d="{steps(line)}"/>' for line in shapes.chain]
    if shapes.arrows:
        out.append(f'<path fill="{color}" stroke="none" d="{"".join(steps(each) + "Z" for each in shapes.arrows)}"/>')
    for (x, y), text in shapes.texts:
        place = f'x="{_n(x)}" y="{_n(height - y + 0.35 * LETTER)}"'
        out.append(
            f'<text {place} font-family="{FONT}" font-size="{_n(LETTER)}" text-anchor="middle" fill="{color}" '
            f'stroke="none">{text}</text>'
        )
    return "".join([*out, "</g>\n"])


def _toward(end: Point, other: Point, length: float) -> Point:
    """Where a thick piece of a line ends that is so long, but no longer than half of the line."""
    way = (other[0] - end[0], other[1] - end[1])
    share = min(length / (float((way[0] ** 2 + way[1] ** 2) ** 0.5) or 1.0), 0.5)
    return end[0] + share * way[0], end[1] + share * way[1]


def _n(value: float) -> str:
    return f"{value:.4f}".rstrip("0").rstrip(".") or "0"
