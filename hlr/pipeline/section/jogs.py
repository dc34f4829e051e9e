"""Where the plane of a section steps, the section has no line (ISO 128): it is drawn as if all lay in one plane."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from hlr.common.types import Floats
from hlr.drawing.drawing import Drawing
from hlr.drawing.line import Line
from hlr.linework.hatch_strokes import inside, uncovered
from hlr.linework.hatching import sides_of
from hlr.pipeline.section.plane import Planes

CLOSE = 1e-6
"""Of the size of a drawing: lines lie so close to the step that has made them."""

SHORT = 100.0
"""Times `CLOSE`: no part ends at a step along so short a way. Where its border crosses the step, its sides differ."""

_NO_PIECES = np.zeros((0, 2, 2))


def without_jogs(
    drawing: Drawing, planes: Planes, cut: Sequence[tuple[str, list[Floats]]], whose: Mapping[str, str]
) -> Drawing:
    """A drawing without the edges that steps have made where a part is cut on both sides of them.

    Where another part ends at the step, on the edge of the first, the two are one line of the drawing: it stays.

    cut: of each cut face the name of the whole part, and its loops (k, 2), millimetres on paper
    whose: the whole part of each part, by name
    """
    sides = {name: sides_of([loop for each, loops in cut if each == name for loop in loops]) for name, _ in cut}
    owner = [whose[part.name] for part in drawing.parts]
    area = drawing.area
    close = CLOSE * float(np.hypot(area.width, area.height))
    along, lines = np.array(planes.along), list(drawing.lines)
    turned = 1.0 if along @ np.array(drawing.view.right) > 0.0 else -1.0
    for step, (a, b) in zip(planes.steps, pairwise(planes.planes), strict=True):
        x = turned * step * drawing.scale * drawing.unit - drawing.origin[0]
        levels = sorted((a.height, b.height))
        goes_on = _going_on(x, close, sides)
        kept: list[Line] = []
        for line in lines:
            gone = goes_on.get(owner[line.part]) if line.kind == "sharp" else None
            on_step = gone is not None and _is_on_step(line, x, close, levels, planes)
            kept += _outside(line, x, close, gone) if gone is not None and on_step else [line]
        lines = kept
    removed = len(drawing.lines) - len(lines)
    counters = {**drawing.counters, "lines": drawing.counters.get("lines", 0) - removed}
    return replace(drawing, lines=tuple(lines), counters=counters)


def _going_on(x: float, close: float, sides: Mapping[str, Floats]) -> dict[str, Floats]:
    """Where parts go on across a step and no other part ends at it: pieces (n, 2, 2) of the step, by name.

    x: of the step; sides: of the cut faces of each part
    """
    step = _whole_step(x, close, sides)
    across: dict[str, Floats] = {}
    ends: dict[str, Floats] = {}
    for name, of_part in sides.items():
        on_left = _inside_beside(step, -2.0 * close, of_part)
        on_right = _inside_beside(step, 2.0 * close, of_part)
        across[name] = _inside_beside(on_right, -2.0 * close, of_part)
        ends[name] = _on_one_side_only(on_left, on_right, close)
    found = {}
    for name, own in across.items():
        ends_of_others = [pieces for other, pieces in ends.items() if other != name]
        found[name] = _without(own, np.concatenate([_NO_PIECES, *ends_of_others]), close)
    return {name: pieces for name, pieces in found.items() if len(pieces)}


def _whole_step(x: float, close: float, sides: Mapping[str, Floats]) -> Floats:
    """A step as one upright piece (1, 2, 2), as long as all cut faces are high; (0, 2, 2) where there are none."""
    heights = np.concatenate([np.zeros(0), *(of_part[..., 1].ravel() for of_part in sides.values())])
    if not len(heights):
        return _NO_PIECES
    return np.array([[[x, heights.min() - close], [x, heights.max() + close]]])


def _inside_beside(pieces: Floats, away: float, sides: Floats) -> Floats:
    """What of upright pieces (n, 2, 2) lies in cut faces, where one looks this far beside it (to the left below 0)."""
    shift = np.array([away, 0.0])
    return np.asarray(inside(pieces + shift, sides, winding=True) - shift)


def _on_one_side_only(on_left: Floats, on_right: Floats, close: float) -> Floats:
    """Where a part ends at a step: pieces that have a cut face on one side of it, but for short ones."""
    ends = np.concatenate([_without(on_left, on_right, close), _without(on_right, on_left, close)])
    return np.asarray(ends[np.abs(ends[:, 1, 1] - ends[:, 0, 1]) > SHORT * close])


def _is_on_step(line: Line, x: float, close: float, levels: Sequence[float], planes: Planes) -> bool:
    """Whether a line lies on a step: on paper, and between the two planes."""
    if not (np.abs(line.points[:, 0] - x) <= close).all():
        return False
    heights = line.points3 @ np.array(planes.normal)
    return bool(heights.min() >= levels[0] - planes.near and heights.max() <= levels[1] + planes.near)


def _outside(line: Line, x: float, close: float, gone: Floats) -> list[Line]:
    """What is left of a line on a step without these pieces of the step."""
    ends = np.array([line.points[0], line.points[-1]])
    ends[:, 0] = x
    lost = inside(ends[None], _as_loops(gone, close), winding=True)
    if not (np.abs(lost[:, 1, 1] - lost[:, 0, 1]) > 4.0 * close).any():
        return [line]
    left = _without(ends[None], gone, close)
    share = (left[..., 1] - ends[0, 1]) / (ends[1, 1] - ends[0, 1])
    way = line.points3[-1] - line.points3[0]
    return [
        replace(line, points=piece, points3=line.points3[0] + each[:, None] * way, curve=None)
        for piece, each in zip(left, share, strict=True)
        if abs(each[1] - each[0]) * np.hypot(*(ends[1] - ends[0])) > 4.0 * close
    ]


def _without(pieces: Floats, gone: Floats, close: float) -> Floats:
    """What is left of upright pieces (n, 2, 2) outside of others, (k, 2, 2)."""
    return uncovered(pieces, _as_loops(gone, close))


def _as_loops(pieces: Floats, close: float) -> Floats:
    """Narrow boxes around upright pieces (n, 2, 2), as sides, anticlockwise."""
    found = [_NO_PIECES]
    for piece in pieces:
        x, (low, high) = piece[0, 0], np.sort(piece[:, 1])
        low, high = low - close, high + close
        found.append(sides_of([np.array([(x - close, low), (x + close, low), (x + close, high), (x - close, high)])]))
    return np.concatenate(found)
