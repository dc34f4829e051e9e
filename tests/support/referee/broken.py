"""Finds broken lines: two ends of visible lines that touch nothing and point at one another, with an edge in between.

Rays find lines that are wrongly drawn, and the depth image finds edges that lack a line. Neither sees a gap between two
lines that meet at a shallow angle, for each is right within its tolerance, and beside the gap there is always a line.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from support.referee.depth import Depths
from support.referee.exchange import DrawnLine, Exchange, Floats
from support.referee.missing import edge_between

LOOSE = 4.0
"""Accuracies: an end this far from every other line touches nothing."""
SEEN = 0.1
"""Millimetres: shorter gaps are less than the width of the thinnest pen."""
REACH = 100.0
"""Accuracies: ends farther apart belong to two lines."""
STRAIGHT_ON = float(np.cos(np.radians(25)))
TANGENT = 6.0
"""Accuracies of a line's end that tell its direction."""
ASIDE = 6.0
"""Accuracies to both sides of a gap between which there is an edge."""


@dataclass(frozen=True)
class Break:
    """A gap in a line: its length and its middle on paper, both in millimetres."""

    length: float
    at: tuple[float, float]


def broken(drawing: Exchange, depths: Depths | None = None) -> list[Break]:
    """The gaps, longest first; none in a drawing that does not state its accuracy.

    depths: what is seen of the model; without them any two such ends are a gap, also where an edge fades out.
    """
    accuracy = drawing.accuracy
    lines = [line for line in drawing.lines if line.visible]
    if not accuracy or not lines:
        return []
    ends, ways = _loose(lines, accuracy)
    found = []
    for i, j in cKDTree(ends).query_pairs(REACH * accuracy) if len(ends) else ():
        across = ends[j] - ends[i]
        length = float(np.linalg.norm(across))
        if length > SEEN and min(ways[i] @ across, -(ways[j] @ across)) > STRAIGHT_ON * length:
            middle, aside = (ends[i] + ends[j]) / 2, ASIDE * accuracy / length * np.array([-across[1], across[0]])
            if depths is None or edge_between(depths, (middle - aside)[None], (middle + aside)[None], accuracy)[0]:
                found.append(Break(length, (float(middle[0]), float(middle[1]))))
    return sorted(found, key=lambda gap: -gap.length)


def _loose(lines: list[DrawnLine], accuracy: float) -> tuple[Floats, Floats]:
    """Ends that touch no other line (n, 2), and the unit directions in which they point."""
    near = LOOSE * accuracy
    ink = [line.ink(near / 4) for line in lines]
    points, owner = np.concatenate(ink), np.repeat(np.arange(len(ink)), [len(each) for each in ink])
    tree = cKDTree(points)
    ends, ways = [], []
    for number, each in enumerate(ink):
        for path in (each, each[::-1]):
            away = np.linalg.norm(path - path[0], axis=1)
            left = np.flatnonzero(away > TANGENT * accuracy)
            if not len(left):  # a line as short as that has no direction
                continue
            around = np.array(tree.query_ball_point(path[0], near))
            # A closed line touches itself: with ink beyond the place where it first left the end.
            back = np.flatnonzero(away[left[0] :] <= near)
            if (owner[around] == number).all() and not len(back):
                ends.append(path[0])
                ways.append((path[0] - path[left[0]]) / away[left[0]])
    return np.array(ends).reshape(-1, 2), np.array(ways).reshape(-1, 2)
