"""What is told of a comparison, in the cells of a table."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from hlr.common.printable import printable
from hlr.compare.compared_view import ComparedView
from hlr.compare.difference import UNKNOWN, WORDS_OF_TWO_PROGRAMS, Difference, told


def words_of(foreign: bool) -> dict[str, str]:
    """Words for kinds that are not called by their name; foreign: one of the drawings is of another program."""
    return WORDS_OF_TWO_PROGRAMS if foreign else {}


_WHAT = {
    "moved": "moved by {} mm",
    "polyline": "straight pieces, off by {} mm",
}


def cells_of(each: Difference, words: dict[str, str], count: int = 1) -> tuple[str, ...]:
    """Difference, mm, place, class, part, who is right; the last one is empty where nothing was judged.

    count: the lines that it stands for
    """
    what = _WHAT.get(each.kind, words.get(each.kind, each.kind)).format(told(each.moved_mm))
    seen = {True: "visible", False: "hidden", None: ""}[each.visible]
    line = " ".join(word for word in (seen, "" if each.line_class == UNKNOWN else each.line_class) if word) or UNKNOWN
    became = f", now {each.became}" if each.became else f", {count} lines" if count > 1 else ""
    name = printable(each.part or "")
    edge = "" if each.edge is None else f", edge {each.edge}"
    # Parts of a page are called by their view already.
    view = f"{each.view} " if each.view and not (each.part or "").startswith(f"{each.view}/") else ""
    verdict = f"{each.verdict}: {each.reason}" if each.verdict else ""
    x, y = (f"{value:.2f}" for value in each.place)
    return what, told(each.length_mm), f"{x}, {y}", line + became, f"{view}{name}".rstrip() + edge, verdict


def view_cells(view: ComparedView, words: dict[str, str]) -> tuple[str, ...]:
    """Name, length that is the same, how it was moved, what differs."""
    moved = "" if view.shift is None else ", ".join(f"{round(value, 3) + 0.0:.3f}" for value in view.shift)
    if view.before != view.after:
        return view.name, "0", moved, f"on the {'first' if view.before else 'second'} page only"
    found = [f"{told(length)} mm {words.get(kind, kind)}" for kind, length in view.mm.items() if length > 0.0]
    found = ["lies elsewhere on the page"] * view.displaced + found
    return view.name, told(view.same_mm), moved, ", ".join(found) or "nothing"


def left_out_lines(titles: Sequence[str], left_out: Sequence[Mapping[str, int]]) -> list[str]:
    """What each side has besides its lines, a line of text for each."""
    return [
        f"{title}: not compared: {', '.join(f'{word} ({count})' for word, count in words.items())}"
        for title, words in zip(titles, left_out, strict=True)
        if words
    ]
