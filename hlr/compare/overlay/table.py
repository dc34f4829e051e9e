"""The differences of a comparison as a table of text."""

from __future__ import annotations

from hlr.compare.compared_view import ComparedView
from hlr.compare.comparison import Comparison
from hlr.compare.difference import UNKNOWN, WORDS_OF_TWO_PROGRAMS, Difference, told

_VIEW_HEADINGS = ("view", "same mm", "moved by x, y", "differs")
_HEADINGS = ("difference", "mm", "at x, y", "class", "part")


def rows(found: Comparison, most: int) -> list[str]:
    """The longest differences of each kind first, at most so many, and how many there are besides."""
    if not found.differences:
        return []
    words = WORDS_OF_TWO_PROGRAMS if found.foreign else {}
    lines = _aligned([_HEADINGS, *(_row(each, words) for each in found.differences[:most])])
    more = len(found.differences) - most
    return ["", *lines, *([f"and {more} more"] if more > 0 else []), ""]


_WHAT = {
    "moved": "moved by {} mm",
    "polyline": "straight pieces, off by {} mm",
}


def _row(each: Difference, words: dict[str, str]) -> tuple[str, ...]:
    what = _WHAT.get(each.kind, words.get(each.kind, each.kind)).format(told(each.moved_mm))
    seen = {True: "visible", False: "hidden", None: ""}[each.visible]
    line = " ".join(word for word in (seen, "" if each.line_class == UNKNOWN else each.line_class) if word) or UNKNOWN
    became = f", now {each.became}" if each.became else ""
    name = "".join(c if c.isprintable() else "?" for c in each.part or "")
    edge = "" if each.edge is None else f", edge {each.edge}"
    view = f"{each.view} " if each.view else ""
    x, y = (f"{value:.2f}" for value in each.place)
    return what, told(each.length_mm), f"{x}, {y}", line + became, f"{view}{name}{edge}"


def view_rows(found: Comparison) -> list[str]:
    """The views of two pages, a line of text for each; none where they were compared as a whole."""
    if not found.views:
        return []
    words = WORDS_OF_TWO_PROGRAMS if found.foreign else {}
    return ["", *_aligned([_VIEW_HEADINGS, *(_view_row(view, words) for view in found.views)])]


def _view_row(view: ComparedView, words: dict[str, str]) -> tuple[str, ...]:
    moved = "" if view.shift is None else ", ".join(f"{value:.3f}" for value in view.shift)
    if view.before != view.after:
        return view.name, "0", moved, f"on the {'first' if view.before else 'second'} page only"
    found = [f"{told(length)} mm {words.get(kind, kind)}" for kind, length in view.mm.items() if length > 0.0]
    found = ["lies elsewhere on the page"] * view.displaced + found
    return view.name, told(view.same_mm), moved, ", ".join(found) or "nothing"


def _aligned(cells: list[tuple[str, ...]]) -> list[str]:
    """Rows of a table, the last column as wide as it is."""
    widths = [max(len(row[column]) for row in cells) for column in range(len(cells[0]) - 1)]
    return ["  ".join([*(c.ljust(w) for c, w in zip(row, widths, strict=False)), row[-1]]).rstrip() for row in cells]


def left_out(found: Comparison) -> list[str]:
    """What each side has besides its lines, a line of text for each."""
    sides = zip((found.before, found.after), found.left_out, strict=True)
    return [
        f"{title}: not compared: {', '.join(f'{word} ({count})' for word, count in words.items())}"
        for title, words in sides
        if words
    ]
