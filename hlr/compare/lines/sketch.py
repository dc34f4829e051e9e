"""Lines as a file or a drawing has them, straight or curved, collected and then made into straight pieces."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from hlr.compare.lines.pieces import Floats, Index, Pieces, with_ways
from hlr.drawing.chords import numbered
from hlr.errors import SourceError
from hlr.request.options import Vector

CHORD_SHARE = 0.05
"""Share of the tolerance by which a chord may lie off its curve."""

MOST_PIECES = 5_000_000
"""Of one drawing; takes half a gigabyte."""

FARTHEST_MM = 1e6
"""Largest coordinate on paper."""

Pair = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Trait:
    """What is known of a line: number of its class, 1 visible or 0 hidden, part, edge and view; -1 where unknown."""

    kind: int
    visible: int
    part: int = -1
    edge: int = -1
    view: int = -1


@dataclass(frozen=True, slots=True)
class StatedView:
    """The view of a model that a drawing states, in the coordinates of the model.

    direction   from the object toward the viewer
    eye, target  in perspective
    section     a point on the plane by which the model was cut; None: it was not
    corners     where that plane steps: of each step a point on the edge of the plane before it, and of that behind it
    window      the rectangle on paper at which the lines were cut: lower left and upper right corner, mm; None: none
    """

    name: str
    direction: Vector
    up: Vector
    eye: Vector | None = None
    target: Vector | None = None
    section: Vector | None = None
    corners: tuple[Vector, ...] = ()
    window: tuple[float, float, float, float] | None = None


@dataclass(frozen=True, slots=True)
class PlacedView:
    """A view of a page as the page states it. name, scale, origin, letter: as of `hlr.drawing.sheet.SheetView`"""

    name: str
    view: StatedView
    scale: float
    origin: tuple[float, float]
    letter: str


@dataclass(frozen=True, slots=True)
class StatedPage:
    """A page by a method of projection. size: width and height, millimetres; None: not known"""

    method: str
    size: tuple[float, float] | None
    views: tuple[PlacedView, ...]


@dataclass(frozen=True, slots=True)
class About:
    """What is known of a drawing besides its lines.

    parts     names
    scale     paper to model; None: unknown
    views     names of the views of a page; empty: one view
    foreign   whether another program drew it
    left_out  what of the file is no line of the drawing, counted
    stated    the view that it states; None: it states none
    page      of a page by a method of projection: how its views show the model; None: it does not state that
    several   how many views a page has whose lines do not tell theirs; 0: it is none, or does not say
    view_found  the view of a model, where it was not said: as the other side shows it, of two models the usual one
    """

    parts: tuple[str, ...]
    scale: float | None = None
    views: tuple[str, ...] = ()
    foreign: bool = False
    left_out: dict[str, int] = field(default_factory=dict)
    stated: StatedView | None = None
    page: StatedPage | None = None
    several: int = 0
    view_found: str | None = None


class Sketch:
    """Lines that are being read. `begin` begins one; what is added then belongs to it, in this order."""

    def __init__(self) -> None:
        self._traits: list[tuple[int, int, int, int, int]] = []
        self._owner: list[int] = []  # of each stroke: its line
        self._straight: list[tuple[int, Floats]] = []
        self._cubic: list[tuple[int, tuple[float, ...]]] = []
        self._arc: list[tuple[int, tuple[float, ...]]] = []

    def __len__(self) -> int:
        return len(self._traits)

    def begin(self, trait: Trait) -> None:
        """A new line."""
        self._traits.append((trait.kind, trait.visible, trait.part, trait.edge, trait.view))

    def polyline(self, points: Floats | list[Pair]) -> None:
        """Points (n, 2) on the line."""
        self._straight.append((self._stroke(), np.asarray(points, np.float64)))

    def cubic(self, a: Pair, b: Pair, c: Pair, d: Pair) -> None:
        """A cubic Bezier curve."""
        self._cubic.append((self._stroke(), (*a, *b, *c, *d)))

    def arc(self, centre: Pair, axes: tuple[Pair, Pair], angles: Pair) -> None:
        """An arc as of `hlr.drawing.curve.Arc`."""
        self._arc.append((self._stroke(), (*centre, *axes[0], *axes[1], *angles)))

    def pieces(self, tolerance_mm: float, name: str) -> Pieces:
        """All lines in straight pieces; name: of the file, for errors.

        Raises SourceError where a number is not finite or too large, or there would be too many pieces.
        """
        stroke, rows = self._chords(tolerance_mm * CHORD_SHARE, name)
        order = np.argsort(stroke, kind="stable")
        rows, stroke = rows[order], stroke[order]
        long = (rows[:, :2] != rows[:, 2:]).any(axis=1)
        rows, stroke = rows[long], stroke[long]
        line = np.array(self._owner, np.int64)[stroke]
        traits = np.array(self._traits, np.int64).reshape(-1, 5)[line]
        curved = np.ones(len(self._owner), np.int64)
        curved[[number for number, _ in self._straight]] = 0
        zero = np.zeros((len(line), 2))
        rows = rows + 0.0  # no negative zeros: the same points have the same bits
        columns = (*traits.T, curved[stroke])
        return with_ways(Pieces(rows[:, :2], rows[:, 2:], zero, line, *columns), tolerance_mm)

    def _stroke(self) -> int:
        self._owner.append(len(self._traits) - 1)
        return len(self._owner) - 1

    def _chords(self, off: float, name: str) -> tuple[Index, Floats]:
        """(n,) the stroke of each chord, and (n, 4) its ends."""
        points = [each for _, each in self._straight]
        cubics = np.array([each for _, each in self._cubic], np.float64).reshape(-1, 4, 2)
        arcs = np.array([each for _, each in self._arc], np.float64).reshape(-1, 8)
        numbers = [each.ravel() for each in points]
        _check(np.concatenate([np.zeros(1), *numbers, cubics.ravel(), arcs[:, :6].ravel()]), arcs[:, 6:], name)
        bend = np.abs(np.diff(cubics, n=2, axis=1)).max(axis=(1, 2), initial=0.0) * (6.0 * math.sqrt(2.0))
        radius = np.hypot(arcs[:, 2:6:2], arcs[:, 3:6:2]).max(axis=1, initial=0.0)
        turn = np.abs(arcs[:, 7] - arcs[:, 6])
        of_cubics = np.maximum(np.ceil(np.sqrt(bend / (8.0 * off))), 1.0).astype(np.int64)
        of_arcs = np.maximum(np.ceil(turn * np.sqrt(radius / (8.0 * off))), 1.0).astype(np.int64)
        total = sum(map(len, points)) + int(of_cubics.sum()) + int(of_arcs.sum())
        if total > MOST_PIECES:
            raise SourceError(
                f"{name} has {total:,} pieces of lines, more than {MOST_PIECES:,}: give a larger tolerance"
            )
        found = [
            (np.repeat(stroke, max(len(each) - 1, 0)), np.concatenate([each[:-1], each[1:]], axis=1))
            for (stroke, _), each in zip(self._straight, points, strict=True)
        ]
        found.append(_of_cubics(np.array([stroke for stroke, _ in self._cubic], np.int64), cubics, of_cubics))
        found.append(_of_arcs(np.array([stroke for stroke, _ in self._arc], np.int64), arcs, of_arcs))
        return np.concatenate([each for each, _ in found]), np.concatenate([each for _, each in found])


def _check(numbers: Floats, angles: Floats, name: str) -> None:
    if not np.isfinite(numbers).all() or not np.isfinite(angles).all() or np.abs(numbers).max() > FARTHEST_MM:
        raise SourceError(f"{name} has a point that is not finite, or a kilometre away: draw the model again")
    if (np.abs(angles) > 100.0).any():
        raise SourceError(f"{name} has an arc of many turns: draw the model again")


def _of_cubics(stroke: Index, cubics: Floats, count: Index) -> tuple[Index, Floats]:
    whose, number = numbered(count)

    def at(step: Index) -> Floats:
        t = (step / count[whose])[:, None]
        a, b, c, d = (cubics[whose, k] for k in range(4))
        s = 1.0 - t
        exact = s * s * s * a + 3.0 * s * t * (s * b + t * c) + t * t * t * d
        return np.asarray(np.where(t == 0.0, a, np.where(t == 1.0, d, exact)))

    return stroke[whose], np.concatenate([at(number), at(number + 1)], axis=1)


def _of_arcs(stroke: Index, arcs: Floats, count: Index) -> tuple[Index, Floats]:
    whose, number = numbered(count)

    def at(step: Index) -> Floats:
        first, last = arcs[whose, 6], arcs[whose, 7]
        t = (first + (last - first) * (step / count[whose]))[:, None]
        found: Floats = arcs[whose, 0:2] + np.cos(t) * arcs[whose, 2:4] + np.sin(t) * arcs[whose, 4:6]
        return found

    return stroke[whose], np.concatenate([at(number), at(number + 1)], axis=1)
