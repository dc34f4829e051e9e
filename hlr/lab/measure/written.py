"""Points along every line as a file writer rounds them."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from hlr import _kernel
from hlr.common.types import Floats
from hlr.drawing.chords import Index, numbered
from hlr.drawing.drawing import Drawing
from hlr.lab.sampling import line_middles
from hlr.request.accuracy import MEASURED_CHORD
from hlr.writers.strokes import ARC, CUBIC, LINE, QUADRATIC, WHOLE, Rows, places_of, rows_of

EXTRA, ROTATION = 2, 6
"""Decimals that radii have beyond those of points, and decimals of a rotation in degrees:
`kernel/linework/src/curves/arcs.rs`."""

FEWEST = {LINE: 4, QUADRATIC: 8, CUBIC: 8, ARC: 16, WHOLE: 32}
"""Pieces that a straight line, a curve, an arc, a full circle are looked at in, at least."""
DEGREE = {LINE: 1, QUADRATIC: 2, CUBIC: 3}


@dataclass(frozen=True, slots=True)
class Written:
    """Points (n, 2) along all lines, millimetres on paper as in `Drawing`, in order along each line.

    line (n,): the line of each point, as index into Drawing.lines, ascending
    """

    points: Floats
    line: Index

    def steps(self) -> tuple[Floats, Index]:
        """(m, 4) the segments between neighbouring points, and the line of each."""
        same = self.line[1:] == self.line[:-1]
        return np.concatenate([self.points[:-1], self.points[1:]], axis=1)[same], self.line[:-1][same]

    def middles(self, step: float) -> tuple[Floats, Index]:
        """(n, 2) the middles of equal pieces of the lines, at most `step` long, and the line of each."""
        return line_middles(*self.steps(), step)


def written(drawing: Drawing, *, cubic: bool = False) -> Written:
    """The points of a drawing as SVG holds them, or, with `cubic`, as PDF does.

    Raises WriteError where a point is not finite.
    """
    if not drawing.lines:
        return Written(np.zeros((0, 2)), np.zeros(0, np.int64))
    places = places_of(drawing, drawing.area)
    rows = rows_of(drawing.lines, places, drawing.accuracy.used, cubic)
    accuracy = drawing.accuracy.used
    at = np.asarray(rows.points * 10.0**-places, np.float64)
    owner = np.repeat(np.arange(len(rows.counts)), rows.counts)
    first = np.cumsum(rows.counts) - rows.counts
    # A full circle has no starting point; its row holds its centre.
    first = first[rows.op[first] != WHOLE]
    points, row = [at[first]], [first]
    for op, fewest in FEWEST.items():
        which = np.flatnonzero(rows.op == op)
        if len(which) == 0:
            continue
        if op in (ARC, WHOLE):
            shape = _Shapes.of(rows, which, at, 10.0**-places, whole=op == WHOLE)
            bend = shape.turn * shape.turn * shape.radii.max(axis=1)
        else:
            control = np.stack([at[which - k] for k in range(DEGREE[op], -1, -1)])
            second = control[:-2] - 2.0 * control[1:-1] + control[2:]
            bend = np.hypot(second[..., 0], second[..., 1]).max(axis=0, initial=0.0) * DEGREE[op] * (DEGREE[op] - 1)
        # The chord error of n pieces is at most |second derivative| / 8 n^2.
        pieces = np.maximum(np.ceil(np.sqrt(bend / (8.0 * MEASURED_CHORD * accuracy))), fewest).astype(np.int64)
        which_of, number = numbered(pieces + (op == WHOLE))
        t = (number + (op != WHOLE)) / pieces[which_of]
        points.append(shape.at(which_of, t) if op in (ARC, WHOLE) else _bezier(control[:, which_of], t))
        row.append(which[which_of])
    every = np.concatenate(row)
    order = np.argsort(every, kind="stable")
    return Written(np.concatenate(points)[order], owner[every[order]])


def in_model(drawing: Drawing, points: Floats, line: Index) -> Floats:
    """(n, 3) points in the model of points (n, 2) of lines (n,), interpolated between the lines' own points."""
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
        np.ascontiguousarray(points), line.astype(np.int32), chord, np.concatenate(owner), np.inf
    )
    a, b = chord[found, :2], chord[found, 2:]
    size = ((b - a) ** 2).sum(axis=1)
    with np.errstate(all="ignore"):
        s = np.where(size > 0.0, ((points - a) * (b - a)).sum(axis=1) / size, 0.0)
    s = np.clip(s, 0.0, 1.0)
    u, v = end[found, 0], end[found, 1]
    if drawing.view.eye is not None:
        # The middle on paper is not the middle in space: nearer lengths look longer.
        eye, back = np.array(drawing.view.eye), np.array(drawing.view.direction)
        near, far = s * ((u - eye) @ back), (1.0 - s) * ((v - eye) @ back)
        with np.errstate(all="ignore"):
            s = np.where(near + far < 0.0, near / (near + far), s)
    return np.asarray(u * (1.0 - s[:, None]) + v * s[:, None])


def _bezier(control: Floats, t: Floats) -> Floats:
    """(n, 2) points of n curves at parameters (n,); control (degree + 1, n, 2)."""
    p = list(control)
    while len(p) > 1:
        p = [a + (b - a) * t[:, None] for a, b in pairwise(p)]
    return np.asarray(p[0])


@dataclass(frozen=True, slots=True)
class _Shapes:
    """Arcs as SVG 2, appendix B.2.4, defines them.

    centre, radii (n, 2); begin, turn (n,): radians; cos, sin (n,): of the rotation of the axes
    """

    centre: Floats
    radii: Floats
    begin: Floats
    turn: Floats
    cos: Floats
    sin: Floats

    @classmethod
    def of(cls, rows: Rows, which: Index, at: Floats, unit: float, *, whole: bool) -> _Shapes:
        """The arcs of the rows `which` (n,); at: the points (m, 2) of all rows."""
        shape = rows.shapes[rows.arc[which]]
        radii = np.asarray(shape[:, :2] * (unit * 10.0**-EXTRA), np.float64)
        angle = np.radians(shape[:, 2] * 10.0**-ROTATION)
        cos, sin = np.cos(angle), np.sin(angle)
        if whole:
            none = np.zeros(len(which))
            return cls(at[which], radii, none, none + 2.0 * np.pi, cos, sin)
        a, b = at[which - 1], at[which]
        large, rising = shape[:, 3] != 0, shape[:, 4] != 0
        half = 0.5 * (a - b)
        x, y = cos * half[:, 0] + sin * half[:, 1], cos * half[:, 1] - sin * half[:, 0]
        reach = (x / radii[:, 0]) ** 2 + (y / radii[:, 1]) ** 2
        # Radii too small to reach both ends are enlarged.
        radii = radii * np.sqrt(np.maximum(reach, 1.0))[:, None]
        rx, ry = radii.T
        with np.errstate(divide="ignore"):
            root = np.sqrt(np.maximum(1.0 / np.minimum(reach, 1.0) - 1.0, 0.0)) * np.where(large == rising, -1.0, 1.0)
        root = np.where(reach > 0.0, root, 0.0)
        cx, cy = root * rx * y / ry, -root * ry * x / rx
        centre = np.stack([cos * cx - sin * cy, sin * cx + cos * cy], axis=1) + 0.5 * (a + b)
        begin = np.arctan2((y - cy) / ry, (x - cx) / rx)
        turn = np.arctan2((-y - cy) / ry, (-x - cx) / rx) - begin
        turn = np.where(rising & (turn < 0.0), turn + 2.0 * np.pi, turn)
        turn = np.where(~rising & (turn > 0.0), turn - 2.0 * np.pi, turn)
        return cls(centre, radii, begin, turn, cos, sin)

    def at(self, which: Index, t: Floats) -> Floats:
        """(n, 2) points of the arcs `which` (n,) at parameters t (n,), 0 to 1."""
        angle = self.begin[which] + self.turn[which] * t
        u, v = np.cos(angle) * self.radii[which, 0], np.sin(angle) * self.radii[which, 1]
        cos, sin = self.cos[which], self.sin[which]
        away: Floats = np.stack([cos * u - sin * v, sin * u + cos * v], axis=1)
        return np.asarray(self.centre[which] + away)
