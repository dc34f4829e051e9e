"""The areas of Warnock's subdivision: as records of a trace, and as a table."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from hlr.common.types import Ints

ENDINGS = ("a", "b", "c", "d", "pixel", "quartered")
"""The ways in which an area is decided.

a          all polygons are disjoint
b          one polygon is left, which intersects it or is contained in it
c          one surrounding polygon is left
d          a surrounding polygon in front of all others
pixel      it is a single pixel, decided at its centre
quartered  none of these: its quarters follow
"""


@dataclass(frozen=True, slots=True)
class Area:
    """An area of pixels that Warnock's subdivision examined.

    columns, rows  end exclusive
    level          how many times the screen was quartered to reach it
    polygons       how many of the polygons read are not disjoint from it
    passed_over    how many at the end of the sorted list were not read: a surrounding polygon is in front of them all
    ending         how it was decided: one of ENDINGS
    id             the polygon seen in it, or in part of it; -1: none, or it was quartered
    """

    columns: tuple[int, int]
    rows: tuple[int, int]
    level: int
    polygons: int
    passed_over: int
    ending: str
    id: int


def areas_of(found: Ints) -> tuple[Area, ...]:
    """Make areas from the kernel's (n, 9) integers."""
    return tuple(
        Area((x0, x1), (y0, y1), level, polygons, passed, ENDINGS[ending], seen)
        for x0, x1, y0, y1, level, polygons, passed, ending, seen in found.tolist()
    )


def areas_table(areas: Sequence[Area]) -> str:
    """The areas as a Markdown table, one row each, indented by level."""
    lines = ["| columns | rows | polygons | passed over | ending | seen |", "| --- | --- | ---: | ---: | --- | ---: |"]
    for a in areas:
        columns, rows = (f"{low}-{high - 1}" for low, high in (a.columns, a.rows))
        seen = "" if a.id < 0 else str(a.id)
        indent = "&nbsp;&nbsp;" * a.level
        lines.append(f"| {indent}{columns} | {rows} | {a.polygons} | {a.passed_over} | {a.ending} | {seen} |")
    return "\n".join(lines) + "\n"
