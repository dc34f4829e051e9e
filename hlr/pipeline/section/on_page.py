"""The marks of sections among the views of one page: where each plane is seen from its edge, and what it is called."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from hlr.common.types import Floats
from hlr.drawing.drawing import Drawing
from hlr.drawing.lines import bounds_of
from hlr.drawing.notes import Note
from hlr.drawing.section_marks import ABOVE, BEYOND, EDGE_ON, FARTHER, TAIL, SectionMark, shapes_of
from hlr.drawing.view_marks import LETTER, Point

WIDE = 0.75
"""Of their size: how wide letters are."""

CLEAR = 1.0
"""Millimetres between the name of a section and the mark of another, and from arrow to arrow."""

FARTHEST_ENDS = 4
"""Times `FARTHER`: how far out cutting lines end that are close together, where the page has room for that."""

NAME = 3
"""Letters of the name of a section, A-A."""

SAME_PLACE = 1e-6
"""Millimetres: arrows that end so close to the next line do not lie over it."""

MOST_STEPS = 40
"""Millimetres by which a name may be moved to the side."""


class OnPage(Protocol):
    """A view at its place. shift (2,): from its own coordinates to those of the page, millimetres."""

    @property
    def drawing(self) -> Drawing:
        """The view."""

    @property
    def name(self) -> str:
        """What it is called."""

    @property
    def shift(self) -> Floats:
        """Millimetres."""


def section_marks(
    views: Sequence[OnPage], own: Sequence[bool], letters: Mapping[str, str], farthest: int = FARTHEST_ENDS
) -> tuple[dict[str, SectionMark], list[Note]]:
    """The mark of each section, by the name of its view, and what is said about them.

    own: of each view, whether it has its own place on the page, as those along the axes have
    letters: of the sections, by the names of their views, in the order of the marks
    farthest: as of `end_levels`
    """
    marks: dict[str, SectionMark] = {}
    notes = []
    named = {view.name: view for view in views}
    lines = _spread(cutting_lines(views, own), farthest)
    for name, letter in letters.items():
        line = lines.get(name)
        marks[name] = SectionMark(letter, _name_place(named[name]), *(() if line is None else (line.points, line.back)))
        if line is None:
            text = f"no view of the page sees the plane of section {letter}-{letter} from its edge: none marks it."
            notes.append(Note("section-not-marked", text))
    ink = np.concatenate([np.zeros((0, 2)), *(_ink(mark) for mark in marks.values())])
    return {name: replace(mark, name=_clear_of(ink, mark)) for name, mark in marks.items()}, notes


def are_clear(
    views: Sequence[OnPage],
    own: Sequence[bool],
    letters: Mapping[str, str],
    farthest: int,
    room: tuple[float, float, float, float],
) -> bool:
    """Whether the marks of all sections lie in a room, and not over the views that they do not cut, nor over names.

    room: its lower left and its upper right corner; all else is as of `section_marks`
    """
    marks, _ = section_marks(views, own, letters, farthest)
    bases = {name: line.base for name, line in cutting_lines(views, own).items()}
    half = np.array([0.5 * WIDE * LETTER * NAME + CLEAR, 0.5 * LETTER + CLEAR])
    names = [(np.array(mark.name) - half, np.array(mark.name) + half) for mark in marks.values()]
    for name, base in bases.items():
        ink = _ink(marks[name])
        if (ink < room[:2]).any() or (ink > room[2:]).any():
            return False
        boxes = [_box(view) for view in views if view.name != base]
        if any(((low < ink) & (ink < high)).all(axis=1).any() for low, high in [*boxes, *names]):
            return False
    return True


def _box(view: OnPage) -> tuple[Floats, Floats]:
    """The lower left and the upper right corner of a view and what is kept clear around it."""
    bounds = bounds_of(view.drawing.lines)
    low, high = np.array([bounds.x0, bounds.y0]), np.array([bounds.x1, bounds.y1])
    return low + view.shift - CLEAR, high + view.shift + CLEAR


@dataclass(frozen=True, slots=True)
class CuttingLine:
    """A section in the view that marks it, of this name. back: to the viewer of the section, of length 1."""

    base: str
    points: tuple[Point, ...]
    back: Point


def cutting_lines(views: Sequence[OnPage], own: Sequence[bool]) -> dict[str, CuttingLine]:
    """The cutting lines of sections, by the names of their views; none where no view sees the plane from its edge."""
    found = {}
    for view in views:
        base = None if view.drawing.section is None else _base_of(view, views, own)
        if base is not None:
            found[view.name] = CuttingLine(base.name, *_line(view, base))
    return found


def end_levels(lines: Mapping[str, CuttingLine], farthest: int = FARTHEST_ENDS) -> dict[str, tuple[int, int]]:
    """How far out both ends of cutting lines go, in steps of `FARTHER`, none farther than that many.

    Arrows of planes that look the same way and are close together would lie over one another: of two, the end of that
    which is farther from the viewer goes farther out, for its arrow then lies beyond the other. So would those of
    planes that look at each other: of two, the later one goes farther out.
    """
    levels: list[dict[str, int]] = []
    for end in (0, -1):
        places = {name: -float(np.dot(line.points[end], line.back)) for name, line in lines.items()}
        found: dict[str, int] = {}
        for name in sorted(lines, key=lambda name: places[name]):
            beside = [level for other, level in found.items() if _meet(lines[name], lines[other], end)]
            found[name] = min(max(beside, default=-1) + 1, farthest)
        levels.append(found)
    return {name: (levels[0][name], levels[1][name]) for name in lines}


def _meet(line: CuttingLine, other: CuttingLine, end: int) -> bool:
    """Whether arrows at an end of two lines would lie over one another. Of lines that look the same way, the other one
    is nearer to its viewer."""
    if line.base != other.base:
        return False
    back = np.array(line.back)
    same_way = float(back @ other.back)
    # Arrows reach from their lines to their viewers.
    behind = float((np.array(other.points[end]) - line.points[end]) @ back)
    if same_way > 1.0 - EDGE_ON:
        return behind < TAIL - SAME_PLACE
    return same_way < EDGE_ON - 1.0 and SAME_PLACE < behind < 2.0 * TAIL + CLEAR


def _spread(lines: Mapping[str, CuttingLine], farthest: int) -> dict[str, CuttingLine]:
    """The lines with their ends as far out as is needed."""
    spread = {}
    for name, levels in end_levels(lines, farthest).items():
        line = lines[name]
        along = _along(np.array(line.back))
        points = list(line.points)
        for end, sense, level in ((0, -1.0, levels[0]), (-1, 1.0, levels[1])):
            if level:
                points[end] = _pair(np.array(points[end]) + sense * level * FARTHER * along)
        spread[name] = replace(line, points=tuple(points))
    return spread


def _base_of(view: OnPage, views: Sequence[OnPage], own: Sequence[bool]) -> OnPage | None:
    """The view in which a section is marked: a whole one with a place of its own where there is one."""
    assert view.drawing.section is not None
    across = [np.array(view.drawing.section.normal)]
    if view.drawing.section.corners:
        across.append(np.array(view.drawing.view.right))
    edge_on = [
        (each.drawing.section is not None, not has_place, number)
        for number, (each, has_place) in enumerate(zip(views, own, strict=True))
        if each is not view and all(abs(float(way @ each.drawing.view.direction)) <= EDGE_ON for way in across)
    ]
    return views[min(edge_on)[2]] if edge_on else None


def _line(view: OnPage, base: OnPage) -> tuple[tuple[Point, ...], Point]:
    """The cutting line of a section in another view, and the direction to its viewer there."""
    section, drawing = view.drawing.section, base.drawing
    assert section is not None
    axes = np.array([drawing.view.right, drawing.view.up])
    normal, per_model = axes @ np.array(section.normal), drawing.scale * drawing.unit
    back = normal / float(np.hypot(*normal))
    along = _along(back)
    on_line = np.array([section.point, *section.corners])
    on_page = on_line @ axes.T * per_model - np.array(drawing.origin) + base.shift
    # The point lies before the first step.
    corners = on_page[1:] if section.corners else on_page
    corners = corners[:: -1 if (corners[0] - on_page[0]) @ along < 0.0 else 1]
    points = np.concatenate([line.points for line in drawing.lines]) + base.shift
    a, b = (
        corner + (float(end) - float(corner @ along)) * along
        for corner, end in (
            (corners[0], (points @ along).min() - BEYOND),
            (corners[-1], (points @ along).max() + BEYOND),
        )
    )
    return (_pair(a), *(_pair(corner) for corner in corners if section.corners), _pair(b)), _pair(back)


def _along(back: Floats) -> Floats:
    """The direction of a cutting line, from left to right, or up."""
    along = np.array([back[1], -back[0]])
    return -along if along[0] < -EDGE_ON or (abs(along[0]) <= EDGE_ON and along[1] < 0.0) else along


def _name_place(view: OnPage) -> Point:
    """The middle of a section's name."""
    bounds = bounds_of(view.drawing.lines)
    x = 0.5 * (bounds.x0 + bounds.x1) + float(view.shift[0])
    return x, bounds.y1 + float(view.shift[1]) + ABOVE + 0.5 * LETTER


def _ink(mark: SectionMark) -> Floats:
    """(n, 2) points all over the lines, arrows and letters of a mark, without its name."""
    shapes = shapes_of(mark)
    corners = [*shapes.wide, *shapes.chain, *((tip, left) for tip, left, _ in shapes.arrows)]
    share = np.linspace(0.0, 1.0, 200)[:, None]
    points = [np.array(a) + share * np.subtract(b, a) for a, b in corners]
    around = 0.5 * LETTER * np.array([(x, y) for x in (-1.0, 0.0, 1.0) for y in (-1.0, 0.0, 1.0)])
    points += [np.array(place) + around for place, text in shapes.texts if text == mark.letter]
    return np.concatenate([np.zeros((0, 2)), *points])


def _clear_of(ink: Floats, mark: SectionMark) -> Point:
    """The middle of a name where no points (n, 2) lie under it: as near as can be to where it should be."""
    half = np.array([0.5 * WIDE * LETTER * len(mark.title) + CLEAR, 0.5 * LETTER + CLEAR])
    for step in range(MOST_STEPS):
        for sense in (-1.0, 1.0):
            place = mark.name[0] + sense * step, mark.name[1]
            if not (np.abs(ink - place) < half).all(axis=1).any():
                return place
    return mark.name


def _pair(point: Floats) -> Point:
    x, y = (np.asarray(point) + 0.0).tolist()
    return x, y
