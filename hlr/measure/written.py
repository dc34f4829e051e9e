"""What a file says, as a renderer draws it: points along every line after its numbers have been rounded."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.drawing import Drawing
from hlr.source.model import Floats
from hlr.writers.strokes import ARC, CUBIC, LINE, QUADRATIC, WHOLE, Rows, places_of, rows_of

Index = npt.NDArray[np.int64]

EXTRA, ROTATION = 2, 6
"""Decimals that radii have beyond those of points, and decimals of a rotation in degrees: `kernel/src/ink/arcs.rs`."""

STEPS = {LINE: 4, QUADRATIC: 8, CUBIC: 8, ARC: 32, WHOLE: 64}
"""Pieces that a straight line, a curve, an arc, a full circle are looked at in."""


@dataclass(frozen=True, slots=True)
class Written:
    """Points (n, 2) along all lines, millimetres on paper as in `Drawing`; those of one line follow one another.

    line (n,): index into Drawing.lines, ascending
    """

    points: Floats
    line: Index

    def steps(self) -> tuple[Floats, Index]:
        """(m, 4) the segments between neighbouring points, and the line of each."""
        same = self.line[1:] == self.line[:-1]
        return np.concatenate([self.points[:-1], self.points[1:]], axis=1)[same], self.line[:-1][same]

    def middles(self, step: float) -> tuple[Floats, Index]:
        """(n, 2) points along the lines, in the middle of pieces at most `step` long, and the line of each."""
        segments, line = self.steps()
        length = np.hypot(segments[:, 2] - segments[:, 0], segments[:, 3] - segments[:, 1])
        # Running length over all lines: pieces go over bends, and each line's own begin at its start.
        ends = np.cumsum(length)
        last = np.flatnonzero(np.append(line[1:] != line[:-1], True)) if len(line) else np.zeros(0, np.int64)
        total = np.diff(np.append(0.0, ends[last]))
        count = np.maximum(np.ceil(total / step), 1.0).astype(np.int64)
        number = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
        along = np.repeat(ends[last] - total, count) + (number + 0.5) * np.repeat(total / np.maximum(count, 1), count)
        which = np.minimum(np.searchsorted(ends, along), np.repeat(last, count))
        with np.errstate(all="ignore"):
            t = np.nan_to_num((along - (ends[which] - length[which])) / length[which])[:, None]
        points = segments[which, :2] * (1.0 - t) + segments[which, 2:] * t
        return np.ascontiguousarray(points), np.repeat(line[last], count)


def written(drawing: Drawing, *, cubic: bool = False) -> Written:
    """What SVG holds of a drawing, or, with `cubic`, PDF.

    Raises WriteError where a point is not finite.
    """
    if not drawing.lines:
        return Written(np.zeros((0, 2)), np.zeros(0, np.int64))
    places = places_of(drawing, drawing.bounds())
    rows = rows_of(drawing.lines, places, float(drawing.accuracy["used"]), cubic)
    unit = 10.0**-places
    at = np.asarray(rows.points * unit, np.float64)
    owner = np.repeat(np.arange(len(rows.counts)), rows.counts)
    points, row, place, line = [], [], [], []
    first = np.cumsum(rows.counts) - rows.counts
    points.append(at[first])
    row.append(first)
    place.append(np.zeros(len(first)))
    line.append(owner[first])
    for op, steps in STEPS.items():
        which = np.flatnonzero(rows.op == op)
        if len(which) == 0:
            continue
        t = np.linspace(0.0, 1.0, steps + 1)[(0 if op == WHOLE else 1) :]
        if op in (ARC, WHOLE):
            made = _arcs(rows, which, at, unit, t, op == WHOLE)
        else:
            degree = {LINE: 1, QUADRATIC: 2, CUBIC: 3}[op]
            made = _bezier(np.stack([at[which - k] for k in range(degree, -1, -1)]), t)
        points.append(made.reshape(-1, 2))
        row.append(np.repeat(which, len(t)))
        place.append(np.tile(t, len(which)))
        line.append(np.repeat(owner[which], len(t)))
    order = np.lexsort((np.concatenate(place), np.concatenate(row)))
    line_of = np.concatenate(line)[order]
    # A full circle has no start: its row is its centre.
    whole = np.zeros(len(rows.counts), bool)
    whole[owner[rows.op == WHOLE]] = True
    keep = ~((order < len(first)) & whole[line_of])
    return Written(np.concatenate(points)[order][keep], line_of[keep])


def in_model(drawing: Drawing, points: Floats, line: Index, threads: int) -> Floats:
    """(n, 3) where points (n, 2) of lines (n,) are in the model, as far as the lines' own points tell."""
    if len(points) == 0:
        return np.zeros((0, 3))
    chords, ends, owner = [], [], []
    for number in np.unique(line).tolist():
        of = drawing.lines[number]
        chords.append(np.concatenate([of.points[:-1], of.points[1:]], axis=1))
        ends.append(np.stack([of.points3[:-1], of.points3[1:]], axis=1))
        owner.append(np.full(len(of.points) - 1, number, np.int32))
    chord, end = np.concatenate(chords), np.concatenate(ends)
    _, found = _kernel.nearest(
        np.ascontiguousarray(points), line.astype(np.int32), chord, np.concatenate(owner), np.inf, threads
    )
    a, b = chord[found, :2], chord[found, 2:]
    size = ((b - a) ** 2).sum(axis=1)
    with np.errstate(all="ignore"):
        s = np.where(size > 0.0, ((points - a) * (b - a)).sum(axis=1) / size, 0.0)
    s = np.clip(s, 0.0, 1.0)[:, None]
    return np.asarray(end[found, 0] * (1.0 - s) + end[found, 1] * s)


def _bezier(control: Floats, t: Floats) -> Floats:
    """(m, k, 2) points of m curves at (k,) parameters; control (degree + 1, m, 2)."""
    p = list(control[:, :, None, :])
    s = t[None, :, None]
    while len(p) > 1:
        p = [a + (b - a) * s for a, b in pairwise(p)]
    return np.asarray(np.broadcast_to(p[0], (control.shape[1], len(t), 2)))


def _arcs(rows: Rows, which: Index, at: Floats, unit: float, t: Floats, whole: bool) -> Floats:
    """(m, k, 2) points of arcs at (k,) shares of their way, as SVG 2, appendix B.2.4 says they are drawn."""
    shape = rows.shapes[rows.arc[which]]
    radii = shape[:, :2] * (unit * 10.0**-EXTRA)
    angle = np.radians(shape[:, 2] * 10.0**-ROTATION)
    cos, sin = np.cos(angle), np.sin(angle)
    if whole:
        centre, begin, turn = at[which], np.zeros(len(which)), np.full(len(which), 2.0 * np.pi)
        rx, ry = radii.T
    else:
        a, b = at[which - 1], at[which]
        large, rising = shape[:, 3] != 0, shape[:, 4] != 0
        half = 0.5 * (a - b)
        x, y = cos * half[:, 0] + sin * half[:, 1], cos * half[:, 1] - sin * half[:, 0]
        reach = (x / radii[:, 0]) ** 2 + (y / radii[:, 1]) ** 2
        # Radii too small for their ends are stretched.
        rx, ry = (radii * np.sqrt(np.maximum(reach, 1.0))[:, None]).T
        with np.errstate(divide="ignore"):
            root = np.sqrt(np.maximum(1.0 / np.minimum(reach, 1.0) - 1.0, 0.0)) * np.where(large == rising, -1.0, 1.0)
        root = np.where(reach > 0.0, root, 0.0)
        cx, cy = root * rx * y / ry, -root * ry * x / rx
        centre = np.stack([cos * cx - sin * cy, sin * cx + cos * cy], axis=1) + 0.5 * (a + b)
        begin = np.arctan2((y - cy) / ry, (x - cx) / rx)
        turn = np.arctan2((-y - cy) / ry, (-x - cx) / rx) - begin
        turn = np.where(rising & (turn < 0.0), turn + 2.0 * np.pi, turn)
        turn = np.where(~rising & (turn > 0.0), turn - 2.0 * np.pi, turn)
    angle = begin[:, None] + turn[:, None] * t
    u, v = np.cos(angle) * rx[:, None], np.sin(angle) * ry[:, None]
    turned = np.stack([cos[:, None] * u - sin[:, None] * v, sin[:, None] * u + cos[:, None] * v], axis=2)
    return np.asarray(centre[:, None] + turned, np.float64)
