"""Finds missing lines: is everything drawn that is plainly visible?

The ray test judges only lines that are drawn, so an empty drawing would pass it, and so would a contour that is wrongly
hidden (its own body blocks half of its ring). Here a depth image of the model is used instead: where the depth jumps
or the normal turns between two pixels, a visible line has to run nearby. If none does, the jump is located by repeated
halving between the two pixels, so that a surface that is merely steep or round does not count.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.ndimage import label
from scipy.spatial import cKDTree

from support.referee.depth import Depths, Hits, Sheet, dots
from support.referee.exchange import Exchange, Floats

NEAR = 2.5
"""A visible line this many pixels away will do."""
JUMP = 1.0
"""Pixels of depth, and at least as many accuracies as the next."""
CONTACT = 4.0
"""Accuracies: what runs into one another by less counts as touching, and what rises by less is no fold. On a slope a
step of so much across the line of sight is one of as much more in depth."""
SHARP = np.cos(np.radians(40))
"""Well over the crease angle of 30 degrees and the turn of a tessellated fillet, so that there is no arguing."""
BAND = 32
"""Rows of pixels at once: what is computed of so many stays in the cache of a processor."""
HALVINGS = 9
WIDE = 4.0
"""Accuracies: both sides of a place go on this far. Cracks between unjoined faces are narrower."""
USUAL = 1 / 6
"""Pixels of accuracy of a drawing that does not say."""
RING = 16
SECTOR = 3
"""Of the points of a ring: corners sharper than that are not judged."""
REACH = 3
"""Pixels between missing places of one run."""
SHORT = 5.0
"""Pixels: runs up to this long are counted, but are no fault; where lines end, figures are blunted by so much."""


@dataclass(frozen=True)
class Run:
    """Neighbouring places without a line: the length of the run, and its middle on paper, both in millimetres."""

    length: float
    at: tuple[float, float]


@dataclass(frozen=True)
class Missing:
    """Places (n, 2) on paper that lack a visible line; asked: the number of places at which there should be one."""

    asked: int
    places: Floats
    runs: list[Run]
    pixel: float

    @property
    def worst(self) -> float:
        """Millimetres of the longest run."""
        return max((run.length for run in self.runs), default=0.0)

    @property
    def faults(self) -> list[Run]:
        """Runs too long to be explained by the tolerances, longest first."""
        return [run for run in self.runs if run.length > SHORT * self.pixel]


def missing(drawing: Exchange, depths: Depths, sheet: Sheet, image: Hits) -> Missing:
    """Compare the lines of a drawing with the depth image of its sheet."""
    accuracy = drawing.accuracy or USUAL * sheet.pixel
    jump = max(JUMP * sheet.pixel, CONTACT * accuracy)
    drawn = [line.ink(sheet.pixel / 4) for line in drawing.lines if line.visible]
    near = cKDTree(np.concatenate(drawn)) if drawn else None
    answered, absent = 0, []
    for one, other in ((np.s_[:, :-1], np.s_[:, 1:]), (np.s_[:-1, :], np.s_[1:, :])):
        a, b = image[one], image[other]
        way = sheet.centres[other] - sheet.centres[one]
        bands = [np.s_[row : row + BAND] for row in range(0, len(way), BAND)]
        candidate = np.concatenate(
            [(_off_plane(a[rows], b[rows], way[rows]) > jump) | (_turn(a[rows], b[rows]) < SHARP) for rows in bands]
        )
        pairs = Pairs(sheet.centres[one][candidate], sheet.centres[other][candidate], a[candidate], b[candidate])
        if near is not None and len(pairs.start):
            distance, _ = near.query(pairs.middle, distance_upper_bound=NEAR * sheet.pixel)
            pairs = pairs[~np.isfinite(distance)]
        answered += int(candidate.sum()) - len(pairs.start)
        jumped, at = _jumps(depths, pairs, jump, accuracy)
        sharp, at_crease = _creases(depths, pairs[~jumped], jump, accuracy)
        absent.append(np.concatenate([at[jumped], at_crease[sharp]]))
    places = np.concatenate(absent)
    return Missing(answered + len(places), places, runs(absent, sheet), sheet.pixel)


def edge_between(depths: Depths, start: Floats, end: Floats, accuracy: float) -> npt.NDArray[np.bool_]:
    """Whether the surface breaks off or is sharp between points (n, 2) on paper and others near them."""
    pairs, jump = Pairs(start, end, depths.at(start), depths.at(end)), CONTACT * accuracy
    return np.asarray(_jumps(depths, pairs, jump, accuracy)[0] | _creases(depths, pairs, jump, accuracy)[0])


@dataclass(frozen=True)
class Pairs:
    """Pairs of points (n, 2) on paper, and the hits of the depth image there."""

    start: Floats
    end: Floats
    a: Hits
    b: Hits

    @property
    def middle(self) -> Floats:
        return (self.start + self.end) / 2

    def __getitem__(self, index: npt.NDArray[np.bool_]) -> Pairs:
        return Pairs(self.start[index], self.end[index], self.a[index], self.b[index])


def _jumps(depths: Depths, pairs: Pairs, jump: float, accuracy: float) -> tuple[npt.NDArray[np.bool_], Floats]:
    """Between which pairs the depth jumps, and where."""
    pairs = _halved(depths, pairs, lambda a, b, c: _gap(a, b) >= _gap(b, c))
    both = np.linalg.norm([pairs.a.slope, pairs.b.slope], axis=2).min(axis=0)
    deep = jump + CONTACT * accuracy * both
    wide = _wide(depths, pairs, accuracy, lambda hits, other, way: _off_plane(hits, other, way) > deep[:, None])
    return (_gap(pairs.a, pairs.b) > deep) & wide, pairs.middle


def _creases(depths: Depths, pairs: Pairs, jump: float, accuracy: float) -> tuple[npt.NDArray[np.bool_], Floats]:
    """Between which pairs the surface is sharp, and where."""
    pairs = _halved(depths, pairs, lambda a, b, c: _turn(a, b) <= _turn(b, c))
    wide = _wide(depths, pairs, accuracy, lambda hits, other, _: _turn(hits, other) < SHARP)
    return (_turn(pairs.a, pairs.b) < SHARP) & (_gap(pairs.a, pairs.b) <= jump) & wide, pairs.middle


def _halved(depths: Depths, pairs: Pairs, first: Callable[[Hits, Hits, Hits], npt.NDArray[np.bool_]]) -> Pairs:
    """Halve the pairs repeatedly; of three hits in a row, `first` tells whether the change is in the first half."""
    start, end, a, b = pairs.start, pairs.end, pairs.a, pairs.b
    for _ in range(HALVINGS):
        middle = (start + end) / 2
        m = depths.at(middle)
        former = first(a, m, b)
        start, end = np.where(former[:, None], start, middle), np.where(former[:, None], middle, end)
        a, b = a.where(former, m), m.where(former, b)
    return Pairs(start, end, a, b)


def _wide(
    depths: Depths, pairs: Pairs, accuracy: float, apart: Callable[[Hits, Hits, Floats], npt.NDArray[np.bool_]]
) -> npt.NDArray[np.bool_]:
    """Where both sides fill a part of a ring around the place, unlike the sides of a crack or a splinter."""
    angles = np.arange(RING) * (2 * np.pi / RING)
    ring = WIDE * accuracy * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    around = depths.at(pairs.middle[:, None] + ring)
    return np.logical_and(*(apart(hits[:, None], around, ring).sum(axis=1) >= SECTOR for hits in (pairs.a, pairs.b)))


def _gap(a: Hits, b: Hits) -> Floats:
    """Difference of depth; inf where only one of the two rays hit anything."""
    with np.errstate(invalid="ignore"):
        return np.where(a.met & b.met, np.abs(a.depth - b.depth), np.where(a.met == b.met, 0.0, np.inf))


def _off_plane(a: Hits, b: Hits, way: Floats) -> Floats:
    """Difference of depth, less the difference that the tangent planes of both hits explain."""
    with np.errstate(invalid="ignore"):
        rise = b.depth - a.depth
        apart = [np.abs(rise - dots(hits.slope, way)) for hits in (a, b)]
        return np.where(a.met & b.met, np.maximum(*apart), np.where(a.met == b.met, 0.0, np.inf))


def _turn(a: Hits, b: Hits) -> Floats:
    """Cosine between normals; 1 where either ray hit nothing."""
    return np.where(a.met & b.met, dots(a.normal, b.normal), 1.0)


def runs(crossings: Sequence[Floats], sheet: Sheet) -> list[Run]:
    """Join places within `REACH` pixels of one another into runs, longest first.

    crossings: places on the rows and on the columns of the sheet's grid; both are needed for a straight run's length.
    """
    places = np.concatenate(crossings)
    if not len(places):
        return []
    family = np.repeat([0, 1], [len(each) for each in crossings])
    marks: npt.NDArray[np.bool_] = np.zeros((sheet.rows // REACH + 2, sheet.columns // REACH + 2), dtype=np.bool_)
    row, column = (sheet.index(places) // REACH).T
    marks[row, column] = True
    numbers, count = label(marks, structure=np.ones((3, 3)))
    of = numbers[row, column]
    found = []
    for number in range(1, count + 1):
        own = places[of == number]
        x, y = own[np.argmin(((own - own.mean(axis=0)) ** 2).sum(axis=1))].tolist()
        length = float(np.hypot(*np.bincount(family[of == number], minlength=2)))
        found.append(Run(length * sheet.pixel, (x, y)))
    return sorted(found, key=lambda run: -run.length)
