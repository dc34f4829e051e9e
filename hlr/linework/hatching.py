"""Hatches of cut faces (ISO 128): parallel thin lines on paper, other ones in each of the parts that touch.

Lines are at 45 degrees to the right or to the left, and closer together in small faces. Parts that touch one another
get another direction, or another spacing; all faces of one part have the same lines, which lie still on paper.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from hlr.common.types import Floats
from hlr.drawing.hatch_pattern import Row
from hlr.linework.hatch_strokes import inside, strokes_within

SPACINGS = (0.7, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0)
"""Millimetres from line to line."""

LINES_A_SIDE = 8.0
"""In a square face there are about so many spacings to a side, as far as SPACINGS and the paper allow."""

LEAST_A_SIDE = 3.0
"""The same in the smallest section of a part, as far as SPACINGS allow: the hatch is that of its largest one."""

PAPER_SHARE = 70.0
"""The shorter side of the paper over this is the widest spacing."""

CANDIDATES = (
    *((angle, steps) for steps in (0, -1, -2, 2) for angle in (45.0, 135.0)),
    *((angle, steps) for steps in (0, -2, 2) for angle in (30.0, 120.0, 60.0, 150.0)),
    *((angle, steps) for steps in (4, -4) for angle in (45.0, 135.0, 30.0, 120.0, 60.0, 150.0)),
)
"""Degrees, and by how many steps of SPACINGS the usual spacing is changed, the better ones first.

At the end of SPACINGS some of them are equal. At least 18 others are left, wherever the usual spacing is.
"""

APART = 1.4
"""Hatches of one direction differ where their spacings do by this factor."""

TOUCH = 0.5
"""Millimetres: parts with less between them touch, as far as one can see."""

MOST_ACROSS = 2000
"""Lines across one part; in huge drawings they lie further apart."""

DIGITS = 4
"""Of an area. The others come from rounding, and from the chords of another mesh of the same face."""

SPARE = 1.0 + 1e-9
"""Times: what rounding adds at most to a length that is compared with a limit, as of a face of 8 x 8 mm."""

PAIRS = 1_000_000
"""Corners times sides that are compared at a time."""

MOST_COMPARED = 50_000_000
"""Parts with more corners times sides count as touching where their boxes do."""


@dataclass(frozen=True, slots=True)
class Pattern:
    """The lines of one part. angle: degrees counter-clockwise from the right; spacing: mm from line to line."""

    angle: float
    spacing: float

    def row(self) -> Row:
        """The lines. The first lies half a spacing from the origin, so that none runs through a corner there."""
        turn = math.radians(self.angle)
        along = np.array([math.cos(turn), math.sin(turn)])
        across = self.spacing * np.array([-along[1], along[0]])
        return Row(0.5 * across, along, across, ())

    def meets(self, corners: Floats) -> bool:
        """Whether a face with these corners (n, 2) is so wide across the lines that one meets it."""
        return float(np.ptp(corners @ self.row().offset)) >= self.spacing**2

    def like(self, other: Pattern) -> bool:
        """Whether one can hardly tell it from another."""
        wide, narrow = max(self.spacing, other.spacing), min(self.spacing, other.spacing)
        return self.angle == other.angle and wide < APART * narrow


def patterns_on_sheet(sections: Sequence[Mapping[str, Sequence[Floats]]], paper: float) -> dict[str, Pattern]:
    """The pattern of each part, the same in all sections of a sheet. Parts that touch in one of them differ.

    sections: by part, the loops (k, 2) of its cut faces, millimetres on paper, holes the other way round
    paper: the shorter side
    """
    areas: dict[str, list[float]] = {}
    across: dict[str, float] = {}
    for parts in sections:
        for name, loops in parts.items():
            low, high = _box(loops)
            areas.setdefault(name, []).append(_rounded(abs(sum(map(_area, loops)))))
            across[name] = max(float(np.hypot(*(high - low))), across.get(name, 0.0))
    # The large faces come first: they have the usual lines.
    order = sorted(areas, key=lambda name: (-max(areas[name]), name))
    touching: dict[str, set[str]] = {name: set() for name in order}
    for parts in sections:
        for name, other in _touching(parts, [name for name in order if name in parts]):
            touching[name].add(other)
    found: dict[str, Pattern] = {}
    for name in order:
        near = [found[other] for other in found if other in touching[name]]
        least = across[name] / MOST_ACROSS
        usual = _usual(areas[name], paper)
        choices = [Pattern(angle, max(_stepped(usual, steps), least)) for angle, steps in CANDIDATES]
        usuals = choices[:2]
        # Lines that may miss a small face are not for it, or it would look as if it were not cut.
        faces = [np.concatenate(list(parts[name])) for parts in sections if name in parts]
        choices = [own for own in choices if all(map(own.meets, faces))] or choices
        # Best is another direction; where neighbours have both, another spacing.
        turned = [own for own in usuals if all(own.angle != other.angle for other in near)]
        apart = [own for own in choices if not any(map(own.like, near))]
        # Where there are more neighbours than patterns, it is like as few of them as can be.
        fewest = min(choices, key=lambda own: sum(map(own.like, near)))
        found[name] = next(iter((*turned, *apart)), fewest)
    return found


def hatched(loops: Sequence[Floats], pattern: Pattern, shortest: float) -> Floats:
    """The lines (n, 2, 2) of a pattern inside a face; loops (k, 2): its border, mm; shortest: of a line, mm."""
    sides = sides_of(loops)
    low, high = _box(loops)
    strokes = strokes_within((pattern.row(),), low, high)
    if strokes is None:
        return np.zeros((0, 2, 2))
    lines = inside(strokes, sides, winding=True)
    return np.asarray(lines[np.hypot(*(lines[:, 1] - lines[:, 0]).T) >= shortest])


def _usual(areas: Sequence[float], paper: float) -> int:
    """Which of SPACINGS the lines of a part have whose faces are as large as this in each section."""
    wished = min(math.sqrt(max(areas)) / LINES_A_SIDE, math.sqrt(min(areas)) / LEAST_A_SIDE, paper / PAPER_SHARE)
    return max(sum(spacing <= wished * SPARE for spacing in SPACINGS) - 1, 0)


def _rounded(area: float) -> float:
    """An area to DIGITS digits: those of equal faces are one number, wherever the faces lie."""
    return float(f"{area:.{DIGITS}g}")


def _stepped(usual: int, steps: int) -> float:
    return SPACINGS[min(max(usual + steps, 0), len(SPACINGS) - 1)]


def _area(loop: Floats) -> float:
    x, y = (loop - loop[0]).T
    return 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))


def _box(loops: Sequence[Floats]) -> tuple[Floats, Floats]:
    points = np.concatenate(list(loops))
    return points.min(axis=0), points.max(axis=0)


def sides_of(loops: Sequence[Floats]) -> Floats:
    """(n, 2, 2) the sides of all loops."""
    return np.concatenate([np.stack([loop, np.roll(loop, -1, axis=0)], axis=1) for loop in loops])


def _touching(parts: Mapping[str, Sequence[Floats]], order: Sequence[str]) -> Iterator[tuple[str, str]]:
    """Parts of one section that touch, each with one before it in the order."""
    boxes = np.array([_box(parts[name]) for name in order]).reshape(-1, 2, 2)
    sides = [sides_of(parts[name]) for name in order]
    for k, name in enumerate(order):
        for other in _meeting(boxes, k):
            if _touch(boxes[k], boxes[other], sides[k], sides[other]):
                yield name, order[other]


def _meeting(boxes: Floats, number: int) -> list[int]:
    """Those of the parts before this one whose boxes (n, 2, 2) meet its own."""
    own, others = boxes[number], boxes[:number]
    meet = ((others[:, 0] - TOUCH <= own[1]) & (others[:, 1] + TOUCH >= own[0])).all(axis=1)
    found: list[int] = np.flatnonzero(meet).tolist()
    return found


def _touch(one: Floats, other: Floats, a: Floats, b: Floats) -> bool:
    """Whether two parts touch, or pass through one another, whose boxes (2, 2) meet. a, b: their sides."""
    low, high = np.maximum(one[0], other[0]) - TOUCH, np.minimum(one[1], other[1]) + TOUCH
    of_a, of_b = (_reaching(sides, low, high) for sides in (a, b))
    if max(2 * len(of_a) * len(of_b), len(of_a) * len(b) + len(of_b) * len(a)) > MOST_COMPARED:
        return True
    if any(_near(of_a[:, 0], of_b)) or any(_near(of_b[:, 0], of_a)):
        return True
    return any(len(inside(sides, others, winding=True)) for sides, others in ((of_a, b), (of_b, a)))


def _reaching(sides: Floats, low: Floats, high: Floats) -> Floats:
    """Those of the sides that may reach into a box."""
    return np.asarray(sides[((sides.min(axis=1) <= high) & (sides.max(axis=1) >= low)).all(axis=1)])


def _near(points: Floats, sides: Floats) -> Iterator[bool]:
    """Whether any of some points (n, 2) lies on sides (m, 2, 2), or nearly; a few points at a time."""
    if not len(sides):
        return
    start, way = sides[:, 0], sides[:, 1] - sides[:, 0]
    length = np.maximum((way * way).sum(axis=1), 1e-300)
    few = max(1, PAIRS // len(sides))
    for k in range(0, len(points), few):
        away = points[k : k + few, None] - start
        along = np.clip((away * way).sum(axis=2) / length, 0.0, 1.0)
        yield bool((((away - along[..., None] * way) ** 2).sum(axis=2) <= (SPARE * TOUCH) ** 2).any())
