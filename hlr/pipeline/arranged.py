"""Several views of a source on one page: each is drawn by itself at one scale, then put at its place."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hlr.common.types import Floats, Progress
from hlr.drawing.drawing import Accuracy, Drawing, DrawnPart, DrawnView
from hlr.drawing.line import Line
from hlr.drawing.moved import moved
from hlr.drawing.notes import Note
from hlr.drawing.page import Page
from hlr.drawing.pens import usual_pens_of
from hlr.drawing.projection_symbol import projection_symbol
from hlr.drawing.sheet import Sheet, SheetView
from hlr.image.arrangement import Arrangement, Size, arranged
from hlr.image.paper import misfit
from hlr.linework.legible import legible
from hlr.pipeline.draw import draw_views
from hlr.pipeline.session import Session, refuse_warnings
from hlr.request.check import checked_views
from hlr.request.drawing_effects import drawing_effects
from hlr.request.effect import Planner
from hlr.request.options import Options, View
from hlr.request.style import Style
from hlr.request.style_file import style_of
from hlr.source.selection import open_selected
from hlr.tables.projection_methods import ProjectionMethod
from hlr.tables.sheets import USUAL, papers

OF_ONE_VIEW = {"page-too-small", "paper-size"}
"""Notes that are about the page of a single view."""

MOST_DRAWINGS = 2
"""Views that turn out smaller than was foreseen are drawn once more if they fit at a larger scale."""


@dataclass(frozen=True, slots=True)
class _Placed:
    """A view at its place. shift (2,): from its own coordinates to those of the page, millimetres."""

    drawing: Drawing
    name: str
    place: tuple[float, float]
    shift: Floats


def draw_on_one_page(
    source: Any, views: Sequence[View], method: ProjectionMethod, options: Options, progress: Progress | None = None
) -> Drawing:
    """The views of a source on one page. options: checked, without any that are for a single view.

    Raises as `draw_views`, and OptionError where the page has no room for the views.
    """
    source = open_selected(source, options)
    views = checked_views(views, options)
    alone = replace(options, details=True, strict=False)
    session = Session(source, views, alone)
    names = [camera.name for camera in session.cameras]
    sizes: list[Size] = [(w * at.unit, h * at.unit) for at in session.placements for w, h in [at.size]]
    pages = papers(USUAL if options.page is None else options.page)
    scale = None if options.scale is None else float(options.scale)
    found = arranged(names, sizes, method, pages, scale)
    for _ in range(MOST_DRAWINGS):
        asked = replace(alone, scale=found.scale, page=(found.paper.width, found.paper.height))
        drawings = draw_views(source, views, asked, progress)
        sizes = [(d.bounds.width / found.scale, d.bounds.height / found.scale) for d in drawings]
        better = arranged(names, sizes, method, pages, scale)
        if better.scale <= found.scale:
            break
        found = better
    drawing = _together(drawings, names, sizes, found, method, options)
    if options.strict:
        refuse_warnings(drawing.notes)
    return drawing


def _together(
    drawings: Sequence[Drawing],
    names: Sequence[str],
    sizes: Sequence[Size],
    found: Arrangement,
    method: ProjectionMethod,
    options: Options,
) -> Drawing:
    """One drawing of all views."""
    placed = _placed(drawings, names, sizes, found, method)
    lines: list[Line] = []
    parts: list[DrawnPart] = []
    counters = Counter[str]()
    for each in placed:
        first, stay = len(parts), np.eye(2)
        lines += [moved(line, stay, each.shift, first) for line in each.drawing.lines]
        parts += [replace(part, name=f"{each.name}/{part.name}") for part in each.drawing.parts]
        counters.update(each.drawing.counters)
    paper, style = found.paper, _on_page(style_of(options.style))
    accuracy = max(drawing.accuracy.used for drawing in drawings)
    room = (paper.width, paper.height)
    shown = legible(lines, found.scale, accuracy, style, room, options, Planner(drawing_effects(), options))
    whole = Drawing(
        source=drawings[0].source,
        view=DrawnView(method.name, "orthographic", (0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
        scale=found.scale,
        origin=(0.0, 0.0),
        accuracy=Accuracy(options.accuracy, accuracy),
        unit=1.0,
        up_axis=((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
        parts=tuple(parts),
        lines=shown.lines,
        notes=tuple(dict.fromkeys((*_notes(drawings, sizes, found), *shown.notes))),
        counters=dict(counters),
        timings=drawings[-1].timings,
        page=Page(paper.name, paper.width, paper.height, 0.0, 0.0),
        style=style,
        group=shown.group,
        reading=drawings[0].reading,
    )
    symbol = projection_symbol(method.name, paper.width, paper.height, usual_pens_of(whole))
    return replace(whole, sheet=Sheet(tuple(_shown(each, found.scale) for each in placed), symbol))


def _placed(
    drawings: Sequence[Drawing],
    names: Sequence[str],
    sizes: Sequence[Size],
    found: Arrangement,
    method: ProjectionMethod,
) -> list[_Placed]:
    """The views at their places. Those of a column and a row lie exactly in line with the first of it."""
    middles: dict[tuple[int, int, tuple[float, ...]], float] = {}
    placed = []
    for drawing, name, cell, place in zip(drawings, names, found.cells, found.places(sizes), strict=True):
        bounds, shift = drawing.bounds, []
        axes = (drawing.view.right, drawing.view.up)
        for k, (low, high) in enumerate(((bounds.x0, bounds.x1), (bounds.y0, bounds.y1))):
            middle = 0.5 * (low + high) + drawing.origin[k]
            if method.cells.get(name) == cell:
                middle = middles.setdefault((k, cell[k], axes[k]), middle)
            shift.append(place[k] - middle + drawing.origin[k])
        placed.append(_Placed(drawing, name, place, np.array(shift)))
    return placed


def _notes(drawings: Sequence[Drawing], sizes: Sequence[Size], found: Arrangement) -> list[Note]:
    notes = [note for drawing in drawings for note in drawing.notes if note.code not in OF_ONE_VIEW]
    too_large = misfit(found.needs(sizes), found.scale, found.paper)
    return notes if too_large is None else [*notes, too_large]


def _shown(placed: _Placed, scale: float) -> SheetView:
    view = placed.drawing.view
    return SheetView(placed.name, view.name, scale, placed.place, 0.0, view.direction, view.right)


def _on_page(style: Style) -> Style:
    """The style with its rules for parts: a part is called by its view as well, front/bolt."""
    rules = (rule if rule.parts is None else replace(rule, parts=f"*/{rule.parts}") for rule in style.lines)
    return replace(style, lines=tuple(rules))
