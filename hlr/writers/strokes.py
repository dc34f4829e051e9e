"""Lines to pen strokes: rounded to the grid, sorted into layers, joined where one ends and the next begins.

SVG and PDF draw the same strokes; the exchange format keeps the lines as they are.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hlr.drawing import Drawing, Line, Points
from hlr.writers import number, style

Ints = npt.NDArray[np.int64]
Bools = npt.NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Layer:
    """All strokes of one line class and visibility.

    points   (n, 2) grid steps, y up; neighbours within a stroke differ; the last point of a closed one is left out
    starts   (s + 1,) where each stroke starts in `points`; each has at least two points
    closed   (s,)
    part     per stroke: index of its part
    edge     per stroke: index of its edge, or None
    other    per stroke: index of the second part of an intersection, or None
    """

    kind: str
    visible: bool
    points: Ints
    starts: Ints
    closed: Bools
    part: list[int]
    edge: list[int | None]
    other: list[int | None]


@dataclass(frozen=True, slots=True)
class Strokes:
    """A drawing on its page. left, bottom, width, height: the page in grid steps of 10**-places millimetres."""

    places: int
    left: int
    bottom: int
    width: int
    height: int
    layers: tuple[Layer, ...]


def strokes(drawing: Drawing) -> Strokes:
    """Sort and join the lines of a drawing: hidden layers first, so that visible lines lie on top."""
    groups: dict[tuple[bool, str], list[Line]] = {(v, k): [] for v in (False, True) for k in style.KINDS}
    for line in drawing.lines:
        groups[line.visible, line.kind].append(line)
    arrays = {key: _arrays(lines) for key, lines in groups.items() if lines}
    box = np.zeros((2, 2))
    if any(len(points) for points, _ in arrays.values()):
        everything = np.concatenate([points for points, _ in arrays.values()])
        box = np.array([everything.min(axis=0), everything.max(axis=0)])
    places = number.decimals(float(drawing.accuracy["used"]), float(np.abs(box).max()))
    layers = [
        _layer(*key, groups[key], number.grid(points, places), counts) for key, (points, counts) in arrays.items()
    ]
    corners = number.grid(box, places)
    border = math.ceil((style.MARGIN + style.WIDE) * 10**places)
    left, bottom = (int(v) - border for v in corners[0])
    right, top = (int(v) + border for v in corners[1])
    return Strokes(places, left, bottom, right - left, top - bottom, tuple(x for x in layers if len(x.closed)))


def _arrays(lines: Sequence[Line]) -> tuple[Points, Ints]:
    """All points of some lines (n, 2), and how many each line has."""
    points = [line.points for line in lines]
    return np.concatenate(points), np.fromiter(map(len, points), np.int64, len(points))


def _layer(visible: bool, kind: str, lines: Sequence[Line], points: Ints, counts: Ints) -> Layer:
    """One layer: drop points that coincide on the grid, join consecutive lines, find closed strokes."""
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
    keep = new.copy()
    keep[1:] |= ~_same(points[1:], points[:-1])
    points, owner, new = points[keep], owner[keep], new[keep]

    # What has shrunk to a single point is below the rounding and is not drawn.
    stroke = np.cumsum(new) - 1
    keep = np.bincount(stroke)[stroke] > 1
    points, owner, new = points[keep], owner[keep], new[keep]
    starts = np.flatnonzero(new)
    ends = np.append(starts, len(points))[1:] - 1

    closed = _same(points[starts], points[ends]) & (ends - starts >= 3)
    keep = np.ones(len(points), np.bool_)
    keep[ends[closed]] = False
    return Layer(
        kind,
        visible,
        points[keep],
        np.append(0, np.cumsum(ends - starts + 1 - closed)),
        closed,
        part[owner[starts]].tolist(),
        [None if e < 0 else e for e in edge[owner[starts]].tolist()],
        [None if o < 0 else o for o in other[owner[starts]].tolist()],
    )


def _same(a: Ints, b: Ints) -> Bools:
    """Whether the points (n, 2) of `a` and `b` coincide, one by one."""
    equal: Bools = (a[:, 0] == b[:, 0]) & (a[:, 1] == b[:, 1])
    return equal
