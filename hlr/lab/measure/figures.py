"""The shortest figure: connected lines of one visibility that touch no other line."""

from __future__ import annotations

import numpy as np

from hlr import _kernel
from hlr.common.types import Floats, Ints
from hlr.drawing.chords import Index
from hlr.drawing.drawing import Drawing
from hlr.drawing.reached import Errors
from hlr.lab.measure.written import Written


def shortest(drawing: Drawing, drawn: Written) -> Errors:
    """Length of the shortest figure, mm on paper. Lines are connected where their ends meet or one ends on another."""
    accuracy = drawing.accuracy.used
    if not drawing.lines:
        return Errors(None, why="the drawing has none")
    segments, line = drawn.steps()
    size = np.hypot(segments[:, 2] - segments[:, 0], segments[:, 3] - segments[:, 1])
    length = np.bincount(line, weights=size, minlength=len(drawing.lines))
    figure = _joined(drawing)
    total = np.bincount(figure, weights=length)[figure]
    # A line that the file rounds to a point is not drawn.
    small = np.flatnonzero((total < accuracy) & (length > 0.0))
    alone = np.array([i for i in small.tolist() if _is_alone(i, figure, drawing, segments, line, accuracy)])
    longer = total[(total >= accuracy) & (length > 0.0)]
    found = np.concatenate([total[alone.astype(np.int64)], longer])
    if len(found) == 0:
        return Errors(None, why="the drawing has none")
    return Errors(float(found.min()), None, int(np.unique(figure).size))


def _joined(drawing: Drawing) -> Ints:
    """(lines,) the number of each line's figure; lines of one visibility whose ends coincide form a figure."""
    number: dict[tuple[bool, float, float], int] = {}
    ends = np.array(
        [
            [
                number.setdefault((x.visible, float(p[0]) + 0.0, float(p[1]) + 0.0), len(number))
                for p in x.points[[0, -1]]
            ]
            for x in drawing.lines
        ],
        np.int32,
    )
    return np.asarray(_kernel.edge_components(ends, len(number)))


def _is_alone(line: int, figure: Ints, drawing: Drawing, segments: Floats, owner: Index, accuracy: float) -> bool:
    """Whether neither end of a line is within the accuracy of another figure's line."""
    others = segments[figure[owner] != figure[line]]
    if len(others) == 0:
        return True
    ends = np.ascontiguousarray(drawing.lines[line].points[[0, -1]])
    zero, none = np.zeros(2, np.int32), np.zeros(len(others), np.int32)
    found, _ = _kernel.nearest(ends, zero, np.ascontiguousarray(others), none, accuracy)
    return not bool(np.isfinite(found).any())
