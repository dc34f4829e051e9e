"""The pens of a drawing: what its style makes of each of its lines."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from operator import attrgetter
from typing import TYPE_CHECKING

from hlr.common.colors import hex_of, readable
from hlr.request.part_names import matches
from hlr.request.style import Cap, LineRule, Style, Width
from hlr.request.style_check import CURRENT

if TYPE_CHECKING:
    from hlr.drawing.drawing import Drawing, DrawnPart

WIDE_MM, LARGE_WIDE_MM = 0.5, 0.7
"""Wide lines of ISO 128, where the style says no other: on sheets up to A2, and on larger ones."""

LINE_GROUPS = ((0.7, 0.35), (0.5, 0.25), (0.35, 0.18), (0.25, 0.13))
"""Wide and narrow lines of ISO 128, millimetres, the thinnest last."""

A2 = (420.0, 594.0)
"""Millimetres."""

_WEIGHT = attrgetter("weight")


@dataclass(frozen=True, slots=True)
class Pen:
    """How a line is drawn.

    width  millimetres
    color  #rrggbb, or currentColor
    dash   dash and gap in millimetres; None: continuous
    cap    how it ends
    """

    width: float
    color: str
    dash: tuple[float, float] | None
    cap: Cap

    @property
    def solid(self) -> str:
        """The colour for formats that know no currentColor: #rrggbb."""
        return "#000000" if self.color == CURRENT else self.color


@dataclass(frozen=True, slots=True)
class PenSet:
    """The pens of parts that are drawn alike.

    parts         their indices in `Drawing.parts`
    rules         of their lines, the more general ones first
    wide, narrow  millimetres
    """

    parts: tuple[int, ...]
    rules: tuple[LineRule, ...]
    wide: float
    narrow: float
    _pens: dict[tuple[str | None, bool], Pen] = field(default_factory=dict, repr=False, compare=False)

    def of(self, parts: Sequence[int]) -> PenSet:
        """The same pens for these parts."""
        return PenSet(tuple(parts), self.rules, self.wide, self.narrow, self._pens)

    def pen(self, kind: str | None, visible: bool) -> Pen:
        """The pen of a line class; kind None: what holds for all classes. Worked out once."""
        pen = self._pens.get((kind, visible))
        if pen is None:
            pen = self._pens[kind, visible] = self._pen(kind, visible)
        return pen

    def _pen(self, kind: str | None, visible: bool) -> Pen:
        width: Width = "wide"
        color, dash, cap = "#000000", None, None
        for rule in self.rules:
            if rule.visible in (None, visible) and rule.kind in (None, kind):
                width = rule.width or width
                color = rule.color or color
                dash = dash if rule.dash is None else rule.dash
                cap = rule.cap or cap
        wide = self.wide if width == "wide" else self.narrow if width == "narrow" else width
        lengths = (dash[0] * wide, dash[1] * wide) if dash else None
        return Pen(wide, color, lengths, "butt" if dash else cap or "round")


def widths_of(
    style: Style, sheet: tuple[float, float], group: tuple[float, float] | None = None
) -> tuple[float, float]:
    """The wide and the narrow lines of a style, millimetres.

    sheet: width and height, millimetres; group: what stands for the sheet's line group where lines are crowded
    """
    if group is not None and style.wide is None and style.narrow is None:
        return group
    short, long = sorted(sheet)
    usual = WIDE_MM if short <= A2[0] and long <= A2[1] else LARGE_WIDE_MM
    wide = usual if style.wide is None else style.wide
    return wide, 0.5 * wide if style.narrow is None else style.narrow


def usual_pens(style: Style, sheet: tuple[float, float] = A2, group: tuple[float, float] | None = None) -> PenSet:
    """The pens of parts for which the style has no rules of their own; sheet, group: as of `widths_of`."""
    rules = sorted([rule for rule in style.lines if rule.parts is None], key=_WEIGHT)
    return PenSet((), tuple(rules), *widths_of(style, sheet, group))


def usual_pens_of(drawing: Drawing) -> PenSet:
    """The same, of a drawing."""
    area = drawing.area
    return usual_pens(drawing.style, (area.width, area.height), drawing.group)


def pens_of(drawing: Drawing, usual: PenSet) -> list[PenSet]:
    """Sets of parts that are drawn alike, each with its pens; every part is in one set. usual: `usual_pens_of` it."""
    sets = []
    for own, parts in _alike(drawing, [rule for rule in drawing.style.lines if rule.parts is not None]).items():
        if own:
            rules = sorted((*usual.rules, *own), key=_WEIGHT)
            sets.append(PenSet(tuple(parts), tuple(rules), usual.wide, usual.narrow))
        else:
            sets.append(usual.of(parts))
    return sets


def _alike(drawing: Drawing, special: Sequence[LineRule]) -> dict[tuple[LineRule, ...], Sequence[int]]:
    """Parts that are drawn alike, by the rules of their own. special: rules that name parts."""
    style = drawing.style
    if drawing.parts and not special and style.part_colors != "lines":
        return {(): range(len(drawing.parts))}
    alike: dict[tuple[LineRule, ...], list[int]] = {}
    for index, part in enumerate(drawing.parts):
        names = (_called(part, drawing), *part.above)
        own = tuple(rule for rule in special if any(matches(name, str(rule.parts)) for name in names))
        color = part_color(part) if style.part_colors == "lines" else None
        if color is not None:
            # In place of the colour of all lines; what is said of hidden lines, or of a class, holds all the same.
            own = (LineRule(color=readable(color, style.background or "#ffffff")), *own)
        alike.setdefault(own, []).append(index)
    return dict(alike)


def _called(part: DrawnPart, drawing: Drawing) -> str:
    """The name of a part in its model: on a page of arranged views it is called by its view as well, front/bolt."""
    arranged = drawing.sheet is not None and drawing.sheet.method
    return part.name.partition("/")[2] if arranged else part.name


def by_part(sets: Sequence[PenSet]) -> dict[int, PenSet]:
    """The set of each part."""
    return {part: one for one in sets for part in one.parts}


def part_color(part: DrawnPart) -> str | None:
    """#rrggbb; None where the model says none."""
    if part.color is None:
        return None
    return hex_of(tuple(round(255 * min(1.0, max(0.0, channel))) for channel in part.color))
