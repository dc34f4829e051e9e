"""Which view of one page is which of another: by their names, or else by where they lie.

Several sections of one view are told apart by their lines: what each is called depends on how many there are.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from hlr.compare.lines.pieces import Floats, Pieces
from hlr.compare.matching.sections import base_of, likeness, paired_sections, sections_of
from hlr.compare.reading.sides import Side

_NEAR = 0.5
"""Of a view's diagonal: how far apart the middles of two views may lie that have no name in common."""

_AROUND_MM = 5.0
"""A line that lies farther from all views belongs to none."""

BESIDE = "beside the views"
"""In place of a view's name: lines that belong to none."""


@dataclass(frozen=True, slots=True)
class Pair:
    """A view of two pages; before, after: its number on each, None where a page has none such, -1 for `BESIDE`."""

    name: str
    before: int | None
    after: int | None


def with_views_of(side: Side, other: Side) -> Side:
    """A side that knows no views, with its lines given to those of the other side that they lie in."""
    if side.about.views or not len(side.pieces):
        return side
    boxes = np.array([_box(other.pieces, number) for number in range(len(other.about.views))])
    number = side.pieces.number_of_line
    first = np.flatnonzero(np.diff(number, prepend=-1))
    low = np.minimum.reduceat(np.minimum(side.pieces.start, side.pieces.end), first)
    high = np.maximum.reduceat(np.maximum(side.pieces.start, side.pieces.end), first)
    middle = 0.5 * (low + high)[:, None]
    off = np.hypot(*np.moveaxis(np.maximum(np.maximum(boxes[:, 0] - middle, middle - boxes[:, 1]), 0.0), 2, 0))
    size = np.hypot(*(boxes[:, 1] - boxes[:, 0]).T)
    near = np.lexsort((np.broadcast_to(size, off.shape), off), axis=1)[:, 0]
    near[off[np.arange(len(near)), near] > _AROUND_MM] = -1
    about = replace(side.about, views=other.about.views)
    return replace(side, pieces=replace(side.pieces, view=near[number]), about=about)


def _with_stated_view(side: Side, other: Side, tolerance_mm: float) -> Side:
    """A drawing of one view that it states, as the view of that name where the other side is a page that has it.

    Where that has several sections of the view, it is the one that the drawing is most like.
    """
    stated = side.about.stated
    views = other.about.views
    if side.about.views or stated is None:
        return side
    name, lines = stated.name, other.pieces
    sections = [name] if name in views else []
    if len(numbers := sections_of(base_of(name), views)) > 1:
        alike = {k: likeness(side.pieces, lines.take(lines.view == k), tolerance_mm) for k in numbers}
        sections = [views[max(numbers, key=lambda k: (alike[k], views[k] == name))]]
    if not sections:
        return side
    pieces = replace(side.pieces, view=np.zeros_like(side.pieces.view))
    return replace(side, pieces=pieces, about=replace(side.about, views=tuple(sections)))


def of_one_view(before: Side, after: Side, tolerance_mm: float) -> tuple[Side, Side]:
    """Both sides. Where one is a page and the other states that it is a view of it, the page keeps that view alone."""
    if after.about.views:
        one = _with_stated_view(before, after, tolerance_mm)
        return one, after if before.about.views else _with_view_alone(after, one)
    other = _with_stated_view(after, before, tolerance_mm)
    return _with_view_alone(before, other), other


def _with_view_alone(page: Side, one: Side) -> Side:
    """A page without its other views. one: the other side, a drawing of one view; without views it states none."""
    views = page.about.views
    if not one.about.views or len(views) < 2:
        return page
    name = one.about.views[0]
    pieces = page.pieces.take(page.pieces.view == views.index(name))
    about = replace(page.about, views=(name,), left_out={**page.about.left_out, "other views": len(views) - 1})
    return replace(page, pieces=replace(pieces, view=np.zeros_like(pieces.view)), about=about)


def pairs_of(before: Side, after: Side, tolerance_mm: float) -> list[Pair]:
    """Each view of either page once, in the order of the first page; then lines that belong to none."""
    one, other = before.about.views, after.about.views
    ours = other if before.about.foreign and not after.about.foreign else one
    sections = paired_sections((one, before.pieces), (other, after.pieces), tolerance_mm)
    by_name = {i: other.index(name) for i, name in enumerate(one) if name in other}
    if sections:
        bases = {base_of(one[i]) for i in sections}
        by_name = {i: j for i, j in by_name.items() if base_of(one[i]) not in bases} | sections
    found = by_name or _by_place(before, after)
    pairs = [
        Pair(_name(name if i not in found or ours is one else other[found[i]], i, sections, other), i, found.get(i))
        for i, name in enumerate(one)
    ]
    pairs += [Pair(name, None, j) for j, name in enumerate(other) if j not in found.values()]
    if (before.pieces.view < 0).any() or (after.pieces.view < 0).any():
        pairs.append(Pair(BESIDE, -1, -1))
    return pairs


def _name(name: str, i: int, sections: Mapping[int, int], other: Sequence[str]) -> str:
    """What a pair is called; sections of one view may have another name on each page."""
    return f"{name} / {other[sections[i]]}" if i in sections and other[sections[i]] != name else name


def view_of(side: Side, pair: Pair, number: int | None) -> Side:
    """The lines of one view of a side."""
    which = side.pieces.view == number if number is not None else np.zeros(len(side.pieces), bool)
    pieces = side.pieces.take(which)
    about = replace(side.about, views=(pair.name,))
    own = side.about.views[number] if number is not None and number >= 0 else ""
    pieces = replace(pieces, view=np.zeros_like(pieces.view))
    return replace(side, pieces=pieces, about=about, behind=side.behind_views.get(own))


def _by_place(before: Side, after: Side) -> dict[int, int]:
    """Views whose middles lie near one another, the nearest first."""
    one, other = ([_box(side.pieces, number) for number in range(len(side.about.views))] for side in (before, after))
    ranked = []
    for i, a in enumerate(one):
        for j, b in enumerate(other):
            apart = float(np.hypot(*(a.mean(axis=0) - b.mean(axis=0))))
            if apart < _NEAR * max(float(np.hypot(*(box[1] - box[0]))) for box in (a, b)):
                ranked.append((apart, i, j))
    found: dict[int, int] = {}
    for _, i, j in sorted(ranked):
        if i not in found and j not in found.values():
            found[i] = j
    return found


def _box(pieces: Pieces, view: int) -> Floats:
    """(2, 2) around the lines of a view; far away where it has none."""
    which = pieces.view == view
    if not which.any():
        return np.full((2, 2), -1e9)
    points = np.concatenate([pieces.start[which], pieces.end[which]])
    return np.stack([points.min(axis=0), points.max(axis=0)])
