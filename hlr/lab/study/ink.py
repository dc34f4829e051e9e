"""Classified lines as bare polylines on paper: all that contestants have in common."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from hlr.common.types import Floats
from hlr.drawing.curve import Arc, Curve
from hlr.drawing.drawing import Accuracy, Drawing, DrawnPart, DrawnView
from hlr.drawing.line import Kind, Line

Index = npt.NDArray[np.int64]

KINDS: tuple[Kind, ...] = ("sharp", "boundary", "intersection", "outline", "smooth", "seam")

MOST_PIECES = 20_000
"""Chords of one curve."""


@dataclass(frozen=True, slots=True)
class Ink:
    """Polylines in millimetres on paper, measured from where the model's origin is projected to.

    points (n, 2); offsets (k + 1,) into them; visible (k,) bool; kind (k,) uint8 into `KINDS`
    """

    points: Floats
    offsets: Index
    visible: npt.NDArray[np.bool_]
    kind: npt.NDArray[np.uint8]

    def segments(self, chosen: npt.NDArray[np.bool_] | None = None) -> Floats:
        """(m, 4) the straight pieces of all lines, or of those whose number (k,) is chosen."""
        owner = self.owner()
        same = owner[1:] == owner[:-1]
        if chosen is not None:
            same &= chosen[owner[:-1]]
        return np.concatenate([self.points[:-1][same], self.points[1:][same]], axis=1)

    def owner(self) -> Index:
        """(n,) the line of each point."""
        return np.repeat(np.arange(len(self.offsets) - 1), np.diff(self.offsets))

    def save(self, path: Path) -> None:
        """As a NumPy archive."""
        np.savez(path, points=self.points, offsets=self.offsets, visible=self.visible, kind=self.kind)


def load(path: Path) -> Ink:
    """What `save` wrote."""
    with np.load(path) as arrays:
        return Ink(arrays["points"], arrays["offsets"], arrays["visible"], arrays["kind"])


def gathered(lines: Sequence[tuple[str, bool, Floats]]) -> Ink:
    """From (kind, visible, points (m, 2)) of each line."""
    counts = [len(points) for _, _, points in lines]
    return Ink(
        np.concatenate([points for _, _, points in lines]) if lines else np.empty((0, 2)),
        np.concatenate([[0], np.cumsum(counts, dtype=np.int64)]).astype(np.int64),
        np.array([visible for _, visible, _ in lines], bool),
        np.array([KINDS.index(kind) for kind, _, _ in lines], np.uint8),
    )


def ink_of(drawing: Drawing, chord: float) -> Ink:
    """The lines of a drawing; curves become chords that are off by at most `chord` millimetres."""
    origin = np.asarray(drawing.origin)
    lines = []
    for line in drawing.lines:
        points = line.points if line.curve is None else _flattened(line.curve, chord)
        lines.append((line.kind, line.visible, points + origin))
    return gathered(lines)


def _flattened(curve: Curve, chord: float) -> Floats:
    """Chords of n pieces are off by |second difference| / 8 n^2."""
    if isinstance(curve, Arc):
        start, end = curve.angles
        count = math.ceil(abs(end - start) * math.sqrt(max(curve.radii) / (8.0 * chord)))
        return curve.at(np.linspace(start, end, min(max(count, 1), MOST_PIECES) + 1))
    d = curve.degree
    pieces = (len(curve.points) - 1) // d
    p = np.stack([curve.points[k : k + d * (pieces - 1) + 1 : d] for k in range(d + 1)])
    bend = np.linalg.norm(np.diff(p, n=2, axis=0), axis=2).max(axis=0) * (d * (d - 1))
    count = np.clip(np.ceil(np.sqrt(bend / (8.0 * chord))), 1, MOST_PIECES).astype(np.int64)
    which = np.repeat(np.arange(pieces), count)
    first = np.cumsum(count) - count
    inside = (np.arange(len(which)) - first[which]) / count[which]
    return curve.at(np.append(which + inside, float(pieces)))


def drawing_of(ink: Ink, source: str, view: DrawnView, scale: float, accuracy: float) -> Drawing:
    """Bare lines as a drawing, so that the same writer says how many bytes they need."""
    low = ink.points.min(axis=0) if len(ink.points) else np.zeros(2)
    flat = ink.points - low
    lines = tuple(
        Line(KINDS[ink.kind[i]], bool(ink.visible[i]), 0, None, None, part, np.empty((len(part), 3)))
        for i, part in enumerate(np.split(flat, ink.offsets[1:-1]))
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
        lines=lines if len(ink.visible) else (),
    )
