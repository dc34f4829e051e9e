"""Ink on paper, as samples of lines, however the lines are cut; and which samples lie beside other ink.

Two drawings of one model may consist of different lines. Their ink can be compared all the same.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

from hlr import Drawing, Line
from hlr.drawing.chords import bezier_pieces, evenly
from hlr.drawing.curve import Arc
from hlr.lab.sampling import middles, with_ends

Floats = npt.NDArray[np.float64]
Bools = npt.NDArray[np.bool_]
Stroke = tuple[bool, Floats]
"""Whether a line is visible, and its (n, 2) points on paper."""


@dataclass(frozen=True, eq=False)
class Ink:
    """Samples of lines.

    points (n, 2) on paper; length (n,): millimetres that each represents; visible (n,) bool; line (n,): its line
    """

    points: Floats
    length: Floats
    visible: Bools
    line: npt.NDArray[np.int64]

    @cached_property
    def trees(self) -> dict[bool, Any]:
        """A search tree of the points for each visibility; None if there is no such ink."""
        chosen = {visible: self.points[self.visible == visible] for visible in (True, False)}
        # Samples are evenly spaced along lines, so splitting in the middle is as good as at the median, and faster.
        return {
            visible: cKDTree(points, compact_nodes=False, balanced_tree=False) if len(points) else None
            for visible, points in chosen.items()
        }

    def total(self, visible: bool) -> float:
        """Millimetres of one visibility."""
        return float(self.length[self.visible == visible].sum())


def strokes(drawing: Drawing) -> list[Stroke]:
    """Lines on paper with a fixed origin; the drawing's own is its lower left corner, which moves with the model."""
    return [(line.visible, line.points + np.asarray(drawing.origin)) for line in drawing.lines]


def flat(line: Line) -> Floats:
    """(n, 2) a line's curve as a fine polyline."""
    if line.curve is None:
        return line.points
    return evenly(line.curve, 200 if isinstance(line.curve, Arc) else 40 * bezier_pieces(line.curve) + 1)


def ink(lines: Iterable[Stroke], step: float, *, ends: bool = False) -> Ink:
    """Every straight piece is cut into equal parts of at most `step` mm; samples are their middles, or their ends."""
    every = list(lines)
    pieces = [np.concatenate([points[:-1], points[1:]], axis=1) for _, points in every]
    segments = np.concatenate([np.zeros((0, 4)), *pieces])
    line = np.repeat(np.arange(len(every)), [len(piece) for piece in pieces])
    found = (with_ends if ends else middles)(segments, step)
    # All samples of a piece represent equal lengths.
    length = (found.length / (found.pieces + ends))[found.segment]
    visible = np.array([seen for seen, _ in every], bool)
    return Ink(found.points, length, visible[line[found.segment]], line[found.segment])


def beside(points: Floats, others: Ink, visible: bool, radius: float) -> Bools:
    """(n,) bool: the points that have ink of this visibility within the radius."""
    tree = others.trees[visible]
    if tree is None or not len(points):
        return np.zeros(len(points), bool)
    # Two points in one square with this diagonal are near enough. This test settles nearly all at a tenth of the cost.
    found = np.isin(_squares(points, radius), _squares(others.points[others.visible == visible], radius))
    rest = np.flatnonzero(~found)
    distance, _ = tree.query(points[rest], distance_upper_bound=radius)
    found[rest] = np.isfinite(distance)
    return found


def unmatched(these: Ink, others: Ink, radius: float) -> Bools:
    """(n,) bool: samples of `these` with no ink of `others` of the same visibility within the radius."""
    alone = np.zeros(len(these.length), bool)
    for visible in (True, False):
        mine = np.flatnonzero(these.visible == visible)
        alone[mine] = ~beside(these.points[mine], others, visible, radius)
    return alone


def stretches(these: Ink, chosen: Bools) -> list[npt.NDArray[np.int64]]:
    """Runs of neighbouring chosen samples of one line, each as the numbers of its samples."""
    which = np.flatnonzero(chosen)
    breaks = np.flatnonzero((np.diff(which) > 1) | (np.diff(these.line[which]) != 0)) + 1
    return [run for run in np.split(which, breaks) if len(run)]


def _squares(points: Floats, diagonal: float) -> npt.NDArray[np.int64]:
    """(n,) a number for the square of a grid that each point lies in."""
    column, row = np.floor(points * (np.sqrt(2.0) / diagonal)).astype(np.int64).T
    return column * (1 << 31) + row
