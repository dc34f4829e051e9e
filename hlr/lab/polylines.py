"""Polylines on paper with class and visibility: the one form that every drawing program's lines can be brought into."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from hlr.common.types import Floats
from hlr.drawing.chords import Index, chords
from hlr.drawing.drawing import Accuracy, Drawing, DrawnPart, DrawnView
from hlr.drawing.line import Line
from hlr.tables.line_classes import LINE_CLASSES, names


@dataclass(frozen=True, slots=True)
class Polylines:
    """k polylines in millimetres on paper, measured from the projection of the model's origin.

    points (n, 2); offsets (k + 1,) into points; visible (k,) bool; kind (k,) uint8: numbers of line classes
    """

    points: Floats
    offsets: Index
    visible: npt.NDArray[np.bool_]
    kind: npt.NDArray[np.uint8]

    def segments(self, chosen: npt.NDArray[np.bool_] | None = None) -> Floats:
        """(m, 4) the straight pieces of all lines, or of those lines that the mask (k,) chooses."""
        owner = self.owner()
        same = owner[1:] == owner[:-1]
        if chosen is not None:
            same &= chosen[owner[:-1]]
        return np.concatenate([self.points[:-1][same], self.points[1:][same]], axis=1)

    def owner(self) -> Index:
        """(n,) the number of the line to which each point belongs."""
        return np.repeat(np.arange(len(self.offsets) - 1), np.diff(self.offsets))

    def save(self, path: Path) -> None:
        """Write a NumPy archive."""
        np.savez(path, points=self.points, offsets=self.offsets, visible=self.visible, kind=self.kind)


def load(path: Path) -> Polylines:
    """Read the archive that `save` wrote."""
    with np.load(path) as arrays:
        return Polylines(arrays["points"], arrays["offsets"], arrays["visible"], arrays["kind"])


def gathered(lines: Sequence[tuple[str, bool, Floats]]) -> Polylines:
    """Make Polylines from (kind, visible, points (m, 2)) of each line."""
    counts = [len(points) for _, _, points in lines]
    return Polylines(
        np.concatenate([points for _, _, points in lines]) if lines else np.empty((0, 2)),
        np.concatenate([[0], np.cumsum(counts, dtype=np.int64)]).astype(np.int64),
        np.array([visible for _, visible, _ in lines], bool),
        np.array([LINE_CLASSES[kind].number for kind, _, _ in lines], np.uint8),
    )


def polylines_of(drawing: Drawing, chord: float) -> Polylines:
    """The lines of a drawing; curves become chords with a chord error of at most `chord` millimetres."""
    origin = np.asarray(drawing.origin)
    lines = []
    for line in drawing.lines:
        points = line.points if line.curve is None else chords(line.curve, chord)
        lines.append((line.kind, line.visible, points + origin))
    return gathered(lines)


def drawing_of(lines: Polylines, source: str, view: DrawnView, scale: float, accuracy: float) -> Drawing:
    """Polylines as a drawing, so that the sizes of all programs' files come from the same writer."""
    low = lines.points.min(axis=0) if len(lines.points) else np.zeros(2)
    flat, classes = lines.points - low, names()
    drawn = tuple(
        Line(classes[lines.kind[i]], bool(lines.visible[i]), 0, None, None, part, np.empty((len(part), 3)))
        for i, part in enumerate(np.split(flat, lines.offsets[1:-1]))
    )
    return Drawing(
        source=source,
        view=view,
        scale=scale,
        origin=(float(low[0]), float(low[1])),
        accuracy=Accuracy(accuracy, accuracy),
        unit=1.0,
        up_axis=((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
        parts=(DrawnPart(source, None, np.eye(4)),),
        lines=drawn if len(lines.visible) else (),
    )
