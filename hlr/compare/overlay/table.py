"""The differences of a comparison as a table of text."""

from __future__ import annotations

from hlr.compare.comparison import Comparison
from hlr.compare.difference import Difference, told

_HEADINGS = ("difference", "mm", "at x, y", "class", "part")


def rows(found: Comparison, most: int) -> list[str]:
    """The longest differences of each kind first, at most so many, and how many there are besides."""
    if not found.differences:
        return []
    cells = [_HEADINGS, *(_row(each) for each in found.differences[:most])]
    widths = [max(len(row[column]) for row in cells) for column in range(4)]
    lines = ["  ".join([*(c.ljust(w) for c, w in zip(row, widths, strict=False)), row[4]]).rstrip() for row in cells]
    more = len(found.differences) - most
    return ["", *lines, *([f"and {more} more"] if more > 0 else []), ""]


def _row(each: Difference) -> tuple[str, ...]:
    what = f"moved by {told(each.moved_mm)} mm" if each.kind == "moved" else each.kind
    line = f"{'visible' if each.visible else 'hidden'} {each.line_class}"
    became = f", now {each.became}" if each.became else ""
    name = "".join(c if c.isprintable() else "?" for c in each.part or "")
    edge = "" if each.edge is None else f", edge {each.edge}"
    x, y = (f"{value:.2f}" for value in each.place)
    return what, told(each.length_mm), f"{x}, {y}", line + became, f"{name}{edge}"
