"""The difference of two drawings: millimetres of ink lost and gained, visible and hidden ones separate."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from support.ink import Bools, Floats, Ink, beside, unmatched

STEP = 0.5
"""Accuracies between samples along a line."""
NEAR = 3.0
"""Accuracies within which ink is the same ink: what two drawings that keep their promise may be apart, and the ends of
lines with them."""
COVER = 5.0
"""Accuracies on either side of a visible line that its ink covers: half of 0.5 mm at the usual accuracy."""


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


def covered(points: Floats, before: Ink, after: Ink, cover: float) -> Bools:
    """(n,) bool: points beneath visible lines of both drawings."""
    return beside(points, before, True, cover) & beside(points, after, True, cover)


def change(before: Ink, after: Ink, accuracy: float, moved: float = 0.0) -> Change:
    """What is in one drawing and not in the other; moved: how far the model itself went, on paper."""
    under = 0.0
    found = []
    for these, others in ((before, after), (after, before)):
        alone = np.flatnonzero(unmatched(these, others, NEAR * accuracy + moved))
        visible, length = these.visible[alone], these.length[alone]
        below = ~visible & covered(these.points[alone], before, after, COVER * accuracy + moved)
        under += float(length[below].sum())
        found.append((float(length[visible].sum()), float(length[~visible & ~below].sum())))
    (lost_visible, lost_hidden), (gained_visible, gained_hidden) = found
    return Change(lost_visible, gained_visible, lost_hidden, gained_hidden, under)
