"""Lines to pen strokes: rounded to the grid, sorted into layers, joined where one ends and the next begins.

SVG and PDF draw the same strokes; the exchange format keeps the lines as they are.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.curve import Arc, raised
from hlr.drawing import Drawing, Line
from hlr.errors import WriteError
from hlr.writers import number, style

Ints = npt.NDArray[np.int64]
Bools = npt.NDArray[np.bool_]
Bytes = npt.NDArray[np.uint8]


START, LINE, CONTROL, QUADRATIC, CUBIC, ARC, WHOLE = range(7)
"""What a row of a stroke is: where it starts; a straight line to here; a control point of the curve that the next
QUADRATIC or CUBIC row ends; the end of an arc; the centre of a whole circle or ellipse, the only row of its stroke."""


@dataclass(frozen=True, slots=True)
class Layer:
    """All strokes of one line class and visibility.

    points   (n, 2) grid steps, y up; a line leads somewhere else; the last point of a loop of lines is left out
    op       (n,) uint8 what leads to each point, as above
    arc      (n,) int32 of an arc or a whole: index into `shapes`; else -1
    shapes   (a, 5) int64 two radii and the rotation of the first, as the kernel rounds them; whether the arc is the
             large one; whether it runs counter-clockwise
    starts   (s + 1,) where each stroke starts in `points`; each but a whole has at least two points
    closed   (s,)
    part     per stroke: index of its part
    edge     per stroke: index of its edge, or None
    other    per stroke: index of the second part of an intersection, or None
    """

    kind: str
    visible: bool
    points: Ints
    op: Bytes
    arc: npt.NDArray[np.int32]
    shapes: Ints
    starts: Ints
    closed: Bools
    part: list[int]
    edge: list[int | None]
    other: list[int | None]

    @property
    def arrays(self) -> tuple[Ints, Bytes, npt.NDArray[np.int32], Ints, Ints, Bools]:
        """As the kernel takes them."""
        return self.points, self.op, self.arc, self.shapes, self.starts, self.closed


@dataclass(frozen=True, slots=True)
class Strokes:
    """A drawing on its page. left, bottom, width, height: the page in grid steps of 10**-places millimetres."""

    places: int
    left: int
    bottom: int
    width: int
    height: int
    layers: tuple[Layer, ...]

    def dashes(self, layer: Layer) -> list[tuple[str, str]] | None:
        """For each stroke of a dashed layer, its lengths of dash, gap, dash, ... and where in them it begins, in
        millimetres, as text; both empty for a stroke that is drawn through. None: no stroke has dashes.
        """
        pattern = style.dash(layer.kind, layer.visible)
        if pattern is None:
            return None
        visible = [other.arrays for other in self.layers if other.visible]
        return _kernel.dashes(layer.arrays, visible, self.places, *pattern)


def places_of(drawing: Drawing, bounds: tuple[float, float, float, float]) -> int:
    """Decimals of the points in SVG and PDF."""
    return number.decimals(drawing.accuracy.used, max(map(abs, bounds)))


def strokes(drawing: Drawing, *, cubic: bool = False) -> Strokes:
    """Sort and join the lines of a drawing: hidden layers first, so that visible lines lie on top.

    cubic: arcs and quadratic curves become cubic ones, for formats that know no others.
    """
    groups: dict[tuple[bool, str], list[Line]] = {(v, k): [] for v in (False, True) for k in style.KINDS}
    for line in drawing.lines:
        groups[line.visible, line.kind].append(line)
    bounds = drawing.page
    accuracy, places = drawing.accuracy.used, places_of(drawing, bounds)
    layers = [_layer(*key, lines, rows_of(lines, places, accuracy, cubic)) for key, lines in groups.items() if lines]
    corners = number.grid(np.array(bounds).reshape(2, 2), places)
    border = math.ceil((style.MARGIN + style.WIDE) * 10**places)
    left, bottom = (int(v) - border for v in corners[0])
    right, top = (int(v) + border for v in corners[1])
    return Strokes(places, left, bottom, right - left, top - bottom, tuple(x for x in layers if len(x.closed)))


@dataclass(slots=True)
class Rows:
    """Rows of some lines one after another, and how many each line has; `Layer` says what they hold."""

    points: Ints
    op: Bytes
    arc: npt.NDArray[np.int32]
    shapes: Ints
    counts: Ints


def rows_of(lines: Sequence[Line], places: int, accuracy: float, cubic: bool) -> Rows:
    """What is written of each line, before what continues another is joined to it."""
    round_ = [i for i, line in enumerate(lines) if isinstance(line.curve, Arc)]
    points, ops = [], []
    for line in lines:
        curve = line.curve
        if curve is None:
            points.append(line.points)
            ops.append(_ops(LINE, len(line.points)))
        elif isinstance(curve, Arc):
            points.append(_NO_POINTS)
            ops.append(_ops(LINE, 0))
        else:
            chain = raised(curve) if cubic and curve.degree == 2 else curve
            points.append(chain.points)
            ops.append(_ops(QUADRATIC if chain.degree == 2 else CUBIC, len(chain.points)))
    counts = np.fromiter(map(len, points), np.int64, len(points))
    grid = number.grid(np.concatenate(points), places)
    op = np.concatenate(ops)
    arc = np.full(len(op), -1, np.int32)
    if not round_:
        return Rows(grid, op, arc, np.zeros((0, 5), np.int64), counts)
    arcs = [line.curve for line in lines if isinstance(line.curve, Arc)]
    values = np.concatenate([np.concatenate([c.centre, c.axes.ravel(), c.angles]) for c in arcs]).reshape(-1, 8)
    ends = np.concatenate([lines[i].points[[0, -1]] for i in round_]).reshape(-1, 4)
    if not (np.isfinite(values).all() and np.isfinite(ends).all()):
        raise WriteError(number.NOT_FINITE)
    found = _kernel.arc_rows(values, ends, places, accuracy, cubic)
    # Each arc's rows at its line's place among the others.
    where = np.repeat((np.cumsum(counts) - counts)[round_], found["counts"])
    counts[round_] = found["counts"]
    return Rows(
        np.insert(grid, where, found["points"], axis=0),
        np.insert(op, where, found["op"]),
        np.insert(arc, where, found["arc"]),
        found["shapes"],
        counts,
    )


_NO_POINTS = np.zeros((0, 2))


@cache
def _ops(op: int, count: int) -> Bytes:
    """What the rows of a polyline or of a chain of curves are."""
    degree = {QUADRATIC: 2, CUBIC: 3}.get(op, 1)
    result = np.full(count, CONTROL, np.uint8)
    result[::degree] = op
    result[:1] = START
    return result


def _layer(visible: bool, kind: str, lines: Sequence[Line], rows: Rows) -> Layer:
    """One layer: drop points that coincide on the grid, join consecutive lines, find closed strokes."""
    points, op, arc, counts = rows.points, rows.op.copy(), rows.arc, rows.counts
    owner = np.repeat(np.arange(len(lines)), counts)
    first, last = np.cumsum(counts) - counts, np.cumsum(counts) - 1
    part = np.fromiter((line.part for line in lines), np.int64, len(lines))
    edge = np.fromiter((-1 if line.edge is None else line.edge for line in lines), np.int64, len(lines))
    other = np.fromiter((-1 if line.other is None else line.other for line in lines), np.int64, len(lines))
    loop = _same(points[first], points[last])

    # A line joins the one before it where it starts on its end, on the same edge of the same part.
    joins = np.zeros(len(lines), np.bool_)
    joins[1:] = (part[1:] == part[:-1]) & (edge[1:] == edge[:-1]) & _same(points[first[1:]], points[last[:-1]])
    joins[1:] &= (other[1:] == other[:-1]) & ~loop[1:] & ~loop[:-1]
    new = np.zeros(len(points), np.bool_)
    new[first[~joins]] = True
    op[(op == START) & ~new] = LINE
    keep = new | ((op != LINE) & (op != ARC))
    keep[1:] |= ~_same(points[1:], points[:-1])
    points, op, arc, owner, new = points[keep], op[keep], arc[keep], owner[keep], new[keep]

    # What has shrunk to a single point is below the rounding and is not drawn.
    stroke = np.cumsum(new) - 1
    keep = (np.bincount(stroke)[stroke] > 1) | (op == WHOLE)
    points, op, arc, owner, new = points[keep], op[keep], arc[keep], owner[keep], new[keep]
    starts = np.flatnonzero(new)
    ends = np.append(starts, len(points))[1:] - 1

    # There and back along lines is no loop; along a curve it is.
    curved = np.zeros(len(starts), np.bool_)
    curved[(np.cumsum(new) - 1)[op > LINE]] = True
    closed = _same(points[starts], points[ends]) & ((ends - starts >= 3) | (curved & (ends > starts)))
    dropped = closed & (op[ends] == LINE)
    keep = np.ones(len(points), np.bool_)
    keep[ends[dropped]] = False
    return Layer(
        kind,
        visible,
        points[keep],
        op[keep],
        arc[keep],
        rows.shapes,
        np.append(0, np.cumsum(ends - starts + 1 - dropped)),
        closed,
        part[owner[starts]].tolist(),
        [None if e < 0 else e for e in edge[owner[starts]].tolist()],
        [None if o < 0 else o for o in other[owner[starts]].tolist()],
    )


def _same(a: Ints, b: Ints) -> Bools:
    """Whether the points (n, 2) of `a` and `b` coincide, one by one."""
    equal: Bools = (a[:, 0] == b[:, 0]) & (a[:, 1] == b[:, 1])
    return equal
