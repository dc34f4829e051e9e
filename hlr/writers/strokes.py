"""Lines to pen strokes: rounded to the grid, sorted into layers, joined where one ends and the next begins.

SVG and PDF draw the same strokes; the exchange format keeps the lines as they are. The kernel makes them
(`kernel/linework/src/curves`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.drawing.drawing import Drawing
from hlr.drawing.line import Line
from hlr.drawing.lines import divided, held
from hlr.drawing.pens import Pen, PenSet, pens_of, usual_pens
from hlr.errors import WriteError
from hlr.tables.line_classes import LineClass, by_number, in_drawing_order
from hlr.writers import number

MARGIN = 5.5
"""Empty border around the drawing, millimetres."""

START, LINE, CONTROL, QUADRATIC, CUBIC, ARC, WHOLE = range(7)
"""What a row of a stroke is: where it starts; a straight line to here; a control point of the curve that the next
QUADRATIC or CUBIC row ends; the end of an arc; the centre of a whole circle or ellipse, the only row of its stroke."""


PAGE_PLACES = 3
"""Decimals of millimetres that the size of a page may have."""


@dataclass(frozen=True, slots=True)
class Inked:
    """A layer and its pen: the strokes of one line class and visibility, of all parts or those of one set.

    pens  of its parts
    seen  the visible layers of the same parts, from which dashed lines may go on
    """

    layer: _kernel.Layer
    row: LineClass
    pens: PenSet
    pen: Pen
    seen: tuple[_kernel.Layer, ...] = ()

    @property
    def visible(self) -> bool:
        """Whether its lines are visible."""
        return self.layer.visible

    def svg(self) -> bytes:
        """Its elements, with their dashes."""
        dash = self.pen.dash
        return self.layer.svg(dash, [] if dash is None else self.seen)

    def pdf(self) -> bytes:
        """Its painted paths, with their dashes."""
        dash = self.pen.dash
        return self.layer.pdf(dash, [] if dash is None else self.seen)


@dataclass(frozen=True, slots=True)
class Strokes:
    """A drawing on its page, with points in grid steps of 10**-places millimetres.

    left, bottom, width, height: the page in the drawing's coordinates, millimetres.
    usual: the pens of parts for which the style has no rules of their own.
    """

    places: int
    left: float
    bottom: float
    width: float
    height: float
    inked: tuple[Inked, ...]
    usual: PenSet

    @property
    def side_places(self) -> int:
        """Decimals of the page's width and height: a sheet has its exact size, however coarse the drawing is."""
        return max(self.places, PAGE_PLACES)


def places_of(drawing: Drawing, bounds: tuple[float, float, float, float]) -> int:
    """Decimals of the points in SVG and PDF."""
    return number.decimals(drawing.accuracy.used, max(map(abs, bounds)))


def strokes(drawing: Drawing, *, cubic: bool = False) -> Strokes:
    """Sort and join the lines of a drawing: hidden layers first, so that visible lines lie on top.

    Where its style has the layers by part, all lines of a part stand together, and the same holds within it.

    cubic: arcs and quadratic curves become cubic ones, for formats that know no others. Raises WriteError where a point
    is not finite.
    """
    x0, y0, x1, y1 = bounds = drawing.area
    places, usual = places_of(drawing, bounds), usual_pens(drawing.style, (x1 - x0, y1 - y0), drawing.group)
    found = [inked for pens, lines in _sets(drawing, usual) for inked in _inked(drawing, pens, lines, places, cubic)]
    if drawing.style.layers == "class":
        found.sort(key=_order)
    if drawing.page is not None:
        return Strokes(places, x0, y0, drawing.page.width, drawing.page.height, tuple(found), usual)
    step = 10.0**places
    unit = 10.0**-places
    border = math.ceil(MARGIN * 10**places)
    left, bottom = round(x0 * step) - border, round(y0 * step) - border
    right, top = round(x1 * step) + border, round(y1 * step) + border
    width, height = (right - left) * unit, (top - bottom) * unit
    return Strokes(places, left * unit, bottom * unit, width, height, tuple(found), usual)


def _order(inked: Inked) -> tuple[bool, int]:
    """Hidden lines first, then by line class."""
    return inked.visible, inked.row.place


def _sets(drawing: Drawing, usual: PenSet) -> list[tuple[PenSet, _kernel.Lines]]:
    """The lines of parts that are drawn alike, or of each part where the style has a layer for each."""
    sets = pens_of(drawing, usual)
    if drawing.style.layers == "part":
        alone = [one.of((part,)) for one in sets for part in one.parts]
        sets = sorted(alone, key=lambda one: one.parts)
    if len(sets) == 1:
        return [(sets[0], held(drawing.lines))]
    own = np.zeros(len(drawing.parts), np.int64)
    for n, one in enumerate(sets):
        own[list(one.parts)] = n
    return list(zip(sets, divided(drawing.lines, own, len(sets)), strict=True))


def layers_of(lines: _kernel.Lines, places: int, accuracy: float, cubic: bool) -> list[_kernel.Layer]:
    """Lines in layers, without pens; places, cubic: as of `Strokes` and `strokes`; accuracy: millimetres."""
    try:
        return lines.layers(in_drawing_order(), places, accuracy, cubic)
    except ValueError:
        raise WriteError(number.NOT_FINITE) from None


def _inked(drawing: Drawing, pens: PenSet, lines: _kernel.Lines, places: int, cubic: bool) -> list[Inked]:
    layers = layers_of(lines, places, drawing.accuracy.used, cubic)
    seen, rows = tuple(layer for layer in layers if layer.visible), by_number()
    inked = []
    for layer in layers:
        row = rows[layer.kind]
        inked.append(Inked(layer, row, pens, pens.pen(row.name, layer.visible), seen))
    return inked


@dataclass(slots=True)
class Rows:
    """Rows of some lines one after another, and how many each line has.

    points   (n, 2) grid steps, y up
    op       (n,) uint8 what leads to each point, as above
    arc      (n,) int32 of an arc or a whole: index into `shapes`; else -1
    shapes   (a, 5) int64 two radii and the rotation of the first, as the kernel rounds them; whether the arc is the
             large one; whether it runs counter-clockwise
    """

    points: npt.NDArray[np.int64]
    op: npt.NDArray[np.uint8]
    arc: npt.NDArray[np.int32]
    shapes: npt.NDArray[np.int64]
    counts: npt.NDArray[np.int64]


def rows_of(lines: Sequence[Line], places: int, accuracy: float, cubic: bool) -> Rows:
    """What is written of each line, before what continues another is joined to it."""
    try:
        rows, counts = held(lines).rows(places, accuracy, cubic)
    except ValueError:
        raise WriteError(number.NOT_FINITE) from None
    found: dict[str, Any] = rows
    return Rows(**found, counts=counts)
