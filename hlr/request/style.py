"""The look of a drawing: one frozen record for lines, background, layers, colours of the parts, and files."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, get_args

from hlr.errors import OptionError
from hlr.request.style_check import (
    check_one_of,
    checked_background,
    checked_color,
    checked_dash,
    checked_dpi,
    checked_size,
    checked_width,
)
from hlr.tables.line_classes import LINE_CLASSES, Kind

Cap = Literal["round", "butt", "square"]
Layers = Literal["class", "part"]
PartColors = Literal["lines", "fills"]
DxfVersion = Literal["R12", "R2000", "R2004", "R2007", "R2010", "R2013", "R2018"]
Width = float | Literal["wide", "narrow"]


@dataclass(frozen=True, slots=True)
class LineRule:
    """How some lines are drawn: which, and what differs there. What is None stays as a more general rule says.

    visible  only visible lines, or only hidden ones; None: both
    kind     only lines of this class: sharp, smooth, seam, outline, boundary, intersection or hatch; None:
             all
    parts    only lines of parts that match this pattern, which reads as those of `Options.only`; None: all
    width    millimetres, or one of the two widths of the style: wide, narrow
    color    a CSS name, #rrggbb, or currentColor
    dash     (dash, gap) in multiples of the width, the dash at least twice the gap; () for a continuous line
    cap      how continuous lines end: round, butt, square. Dashes end butt: others would lengthen each of them

    >>> import hlr
    >>> hlr.LineRule(visible=False, color="Gray").color
    '#808080'
    """

    visible: bool | None = None
    kind: Kind | None = None
    parts: str | None = None
    width: Width | None = None
    color: str | None = None
    dash: tuple[float, float] | tuple[()] | None = None
    cap: Cap | None = None

    def __post_init__(self) -> None:
        """Values are brought into their one form. Raises OptionError that says what is allowed."""
        check_one_of("visible", self.visible, (True, False, None))
        check_one_of("kind", self.kind, (*LINE_CLASSES, None))
        check_one_of("cap", self.cap, (*get_args(Cap), None))
        if self.parts is not None and not isinstance(self.parts, str):
            raise OptionError(f"parts needs a pattern of names, not {self.parts!r}")
        if self.width not in ("wide", "narrow", None):
            object.__setattr__(self, "width", checked_width("width", self.width, ", wide or narrow"))
        object.__setattr__(self, "color", checked_color("color", self.color))
        object.__setattr__(self, "dash", checked_dash(self.dash))

    @property
    def scope(self) -> tuple[str | None, bool | None, Kind | None]:
        """Which lines it is for."""
        return self.parts, self.visible, self.kind

    @property
    def weight(self) -> int:
        """Rules of more weight override others: one for parts any other, one for a class those for all classes."""
        return 4 * (self.parts is not None) + 2 * (self.kind is not None) + (self.visible is not None)


STANDARD = (
    LineRule(color="#000000", cap="round"),
    LineRule(visible=True, width="wide"),
    LineRule(visible=False, width="narrow", dash=(12.0, 3.0)),
    LineRule(kind="smooth", width="narrow"),
    LineRule(kind="seam", width="narrow"),
    LineRule(kind="hatch", width="narrow"),
)
"""ISO 128: visible edges and outlines continuous and wide, hidden ones dashed and narrow, tangent edges and hatches
narrow."""


@dataclass(frozen=True, slots=True)
class Style:
    """How a drawing looks. SVG, PDF, DXF and PNG all follow it; the lines are the same.

    lines        rules for lines. The most special one that says something holds: one for parts rather than one for a
                 class, that rather than one for visible or hidden lines; of equals the last
    wide         millimetres: the wide lines. None: 0.5, and 0.7 on sheets larger than A2 (ISO 128)
    narrow       millimetres: the narrow lines. None: half of the wide ones
    background   a CSS name or #rrggbb; None: no background, so that what lies below shows
    layers       of SVG, PDF and DXF: one for each line class and visibility, or first one for each part
    part_colors  lines: each part's lines have its colour, darker or lighter where that is too close to the background;
                 fills: the visible faces are painted in it, opaque and without shading; None: neither
    size         of PNG, (width, height) in pixels: the page as large as fits into it. None: by dpi
    dpi          of PNG, pixels per inch of paper. None: 200
    dxf          the version of DXF files

    >>> import hlr
    >>> red = hlr.Style(lines=(*hlr.Style().lines, hlr.LineRule(parts="bolt*", color="red")), background=None)
    >>> drawing = hlr.draw("part.step", style=red)
    >>> drawing.with_style("dark").style.background
    '#1e1e1e'
    """

    lines: tuple[LineRule, ...] = STANDARD
    wide: float | None = None
    narrow: float | None = None
    background: str | None = "#ffffff"
    layers: Layers = "class"
    part_colors: PartColors | None = None
    size: tuple[int, int] | None = None
    dpi: float | None = None
    dxf: DxfVersion = "R2010"

    def __post_init__(self) -> None:
        """Values are brought into their one form. Raises OptionError that says what is allowed."""
        if not isinstance(self.lines, Sequence) or not all(isinstance(rule, LineRule) for rule in self.lines):
            raise OptionError(f"lines needs a list of hlr.LineRule, not {self.lines!r}")
        object.__setattr__(self, "lines", tuple(self.lines))
        for name in ("wide", "narrow"):
            if getattr(self, name) is not None:
                object.__setattr__(self, name, checked_width(name, getattr(self, name)))
        object.__setattr__(self, "background", checked_background(self.background))
        check_one_of("layers", self.layers, get_args(Layers))
        check_one_of("part_colors", self.part_colors, (*get_args(PartColors), None))
        check_one_of("dxf", self.dxf, get_args(DxfVersion))
        object.__setattr__(self, "dpi", checked_dpi(self.dpi))
        object.__setattr__(self, "size", checked_size(self.size))
        if self.dpi is not None and self.size is not None:
            raise OptionError("`size` and `dpi` contradict one another: give one of them")
