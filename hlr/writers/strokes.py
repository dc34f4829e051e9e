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
from hlr.drawing.lines import held
from hlr.errors import WriteError
from hlr.tables.line_classes import LINE_CLASSES, WIDE_MM, by_number
from hlr.writers import number, style

START, LINE, CONTROL, QUADRATIC, CUBIC, ARC, WHOLE = range(7)
"""What a row of a stroke is: where it starts; a straight line to here; a control point of the curve that the next
QUADRATIC or CUBIC row ends; the end of an arc; the centre of a whole circle or ellipse, the only row of its stroke."""


PAGE_PLACES = 3
"""Decimals of millimetres that the size of a page may have."""


@dataclass(frozen=True, slots=True)
class Strokes:
    """A drawing on its page, with points in grid steps of 10**-places millimetres.

    left, bottom, width, height: the page in the drawing's coordinates, millimetres.
    """

    places: int
    left: float
    bottom: float
    width: float
    height: float
    layers: tuple[_kernel.Layer, ...]

    @property
    def side_places(self) -> int:
        """Decimals of the page's width and height: a sheet has its exact size, however coarse the drawing is."""
        return max(self.places, PAGE_PLACES)

    def svg(self, layer: _kernel.Layer) -> bytes:
        """The elements of a layer, with its dashes."""
        return layer.svg(*self._dashes(layer))

    def pdf(self, layer: _kernel.Layer) -> bytes:
        """The painted paths of a layer, with its dashes."""
        return layer.pdf(*self._dashes(layer))

    def _dashes(self, layer: _kernel.Layer) -> tuple[tuple[float, float] | None, list[_kernel.Layer]]:
        """The dashes, and the layers that dashed lines may go on from."""
        pattern = style.dash(by_number()[layer.kind], layer.visible)
        return pattern, [] if pattern is None else [other for other in self.layers if other.visible]


def places_of(drawing: Drawing, bounds: tuple[float, float, float, float]) -> int:
    """Decimals of the points in SVG and PDF."""
    return number.decimals(drawing.accuracy.used, max(map(abs, bounds)))


def strokes(drawing: Drawing, *, cubic: bool = False) -> Strokes:
    """Sort and join the lines of a drawing: hidden layers first, so that visible lines lie on top.

    cubic: arcs and quadratic curves become cubic ones, for formats that know no others. Raises WriteError where a point
    is not finite.
    """
    x0, y0, x1, y1 = bounds = drawing.area
    accuracy, places = drawing.accuracy.used, places_of(drawing, bounds)
    order = [row.number for row in sorted(LINE_CLASSES.values(), key=lambda row: row.place)]
    try:
        layers = held(drawing.lines).layers(order, places, accuracy, cubic)
    except ValueError:
        raise WriteError(number.NOT_FINITE) from None
    if drawing.page is not None:
        return Strokes(places, x0, y0, drawing.page.width, drawing.page.height, tuple(layers))
    step = 10.0**places
    unit = 10.0**-places
    border = math.ceil((style.MARGIN + WIDE_MM) * 10**places)
    left, bottom = round(x0 * step) - border, round(y0 * step) - border
    right, top = round(x1 * step) + border, round(y1 * step) + border
    return Strokes(places, left * unit, bottom * unit, (right - left) * unit, (top - bottom) * unit, tuple(layers))


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
