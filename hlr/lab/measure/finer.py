"""Visibility changes and lost lines: against the same view drawn at a finer accuracy.

Lines are matched edge by edge (outlines face by face, lines of meshes part by part and class by class). Where the two
drawings disagree about visibility, a change of visibility is displaced by the length of that stretch:

::

        this    visible ------------------|- - - - - - - - hidden
        finer   visible -------------|- - - - - - - - - -  hidden
                                     <--->  displaced

Of a stretch longer than the accuracy, only the part that rays contradict counts (see `rays`). The rest is
ill-conditioned: a shift across the line of less than the accuracy, or a depth of less than the contact tolerance,
decides whether it is visible.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.types import Floats, Ints
from hlr.drawing.chords import Index
from hlr.drawing.drawing import Drawing
from hlr.drawing.line import Line
from hlr.drawing.pens import usual_pens_of
from hlr.drawing.reached import Errors, errors
from hlr.errors import HlrError
from hlr.lab.measure.rays import Caster, contradicted, longest_run, runs
from hlr.lab.measure.written import Written, written
from hlr.request.accuracy import MEASURED_REACH, MEASURED_SAME, MEASURED_SAMPLE

Mask = npt.NDArray[np.bool_]

BETWEEN = 5
"""Factor by which samples for rays are denser on a stretch that is longer than the accuracy."""
MOST_SAMPLES = 2_000_000
"""Along all lines; beyond, samples are farther apart than they should be, and what they find is not finer than that."""


@dataclass(frozen=True, slots=True)
class Finer:
    """The finer drawing, brought to the scale and origin of the drawing that is measured.

    drawing   the finer drawing as it was made; segments (n, 4), the line (n,) of each, and points along the lines
    """

    drawing: Drawing
    drawn: Written
    segments: Floats
    line: Index


def drawn_again(opened: Any, drawing: Drawing, fineness: float = 1.0, *, details: bool = False) -> Drawing | str:
    """Draw the same request at a finer accuracy; returns the reason if that is impossible.

    details: draw all details, whatever the request says.
    """
    request = drawing.request
    assert request is not None
    from hlr.pipeline.draw import draw_views

    accuracy = drawing.accuracy.used / fineness
    options = replace(request.options, accuracy=accuracy, fill=False, style=None, strict=False, report=False)
    options = replace(options, details=details or options.details)
    if options.fit is None:
        # At the same scale, though outlines that are known better might fit the page at another.
        options = replace(options, scale=drawing.scale, page=None)
    try:
        (found,) = draw_views(opened, [request.view], options)
    except (HlrError, MemoryError) as error:
        return f"no finer drawing to compare with: {error or 'out of memory'}"
    return found


def on_the_same_paper(finer: Drawing, drawing: Drawing) -> Finer:
    """Scale and shift the finer drawing to the other's paper; fitted to a sheet, the two differ a little in both."""
    drawn = written(finer)
    shift = np.array(finer.origin)
    points = (drawn.points + shift) * (drawing.scale / finer.scale) - np.array(drawing.origin)
    drawn = Written(points, drawn.line)
    return Finer(finer, drawn, *drawn.steps())


def _key(line: Line) -> tuple[int, str, int]:
    """The key by which lines of both drawings are matched."""
    if line.edge is not None:
        return line.part, "edge", line.edge
    if line.face is not None:
        return line.part, "face", line.face
    return line.part, line.kind, -1 if line.other is None else line.other


class Comparison:
    """Compares a drawing with a finer one."""

    def __init__(self, drawing: Drawing, drawn: Written, finer: Finer) -> None:
        self._drawing, self._drawn, self._finer = drawing, drawn, finer
        self._accuracy = drawing.accuracy.used
        keys = sorted({_key(x) for x in (*drawing.lines, *finer.drawing.lines)})
        self._number = {key: i for i, key in enumerate(keys)}
        self._own = self._keys(drawing)
        self._theirs = self._keys(finer.drawing)

    def _keys(self, drawing: Drawing) -> Ints:
        """(lines,) the number of each line's key, doubled; plus one if the line is hidden."""
        return np.array([2 * self._number[_key(x)] + (not x.visible) for x in drawing.lines], np.int32)

    def _step(self, drawn: Written) -> float:
        segments, _ = drawn.steps()
        length = float(np.hypot(segments[:, 2] - segments[:, 0], segments[:, 3] - segments[:, 1]).sum())
        return max(MEASURED_SAMPLE * self._accuracy, length / MOST_SAMPLES)

    def _to_finer(self, points: Floats, key: Ints, most: float) -> Floats:
        return _kernel.nearest(
            np.ascontiguousarray(points),
            np.ascontiguousarray(key),
            self._finer.segments,
            np.ascontiguousarray(self._theirs[self._finer.line]),
            most,
        )[0]

    def changes(self, caster: Caster) -> tuple[Errors, Errors, float | None]:
        """Displaced changes, ill-conditioned stretches, and the longest ill-conditioned part of one; all in mm."""
        accuracy, step = self._accuracy, self._step(self._drawn)
        points, line = self._drawn.middles(step)
        key = self._own[line]
        reach = MEASURED_REACH * accuracy
        same, other = self._to_finer(points, key, reach), self._to_finer(points, key ^ 1, reach)
        differ = (other <= accuracy) & (other < same) & (same > MEASURED_SAME * accuracy)
        start, length = runs(points, line, differ, step)
        found = [*self._ends().tolist(), *length[length <= accuracy].tolist()]
        doubtful, bound = [], 0.0
        for first, size in zip(start[length > accuracy].tolist(), length[length > accuracy].tolist(), strict=True):
            own = np.arange(first, min(first + int(np.ceil(size / step)) + 1, len(points)))
            own = own[(line[own] == line[first]) & differ[own]]
            here = _between(points[own])
            of = np.full(len(here), line[first])
            wrong = contradicted(self._drawing, self._drawn, here, of, caster)
            found.append(longest_run(here, of, wrong, step / BETWEEN)[1])
            doubtful.append(size)
            bound = max(bound, longest_run(here, of, ~wrong, step / BETWEEN)[1])
        grazing = errors(np.array(doubtful)) if doubtful else Errors(None, why="none is ill-conditioned")
        return errors(np.array(found)), grazing, bound if doubtful else None

    def _ends(self) -> Floats:
        """(n,) distances, mm, of line ends to ends of the same edge in the finer drawing, if within the accuracy."""
        mine, key = _ends_of(self._drawing, self._own)
        theirs, their_key = _ends_of(self._finer.drawing, self._theirs)
        shift = np.array(self._finer.drawing.origin)
        theirs = (theirs + shift) * (self._drawing.scale / self._finer.drawing.scale) - np.array(self._drawing.origin)
        dots = np.ascontiguousarray(np.concatenate([theirs, theirs], axis=1))
        found, _ = _kernel.nearest(mine, key, dots, their_key, self._accuracy)
        return found[np.isfinite(found)]

    def lost(self, under: float, whole: Finer | None) -> Errors:
        """Stretches of the finer drawing's lines that this drawing lacks.

        Intersection lines are left out: the contact tolerance decides whether they are drawn, and it depends on the
        accuracy.

        under: a hidden line within this distance (mm) of a visible one counts as lying under its ink
        whole: this drawing with all details, where the pen is too wide for some. These are not lost: they are as small
            as the pen, or no farther than its width from what is drawn
        """
        accuracy, step = self._accuracy, self._step(self._finer.drawn)
        points, line = self._finer.drawn.middles(step)
        drawn = np.array([x.kind != "intersection" for x in self._finer.drawing.lines], bool)[line]
        points, line = np.ascontiguousarray(points[drawn]), line[drawn]
        segments, of = self._drawn.steps()
        visible = np.array([x.visible for x in self._drawing.lines], bool)[of]
        wanted = np.array([x.visible for x in self._finer.drawing.lines], bool)[line]

        def far(those: Floats, most: float) -> Mask:
            none, zero = np.zeros(len(points), np.int32), np.zeros(len(those), np.int32)
            found, _ = _kernel.nearest(points, none, np.ascontiguousarray(those), zero, most)
            return ~np.isfinite(found)

        reach = (1.0 + MEASURED_SAME) * accuracy
        missing = far(segments, reach)
        if missing.any():
            missing &= wanted | far(segments[visible], under + accuracy)
        pen, absent = 0.0, missing
        if whole is not None and missing.any():
            pen, absent = usual_pens_of(self._drawing).wide, far(whole.segments, reach)
            missing &= absent | far(segments, pen)
        start, length = runs(points, line, missing, step)
        is_lost = absent[start] | (length >= pen)
        start, length = start[is_lost], length[is_lost]
        if len(points) == 0:
            return Errors(None, why="the drawing has none")
        where = [self._name(int(line[i]), points[i]) for i in start]
        if not len(start):
            return Errors(0.0, 0.0, len(self._finer.drawing.lines))
        found = errors(length, where)
        return replace(found, count=len(self._finer.drawing.lines))

    def _name(self, line: int, at: Floats) -> str:
        of = self._finer.drawing.lines[line]
        name = self._finer.drawing.parts[of.part].name
        tie = f"edge {of.edge}" if of.edge is not None else f"face {of.face}"
        return f"{name}, {of.kind} {'visible' if of.visible else 'hidden'} {tie} at {at[0]:.2f},{at[1]:.2f}"


def _between(points: Floats) -> Floats:
    """The points (n, 2) of a stretch, with more points between them."""
    t = np.arange(0, (len(points) - 1) * BETWEEN + 1) / BETWEEN
    return np.stack([np.interp(t, np.arange(len(points)), points[:, k]) for k in (0, 1)], axis=1)


def _ends_of(drawing: Drawing, key: Ints) -> tuple[Floats, Ints]:
    """(2 n, 2) ends of lines that do not close, and the keys (2 n,) of their edges and visibility."""
    ends = [x.points[[0, -1]] for x in drawing.lines]
    if not ends:
        return np.zeros((0, 2)), np.zeros(0, np.int32)
    points = np.array(ends)
    open_ = (points[:, 0] != points[:, 1]).any(axis=1)
    return np.ascontiguousarray(points[open_].reshape(-1, 2)), np.repeat(key[open_], 2).astype(np.int32)
