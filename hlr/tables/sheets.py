"""Sheets of paper that a drawing may lie on, and the standard scales of drawings (ISO 5455)."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, lru_cache

MARGIN = 10.0
"""Millimetres that stay empty on each side of a sheet."""

SLACK = 0.1
"""Millimetres by which what is drawn at a standard scale, one view or several together, may be larger than the room
inside the margins: a part whose size is that room should fit, though its curves are drawn within an accuracy."""

LARGEST_SIDE = 1e7
"""Millimetres."""

STEPS = (1, 2, 5)
"""ISO 5455: standard scales are 1:1, and 1:N or N:1 where N is one of these times a power of ten."""


@dataclass(frozen=True, slots=True)
class Sheet:
    """A size of paper. narrow, wide: its sides, millimetres."""

    name: str
    narrow: float
    wide: float


SHEETS = {
    sheet.name.lower(): sheet
    for sheet in (
        Sheet("A0", 841.0, 1189.0),
        Sheet("A1", 594.0, 841.0),
        Sheet("A2", 420.0, 594.0),
        Sheet("A3", 297.0, 420.0),
        Sheet("A4", 210.0, 297.0),
        Sheet("A5", 148.0, 210.0),
        Sheet("A6", 105.0, 148.0),
        Sheet("letter", 215.9, 279.4),
        Sheet("legal", 215.9, 355.6),
        Sheet("tabloid", 279.4, 431.8),
    )
}
"""All sheets with a name, by that name in small letters."""

USUAL = "A4"
"""The sheet of a drawing for which no scale, no size and no page is asked."""


@dataclass(frozen=True, slots=True)
class Paper:
    """A sheet the way it lies. Millimetres."""

    name: str
    width: float
    height: float

    @property
    def room(self) -> tuple[float, float]:
        """Width and height inside the margins."""
        return self.width - 2.0 * MARGIN, self.height - 2.0 * MARGIN


def papers(page: str | Sequence[float]) -> tuple[Paper, ...]:
    """The ways a page may lie: both for the name of a sheet, landscape first; one where the page says which.

    page: "A3", "A3-landscape", "letter-portrait", "300x200" or (300, 200). Raises ValueError, with what is allowed.
    """
    return _named(page) if isinstance(page, str) else (_sized(page),)


@lru_cache(maxsize=32)
def _named(page: str) -> tuple[Paper, ...]:
    words = re.split(r"[\s_-]+", page.strip().lower())
    sheet = SHEETS.get(words[0])
    if sheet is None:
        sides = re.fullmatch(r"\s*(\d+\.?\d*)\s*[xX×]\s*(\d+\.?\d*)\s*", page)
        if sides is None:
            raise ValueError(f"no page is called {page!r}: use {_NAMES}, or a size such as 300x200")
        return (_sized((float(sides[1]), float(sides[2]))),)
    ways = {
        "landscape": Paper(sheet.name, sheet.wide, sheet.narrow),
        "portrait": Paper(sheet.name, sheet.narrow, sheet.wide),
    }
    match words[1:]:
        case []:
            return tuple(ways.values())
        case [way] if way in ways:
            return (ways[way],)
    raise ValueError(f"the page {page!r} lies neither landscape nor portrait: write {sheet.name}-landscape")


_NAMES = f"{', '.join(sheet.name for sheet in SHEETS.values())}, with -landscape or -portrait after it"


def _sized(sides: Sequence[float]) -> Paper:
    width, height = (float(side) for side in sides)
    name = f"{width:g}x{height:g}"
    if not (min(width, height) > 2.0 * MARGIN and max(width, height) <= LARGEST_SIDE):
        raise ValueError(
            f"a page of {name} mm cannot be drawn on: inside margins of {MARGIN:g} mm there has to be room, so give "
            f"sides of more than {2.0 * MARGIN:g} mm, and {LARGEST_SIDE:.0f} at most"
        )
    return Paper(name, width, height)


def standard_scale(most: float) -> float:
    """The largest standard scale that is no larger than `most`, a positive number."""
    scales = _standard_scales()
    return scales[max(0, bisect_right(scales, most) - 1)]


def standard_scale_from(least: float) -> float:
    """The smallest standard scale that is no smaller than `least`, a positive number."""
    return 1.0 / standard_scale(1.0 / least)


@cache
def _standard_scales() -> list[float]:
    """All that numbers of 64 bits can express, ascending."""
    larger = [float(step * 10**power) for power in range(308) for step in STEPS]
    return [*(1.0 / scale for scale in reversed(larger[1:])), *larger]
