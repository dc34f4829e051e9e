"""A comparison as tables of text."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from hlr.common.columns import columns, left
from hlr.common.printable import printable
from hlr.compare.comparison import Comparison
from hlr.compare.difference import KINDS, Difference
from hlr.compare.overlay.cells import cells_of, left_out_lines, view_cells, words_of

_VIEW_HEADINGS = ("view", "same mm", "moved by x, y", "differs")
_HEADINGS = ("difference", "mm", "at x, y", "class", "part", "who is right")


def rows(found: Comparison, most: int) -> list[str]:
    """The longest differences of each kind first, at most so many, and how many there are besides.

    What is drawn twice cannot be seen: the summary has its length, JSON and the web page have all of it. A hatch that
    is gone or new has one row for each part.
    """
    shown = _hatches_gathered([each for each in found.differences if each.kind != "doubled"])
    if not shown:
        return []
    words = words_of(found.foreign)
    cells = [cells_of(each, words, count) for each, count in shown[:most]]
    columns = len(_HEADINGS) if any(row[-1] for row in cells) else len(_HEADINGS) - 1
    lines = _aligned([row[:columns] for row in (_HEADINGS, *cells)])
    more = len(shown) - most
    return ["", *lines, *([f"and {more} more; -o FILE.json or FILE.html has all of them"] if more > 0 else []), ""]


def _hatches_gathered(differences: Sequence[Difference]) -> list[tuple[Difference, int]]:
    """Differences and how many lines each stands for: those of a part's hatch are one, at the place of its longest."""
    rows: dict[object, list[Difference]] = {}
    for k, each in enumerate(differences):
        hatch = each.line_class == "hatch" and each.kind in ("gone", "new")
        rows.setdefault((each.kind, each.view, each.part, each.visible) if hatch else k, []).append(each)
    gathered = [(replace(row[0], length_mm=sum(each.length_mm for each in row)), len(row)) for row in rows.values()]
    return sorted(gathered, key=lambda row: (KINDS.index(row[0].kind), -row[0].length_mm))


def view_rows(found: Comparison) -> list[str]:
    """The views of two pages, a line of text for each; none where they were compared as a whole."""
    words = words_of(found.foreign)
    return ["", *_aligned([_VIEW_HEADINGS, *(view_cells(view, words) for view in found.views)])] if found.views else []


def left_out(found: Comparison) -> list[str]:
    """What each side has besides its lines, a line of text for each."""
    return left_out_lines((found.before, found.after), found.left_out)


def _aligned(cells: list[tuple[str, ...]]) -> list[str]:
    """Rows of a table, the last column as wide as it is."""
    cells = [tuple(map(printable, row)) for row in cells]
    widths = [max(columns(row[column]) for row in cells) for column in range(len(cells[0]) - 1)]
    return ["  ".join([*(left(c, w) for c, w in zip(row, widths, strict=False)), row[-1]]).rstrip() for row in cells]
