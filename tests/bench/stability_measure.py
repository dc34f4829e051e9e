"""How much of one drawing is not in another: ink by length, visible and hidden apart."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

Floats = npt.NDArray[np.float64]
Bools = npt.NDArray[np.bool_]
Stroke = tuple[bool, Floats]
"""Whether it is visible, and its (n, 2) points on paper."""

STEP = 0.5
"""Accuracies between samples along a line."""
NEAR = 3.0
"""Accuracies within which ink is the same ink: what two drawings that keep their promise may be apart, and the ends of
lines with them."""
COVER = 5.0
"""Accuracies on either side of a visible line that its ink covers: half of 0.5 mm at the usual accuracy."""


@dataclass(frozen=True, eq=False)
class Ink:
    """Samples of a drawing's lines.

    places (n, 2) on paper; length (n,) that each stands for; visible (n,) bool; stroke (n,) number of its line
    """

    places: Floats
    length: Floats
    visible: Bools
    stroke: npt.NDArray[np.int64]

    @cached_property
    def trees(self) -> dict[bool, Any]:
        """By visibility a search tree of the places; None where there is no such ink."""
        chosen = {visible: self.places[self.visible == visible] for visible in (True, False)}
        # Samples come in rows along lines: splitting in the middle is as good as at the median, and much faster.
        return {
            visible: cKDTree(places, compact_nodes=False, balanced_tree=False) if len(places) else None
            for visible, places in chosen.items()
        }

    def total(self, visible: bool) -> float:
        return float(self.length[self.visible == visible].sum())


@dataclass(frozen=True)
class Change:
    """Lengths on paper: ink of one visibility that was there and is not, and that was not there and is.

    under: hidden ink, lost or gained, beneath visible lines that both drawings have. On paper it does not show, and
    whether it is drawn there at all is a matter of style.
    """

    lost_visible: float
    gained_visible: float
    lost_hidden: float
    gained_hidden: float
    under: float


def ink(strokes: Iterable[Stroke], step: float) -> Ink:
    """Every straight piece is cut into equal parts of at most `step`; a sample is the middle of one."""
    lines = list(strokes)
    if not lines:
        return Ink(np.zeros((0, 2)), np.zeros(0), np.zeros(0, bool), np.zeros(0, np.int64))
    start = np.concatenate([points[:-1] for _, points in lines])
    way = np.concatenate([points[1:] for _, points in lines]) - start
    pieces = [len(points) - 1 for _, points in lines]
    length = np.hypot(way[:, 0], way[:, 1])
    parts = np.maximum(np.ceil(length / step), 1).astype(np.int64)
    piece = np.repeat(np.arange(len(parts)), parts)
    along = (np.arange(len(piece)) - np.repeat(np.cumsum(parts) - parts, parts) + 0.5) / parts[piece]
    stroke = np.repeat(np.arange(len(lines)), pieces)[piece]
    visible = np.array([seen for seen, _ in lines], bool)
    return Ink(start[piece] + along[:, None] * way[piece], (length / parts)[piece], visible[stroke], stroke)


def beside(places: Floats, others: Ink, visible: bool, radius: float) -> Bools:
    """(n,) bool: the places that have ink of this visibility within the radius."""
    tree = others.trees[visible]
    if tree is None or not len(places):
        return np.zeros(len(places), bool)
    # Two places in one square of that diagonal are near enough: that settles nearly all, at a tenth of the cost.
    found = np.isin(_squares(places, radius), _squares(others.places[others.visible == visible], radius))
    rest = np.flatnonzero(~found)
    distance, _ = tree.query(places[rest], distance_upper_bound=radius)
    found[rest] = np.isfinite(distance)
    return found


def _squares(places: Floats, diagonal: float) -> npt.NDArray[np.int64]:
    """(n,) a number for the square of a grid that each place lies in."""
    column, row = np.floor(places * (np.sqrt(2.0) / diagonal)).astype(np.int64).T
    return column * (1 << 31) + row


def unmatched(these: Ink, others: Ink, radius: float) -> Bools:
    """(n,) bool: samples of `these` with no ink of `others` of the same visibility within the radius."""
    alone = np.zeros(len(these.length), bool)
    for visible in (True, False):
        mine = np.flatnonzero(these.visible == visible)
        alone[mine] = ~beside(these.places[mine], others, visible, radius)
    return alone


def covered(places: Floats, before: Ink, after: Ink, cover: float) -> Bools:
    """(n,) bool: places beneath visible lines of both drawings."""
    return beside(places, before, True, cover) & beside(places, after, True, cover)


def change(before: Ink, after: Ink, accuracy: float, moved: float = 0.0) -> Change:
    """What is in one drawing and not in the other; moved: how far the model itself went, on paper."""
    under = 0.0
    found = []
    for these, others in ((before, after), (after, before)):
        alone = np.flatnonzero(unmatched(these, others, NEAR * accuracy + moved))
        visible, length = these.visible[alone], these.length[alone]
        below = ~visible & covered(these.places[alone], before, after, COVER * accuracy + moved)
        under += float(length[below].sum())
        found.append((float(length[visible].sum()), float(length[~visible & ~below].sum())))
    (lost_visible, lost_hidden), (gained_visible, gained_hidden) = found
    return Change(lost_visible, gained_visible, lost_hidden, gained_hidden, under)
