"""Distance of written intersection lines to the lines in which finer tessellations of the two surfaces cross.

All crossings count, however shallow. The contact tolerance decides whether a crossing is drawn, not where it lies.
"""

from __future__ import annotations

import numpy as np

from hlr import _kernel
from hlr.drawing.drawing import Drawing
from hlr.drawing.reached import Errors, errors
from hlr.lab.measure.paper import Paper
from hlr.lab.measure.rays import Caster
from hlr.lab.measure.written import Written


def intersection_errors(drawing: Drawing, drawn: Written, caster: Caster, paper: Paper) -> Errors:
    """The largest distance of each intersection line, millimetres on paper."""
    lines = [(i, x) for i, x in enumerate(drawing.lines) if x.kind == "intersection"]
    if not lines:
        return Errors(None, why="the drawing has none")
    pairs = sorted({_pair(x.part, x.other) for _, x in lines})
    key = np.full(len(drawing.lines), -1, np.int32)
    key[[i for i, _ in lines]] = [pairs.index(_pair(x.part, x.other)) for _, x in lines]
    parts = np.unique(pairs)
    itself = np.isin(parts, [a for a, b in pairs if a == b])
    chosen = np.isin(caster.part, parts)
    part = np.searchsorted(parts, caster.part[chosen]).astype(np.int32)
    triangles = np.ascontiguousarray(caster.triangles[chosen])
    found = _kernel.clashes(caster.points, triangles, part, itself)
    both = np.sort(parts[part[found["triangles"]]], axis=1)
    ends, _ = paper.chords(*found["points"][found["edges"].T])
    both, ends = both[np.isfinite(ends).all(axis=1)], ends[np.isfinite(ends).all(axis=1)]
    mine = np.flatnonzero(key[drawn.line] >= 0)
    line = drawn.line[mine]
    off = np.full(len(mine), np.inf)
    for number, pair in enumerate(pairs):
        of = np.ascontiguousarray(ends[(both == pair).all(axis=1)])
        here = key[line] == number
        points, zero = np.ascontiguousarray(drawn.points[mine[here]]), np.zeros(int(here.sum()), np.int32)
        off[here] = _kernel.nearest(points, zero, of, np.zeros(len(of), np.int32), np.inf)[0]
    if not np.isfinite(off).all():
        return Errors(None, why="the finer tessellations do not cross")
    starts = np.flatnonzero(np.append(True, line[1:] != line[:-1]))
    names = [_name(drawing, i) for i in line[starts].tolist()]
    return errors(np.maximum.reduceat(off, starts), names)


def _pair(part: int, other: int | None) -> tuple[int, int]:
    return (part, part) if other is None else (min(part, other), max(part, other))


def _name(drawing: Drawing, line: int) -> str:
    a, b = _pair(drawing.lines[line].part, drawing.lines[line].other)
    x, y = drawing.lines[line].points[0]
    return f"{drawing.parts[a].name} and {drawing.parts[b].name}, at {x:.2f},{y:.2f}"
