"""Cuts lines at the border of a window: polylines, arcs and Bezier chains, each exactly where it crosses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from hlr.common.distinct import distinct
from hlr.drawing.curve import Arc, Bezier, Curve
from hlr.drawing.line import Line
from hlr.window.frame import Window
from hlr.window.tracks import Track, track_of

Floats = npt.NDArray[np.float64]


def cut_lines(lines: Sequence[Line], window: Window) -> tuple[tuple[Line, ...], int]:
    """The parts of the lines inside the window, in their order, and how many lines were cut or left out.

    A line wholly inside the window stays the same object.
    """
    if not lines:
        return (), 0
    boxes = _boxes(lines)
    inside, outside = (which.tolist() for which in window.apart(boxes))
    out: list[Line] = []
    cuts = 0
    for i, line in enumerate(lines):
        if inside[i]:
            out.append(line)
            continue
        pieces = [] if outside[i] else _cut(line, window)
        cuts += not (len(pieces) == 1 and pieces[0] is line)
        out += pieces
    return tuple(out), cuts


def _boxes(lines: Sequence[Line]) -> Floats:
    """(n, 4) low and high corner around each line, a little too large for curves."""
    held = [_around(line.curve, line.points) for line in lines]
    starts = np.cumsum([0, *map(len, held)])[:-1]
    every = np.concatenate(held)
    return np.concatenate([np.minimum.reduceat(every, starts), np.maximum.reduceat(every, starts)], axis=1)


def _around(curve: Curve | None, points: Floats) -> Floats:
    """Points whose box holds the line."""
    if isinstance(curve, Bezier):
        return np.concatenate([points, curve.points])
    if isinstance(curve, Arc):
        reach = np.hypot(curve.axes[0], curve.axes[1])
        return np.concatenate([points, [curve.centre - reach, curve.centre + reach]])
    return points


def _cut(line: Line, window: Window) -> list[Line]:
    track = track_of(line)
    breaks = distinct(np.concatenate([track.breaks, *window.crossings(track)]))
    # Between two breaks the line crosses no border of the window: its middle tells whether it is inside.
    middle = track.at(0.5 * (breaks[:-1] + breaks[1:]))
    kept = window.holds(middle).tolist()
    if all(kept):
        return [line]
    change = np.flatnonzero(np.diff(np.concatenate([[False], kept, [False]])))
    runs = [(float(breaks[a]), float(breaks[b])) for a, b in zip(change[::2], change[1::2], strict=True)]
    pieces = [piece for a, b in runs if (piece := _piece(line, track, a, b, window)) is not None]
    closed = bool((line.points[0] == line.points[-1]).all()) or (isinstance(line.curve, Arc) and line.curve.whole)
    if closed and len(pieces) > 1 and kept[0] and kept[-1]:
        return [*pieces[1:-1], _joined(pieces[-1], pieces[0])]
    return pieces


def _piece(line: Line, track: Track, a: float, b: float, window: Window) -> Line | None:
    """The piece of the line from parameter a to b; None where that is a single point."""
    between = (track.params > a) & (track.params < b)
    ends = [_end(line, track, t, window) for t in (a, b)]
    points = window.within(np.stack([ends[0][0], *line.points[between], ends[1][0]]))
    if (points == points[0]).all():
        return None
    space = np.stack([ends[0][1], *line.points3[between], ends[1][1]])
    points.flags.writeable = space.flags.writeable = False
    curve = track.between(a, b)
    if isinstance(curve, Bezier):
        for which, t in ((0, a), (-1, b)):
            if t != track.params[which]:  # the end lies on the side, to the last bit
                curve.points[which] = points[which]
    return replace(line, points=points, points3=space, curve=curve)


def _end(line: Line, track: Track, t: float, window: Window) -> tuple[Floats, Floats]:
    """Where the piece ends, on paper and in the model."""
    for which in (0, -1):
        if t == track.params[which]:
            return line.points[which], line.points3[which]
    place = window.onto(track.at(np.array([t]))[0])
    i = int(np.clip(np.searchsorted(track.params, t, side="right") - 1, 0, len(track.params) - 2))
    width = track.params[i + 1] - track.params[i]
    s = float((t - track.params[i]) / width) if width > 0.0 else 0.0
    (p, q), (u, v) = line.points[i : i + 2], line.points3[i : i + 2]
    return place, window.to_model(u, v, s, place - (p + (q - p) * s))


def _joined(first: Line, second: Line) -> Line:
    """Two pieces of a closed line, the second beginning where the first ends."""
    points = np.concatenate([first.points, second.points[1:]])
    space = np.concatenate([first.points3, second.points3[1:]])
    points.flags.writeable = space.flags.writeable = False
    curve: Curve | None = None
    if isinstance(first.curve, Arc) and isinstance(second.curve, Arc):
        start, end = first.curve.angles.tolist()
        further = second.curve.angles.tolist()
        curve = replace(first.curve, angles=np.array([start, end + further[1] - further[0]]))
    elif isinstance(first.curve, Bezier) and isinstance(second.curve, Bezier):
        curve = Bezier(first.curve.degree, np.concatenate([first.curve.points, second.curve.points[1:]]))
    return replace(first, points=points, points3=space, curve=curve)
