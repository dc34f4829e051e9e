"""Several views of a source on one page: each is drawn by itself at one scale, then put at its place."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np

from hlr.common.numbers import typed
from hlr.common.types import Floats, Progress
from hlr.drawing.drawing import Drawing, DrawnPart, DrawnView
from hlr.drawing.line import Line, Points
from hlr.drawing.lines import shifted_together
from hlr.drawing.notes import Note, of_each_view
from hlr.drawing.page import Page
from hlr.drawing.scale import ratio
from hlr.drawing.sheet import Sheet, SheetView
from hlr.errors import OptionError
from hlr.image.arrangement import LEAST_GAP, Arrangement, Room, Size, arranged, check_views, inside_margins
from hlr.image.method_cells import cells_of
from hlr.image.placement import size_notes
from hlr.linework.legible import legible
from hlr.pipeline.draw import draw_views
from hlr.pipeline.session import Session, refuse_warnings
from hlr.request.check import checked_views
from hlr.request.drawing_effects import drawing_effects
from hlr.request.effect import Planner
from hlr.request.options import Options, View
from hlr.request.shown_views import ShownView, shown_views
from hlr.request.style_file import style_of
from hlr.source.page_template import PageTemplate, Rectangle
from hlr.source.selection import open_selected
from hlr.tables.projection_methods import Cell, ProjectionMethod
from hlr.tables.sheets import SLACK, USUAL, Paper, papers

if TYPE_CHECKING:
    from hlr.drawing.section_marks import SectionMark

OF_ONE_VIEW = {"page-too-small", "paper-size"}
"""Notes that are about the page of a single view."""

MOST_DRAWINGS = 2
"""Views that turn out smaller than was foreseen are drawn once more if they fit at a larger scale."""


_CLOSE = Note(
    "section-marks-close",
    "cutting lines are so close together that their marks have no room side by side: give a larger page, or a larger "
    "scale.",
)


@dataclass(frozen=True, slots=True)
class _Placed:
    """A view at its place. shift (2,): from its own coordinates to those of the page, millimetres."""

    drawing: Drawing
    name: str
    place: tuple[float, float]
    shift: Floats


@dataclass(frozen=True, slots=True)
class Printed:
    """What is on a page besides its views. texts: for the fields of the template; room: instead of what that says."""

    template: PageTemplate | None = None
    texts: Mapping[str, str] = field(default_factory=dict)
    room: Rectangle | None = None

    def rooms(self, options: Options) -> list[Room]:
        """Where views may lie."""
        template = self.template
        if template is None:
            sheets = list(papers(USUAL if options.page is None else options.page))
        else:
            sheets = [Paper(template.path.stem, template.width, template.height)]
        if self.room is not None:
            return _on_any(sheets, self.room)
        if template is None or not template.rooms:
            return [inside_margins(sheet) for sheet in sheets]
        return [_room(sheet, free) for sheet in sheets for free in template.rooms]

    def svg(self, scale: float) -> str:
        """The template with its texts; empty without one. scale: of the views, paper : model."""
        return "" if self.template is None else self.template.filled(self.texts, ratio(scale))

    def stated(self, scale: float) -> dict[str, str]:
        """What then stands in the fields of the template, by their keys."""
        return {} if self.template is None else self.template.texts(self.texts, ratio(scale))

    def notes(self) -> list[Note]:
        """What is said about the template."""
        if self.template is None or self.room is not None or self.template.rooms:
            return []
        name = self.template.path.name
        text = f"{name} does not say where views may lie: room (--room) keeps them off its title block."
        return [Note("room-unknown", text)]


@dataclass(frozen=True, slots=True)
class _Spacing:
    """Where views may lie, and the least gap between them, millimetres."""

    rooms: Sequence[Room]
    gap: float


@dataclass(frozen=True, slots=True)
class _Views:
    """The views of a page. cells, beside: as of `hlr.image.arrangement.arranged`."""

    shown: Sequence[ShownView]
    cells: Sequence[Cell | None]
    beside: Mapping[int, Cell]
    method: ProjectionMethod

    def in_line(self, i: int) -> bool:
        """Whether a view is in line with those of its row and column that have the same axis there."""
        return self.cells[i] is not None or self.shown[i].others > 0

    def arranged(self, sizes: Sequence[Size], spacing: _Spacing, scale: float | None) -> Arrangement:
        """As of `hlr.image.arrangement.arranged`."""
        return arranged(self.cells, sizes, self.method, spacing.rooms, scale, spacing.gap, self.beside)

    def spacing(self, rooms: Sequence[Room], farther: float = 0.0) -> _Spacing:
        """Rooms on pages, less what the marks of sections need there, which go so much farther out than usual."""
        if not any(each.letter for each in self.shown):
            return _Spacing(rooms, LEAST_GAP)
        from hlr.drawing.section_marks import REACH

        return _Spacing([_inside(room, REACH + farther) for room in rooms], 2.0 * REACH + farther)

    def spread(
        self, found: Arrangement, sizes: Sequence[Size], drawings: Sequence[Drawing], rooms: Sequence[Room]
    ) -> tuple[Arrangement, int, list[Note]]:
        """The arrangement with more room for marks that are close together, where the scale allows that.

        Room all around is enough; less is, where the marks lie clear of other views and of the margins even so.
        Behind it how far these go out, as of `hlr.pipeline.section.on_page.end_levels`, and what is said about it.
        """
        if len(self.letters) < 2:
            return found, 0, []
        from hlr.drawing.section_marks import FARTHER
        from hlr.pipeline.section.on_page import FARTHEST_ENDS, are_clear, cutting_lines, end_levels

        own = [cell is not None for cell in self.cells]
        lines = cutting_lines(_placed(drawings, sizes, found, self), own)
        most = max((level for ends in end_levels(lines, len(lines)).values() for level in ends), default=0)
        free = [room for room in rooms if room.paper == found.room.paper]
        for level in range(min(most, FARTHEST_ENDS), 0, -1):
            for wider in range(level, -1, -1):
                spread = self._wider(found, sizes, self.spacing(free, FARTHER * wider)) if wider else found
                if spread is None:
                    continue
                placed = _placed(drawings, sizes, spread, self)
                if wider == level or are_clear(placed, own, self.letters, level, spread.room.around(free)):
                    return spread, level, [] if level == most else [_CLOSE]
        return found, 1, [_CLOSE] if most else []

    def _wider(self, found: Arrangement, sizes: Sequence[Size], spacing: _Spacing) -> Arrangement | None:
        """The arrangement at its scale with this spacing; None: it has no room."""
        with suppress(OptionError):
            needs = (spread := self.arranged(sizes, spacing, found.scale)).needs(sizes)
            if needs[0] <= spread.room.width + SLACK and needs[1] <= spread.room.height + SLACK:
                return spread
        return None

    @property
    def letters(self) -> dict[str, str]:
        """Of the sections, by the names of their views, in the order of the marks."""
        return {each.name: each.letter for each in sorted(self.shown, key=lambda each: each.number) if each.letter}


def _on_any(sheets: Sequence[Paper], rectangle: Rectangle) -> list[Room]:
    """A room on those sheets that it lies on. Raises OptionError where it leads out of all."""
    x0, y0, x1, y1 = rectangle
    found = [
        _room(sheet, rectangle) for sheet in sheets if x0 >= 0.0 <= y0 and x1 <= sheet.width and y1 <= sheet.height
    ]
    if not found:
        page = f"a page of {sheets[0].width:g} x {sheets[0].height:g} mm"
        given = ",".join(typed(end) for end in (x0, y0, x1, y1))
        raise OptionError(f"the room {given} leads out of {page}: give two corners on the page")
    return found


def _room(paper: Paper, rectangle: Rectangle) -> Room:
    x0, y0, x1, y1 = rectangle
    return Room(paper, x0, y0, x1 - x0, y1 - y0)


def draw_on_one_page(
    source: Any,
    views: Sequence[View],
    method: ProjectionMethod,
    options: Options,
    printed: Printed,
    progress: Progress | None = None,
) -> Drawing:
    """The views of a source on one page. options: checked, without any that are for a single view.

    Raises as `draw_views`, and OptionError where the page has no room for the views.
    """
    started = perf_counter()
    views = checked_views(views, options)
    if options.section is not None:
        from hlr.request.section import check_sections

        check_sections(options.section, views, options.whole, by_name=True)
    shown = shown_views(views, options.section, options.whole)
    asked = _Views(shown, *cells_of(shown, method), method)
    check_views([each.name for each in shown], asked.cells, method)
    source = open_selected(source, options)
    alone = replace(options, details=True, strict=False, same_scale=False)
    session = Session(source, [each.view for each in shown], alone)
    reading = perf_counter() - started
    sizes: list[Size] = [(w * at.unit, h * at.unit) for at in session.placements for w, h in [at.size]]
    free = printed.rooms(options)
    spacing = asked.spacing(free)
    scale = None if options.scale is None else float(options.scale)
    found = asked.arranged(sizes, spacing, scale)
    for number in range(MOST_DRAWINGS):
        paper = found.room.paper
        on_page = replace(alone, scale=found.scale, page=(paper.width, paper.height))
        drawings = draw_views(source, views, on_page, progress, one_sheet=True)
        sizes = _sizes(drawings, found, asked)
        better = asked.arranged(sizes, spacing, scale)
        if number + 1 == MOST_DRAWINGS or better.scale <= found.scale:
            break
        found = better
    found, farthest, close = asked.spread(found, sizes, drawings, free)
    drawing = _together(drawings, sizes, found, asked, options, printed, farthest)
    drawing = replace(drawing, notes=(*drawing.notes, *close))
    if scale is not None:
        fits = asked.arranged(sizes, spacing, None).scale
        drawing = replace(drawing, notes=(*drawing.notes, *_of_scale(sizes, found, fits)))
    if options.strict:
        refuse_warnings(drawing.notes)
    return replace(drawing, timings=_timings(drawings, reading, perf_counter() - started))


def _timings(drawings: Sequence[Drawing], reading: float, total: float) -> dict[str, float]:
    """Seconds by stage: what all views share is told once, the rest is added up."""
    stages = dict(drawings[0].timings)
    for drawing in drawings[1:]:
        for stage in ("plan", "visibility", "linework"):
            stages[stage] = stages.get(stage, 0.0) + drawing.timings.get(stage, 0.0)
    return {**stages, "source": reading, "total": total}


def _together(
    drawings: Sequence[Drawing],
    sizes: Sequence[Size],
    found: Arrangement,
    asked: _Views,
    options: Options,
    printed: Printed,
    farthest: int,
) -> Drawing:
    """One drawing of all views. farthest: as of `_Views.spread`."""
    placed = _placed(drawings, sizes, found, asked)
    views: list[tuple[Sequence[Line], Points, int]] = []
    parts: list[DrawnPart] = []
    counters = Counter[str]()
    for each in placed:
        views.append((each.drawing.lines, each.shift, len(parts)))
        parts += [replace(part, name=f"{each.name}/{part.name}") for part in each.drawing.parts]
        counters.update(each.drawing.counters)
    # Hatches are close together, and no reason for thinner pens.
    lines, hatches = shifted_together(views, apart="hatch")
    paper, style = found.room.paper, style_of(options.style)
    coarsest = max((drawing.accuracy for drawing in drawings), key=lambda accuracy: accuracy.used)
    room = (paper.width, paper.height)
    shown = legible(lines, found.scale, coarsest.used, style, room, Planner(drawing_effects(), options))
    marks: dict[str, SectionMark] = {}
    marking: list[Note] = []
    if options.section is not None:
        from hlr.pipeline.section.on_page import section_marks

        own = [cell is not None for cell in asked.cells]
        marks, marking = section_marks(placed, own, asked.letters, farthest)
    return Drawing(
        source=drawings[0].source,
        view=DrawnView(asked.method.name, "orthographic", (0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
        scale=found.scale,
        origin=(0.0, 0.0),
        accuracy=replace(coarsest, asked=options.accuracy),
        unit=drawings[0].unit,
        up_axis=drawings[0].up_axis,
        parts=tuple(parts),
        lines=(*shown.lines, *hatches) if len(hatches) else shown.lines,
        notes=tuple(dict.fromkeys((*_notes(drawings), *shown.notes, *printed.notes(), *marking))),
        counters=dict(counters),
        page=Page(paper.name, paper.width, paper.height, 0.0, 0.0),
        sheet=Sheet(
            tuple(_shown(each, found.scale, marks) for each in placed),
            printed.svg(found.scale),
            asked.method.name,
            tuple(marks.values()),
            printed.stated(found.scale),
        ),
        style=style,
        group=shown.group,
        reading=drawings[0].reading,
    )


_Axis = tuple[int, int, tuple[float, ...]]
"""To the right or up, the column or row, and where that points in the model."""


def _extents(drawings: Sequence[Drawing], found: Arrangement, asked: _Views) -> dict[_Axis, tuple[float, float]]:
    """From where to where all views of a column or a row reach, millimetres: a section may show less than others."""
    extents: dict[_Axis, tuple[float, float]] = {}
    for i, drawing in enumerate(drawings):
        bounds, view = drawing.bounds, drawing.view
        if not asked.in_line(i):
            continue
        for k, axis, ends in ((0, view.right, (bounds.x0, bounds.x1)), (1, view.up, (bounds.y0, bounds.y1))):
            low, high = (end + drawing.origin[k] for end in ends)
            before = extents.get((k, found.cells[i][k], axis), (low, high))
            extents[k, found.cells[i][k], axis] = min(low, before[0]), max(high, before[1])
    return extents


def _sizes(drawings: Sequence[Drawing], found: Arrangement, asked: _Views) -> list[Size]:
    """Width and height of each view at 1:1, as drawn; a view in line with others is as large as all of them."""
    sizes = [(d.bounds.width / found.scale, d.bounds.height / found.scale) for d in drawings]
    if all(drawing.section is None for drawing in drawings):
        return sizes
    extents = _extents(drawings, found, asked)
    for i, (drawing, cell) in enumerate(zip(drawings, found.cells, strict=True)):
        if asked.in_line(i):
            across, up = extents[0, cell[0], drawing.view.right], extents[1, cell[1], drawing.view.up]
            sizes[i] = (across[1] - across[0]) / found.scale, (up[1] - up[0]) / found.scale
    return sizes


def _inside(room: Room, border: float) -> Room:
    """A room without its borders, millimetres wide, on which the marks of sections may lie."""
    border = min(border, 0.25 * room.width, 0.25 * room.height)
    width, height = room.width - 2.0 * border, room.height - 2.0 * border
    return replace(room, x=room.x + border, y=room.y + border, width=width, height=height)


def _placed(drawings: Sequence[Drawing], sizes: Sequence[Size], found: Arrangement, asked: _Views) -> list[_Placed]:
    """The views at their places. Those of a column and a row lie exactly in line with the first of it."""
    middles: dict[_Axis, float] = {}
    if any(drawing.section is not None for drawing in drawings):
        middles = {axis: 0.5 * (low + high) for axis, (low, high) in _extents(drawings, found, asked).items()}
    placed = []
    for i, place in enumerate(found.places(sizes)):
        drawing, shift = drawings[i], []
        axes, bounds = (drawing.view.right, drawing.view.up), drawing.bounds
        for k, (low, high) in enumerate(((bounds.x0, bounds.x1), (bounds.y0, bounds.y1))):
            middle = 0.5 * (low + high) + drawing.origin[k]
            if asked.in_line(i):
                middle = middles.setdefault((k, found.cells[i][k], axes[k]), middle)
            shift.append(place[k] - middle + drawing.origin[k])
        placed.append(_Placed(drawing, asked.shown[i].name, place, np.array(shift)))
    return placed


def _notes(drawings: Sequence[Drawing]) -> list[Note]:
    notes = [[note for note in drawing.notes if note.code not in OF_ONE_VIEW] for drawing in drawings]
    return of_each_view([drawing.view.name for drawing in drawings], notes)


def _of_scale(sizes: Sequence[Size], found: Arrangement, fits: float) -> list[Note]:
    """What is said where a scale was asked for. fits: the largest standard one at which all views fit."""
    needs, room = found.needs(sizes), found.room
    notes = list(size_notes(found.scale * max(math.hypot(*size) for size in sizes), found.scale))
    if needs[0] > room.width + SLACK or needs[1] > room.height + SLACK:
        size, free = (
            " x ".join(typed(side, 4) for side in both) + " mm" for both in (needs, (room.width, room.height))
        )
        text = f"the views, {size} at {ratio(found.scale)}, are too large for the page, which has room for {free}"
        text += f": give the scale {ratio(fits)}, or a larger page."
        notes.append(Note("page-too-small", text))
    return notes


def _shown(placed: _Placed, scale: float, marks: Mapping[str, SectionMark]) -> SheetView:
    view, mark = placed.drawing.view, marks.get(placed.name)
    letter = "" if mark is None else mark.letter
    x, y = (np.array(placed.drawing.origin) - placed.shift).tolist()
    shown = SheetView(placed.name, view.name, scale, placed.place, 0.0, view.direction, view.right, letter, (x, y))
    cut = placed.drawing.section
    return shown if cut is None else replace(shown, section=cut.point, corners=cut.corners)
