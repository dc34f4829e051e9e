"""A TechDraw page of a FreeCAD document: each view is drawn by itself and put at its place, over the template."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from hlr.drawing.drawing import Accuracy, Drawing, DrawnPart, DrawnView
from hlr.drawing.line import Line
from hlr.drawing.lines import bounds_of
from hlr.drawing.notes import Note
from hlr.drawing.page import Page
from hlr.drawing.sheet import Sheet, SheetView
from hlr.errors import SourceError
from hlr.linework.cut_faces import CutFace
from hlr.pipeline.page.cut_faces import cut_faces_of, filling
from hlr.pipeline.page.marks import mark_of
from hlr.pipeline.page.placed_view import PlacedView, lines_on_page, placed_view
from hlr.pipeline.page.sources import Sources
from hlr.request.accuracy import DEFAULT_ACCURACY
from hlr.request.options import Options
from hlr.request.style import STANDARD, LineRule, Style
from hlr.request.style_file import style_of
from hlr.source.freecad.pages import DocumentPage
from hlr.tables.entry import listed

if TYPE_CHECKING:
    from hlr.common.types import Progress

MARGIN = 10.0
"""Millimetres around the views of a page that has no template, and so no size."""

OF_ONE_VIEW = {"hidden-objects-left-out", "glass-hides", "thin-lines", "crowded", "paper-size", "nothing-in-view"}
"""Notes that say nothing of a page: its views choose objects, what is seen of them, widths and scales."""


def part_of(progress: Progress, number: int, count: int) -> Progress:
    """The progress of one of several pages, or of one of several views."""
    return lambda stage, done: progress(stage, (number + done) / count)


@dataclass(slots=True)
class _Content:
    """What is on a page so far. template: what is printed under its lines."""

    template: str
    parts: list[DrawnPart]
    lines: list[Line]
    notes: list[Note]
    views: list[PlacedView]


def drawn_page(
    page: DocumentPage, sources: Sources, options: Options, progress: Progress | None
) -> tuple[Drawing, list[PlacedView], list[SourceError]]:
    """The drawing of a page, its views, and why others cannot be drawn; what is not drawn is named in its notes.

    options: checked
    """
    content, refused = _Content(page.template, [], [], [], []), []
    for number, view in enumerate(page.views):
        told = None if progress is None else part_of(progress, number, len(page.views))
        try:
            _add(placed_view(view, sources.of(view.sources, view.cuts), options, told), content)
        except SourceError as error:
            refused.append(error)
            content.notes.append(_left_out(f'view "{view.label}" ({str(error).rstrip(".")})', page))
    _print(content, page)
    if page.left_out:
        content.notes.append(_left_out(listed(page.left_out, "and"), page))
    used = max((each.drawing.accuracy.used for each in content.views), default=options.accuracy or DEFAULT_ACCURACY)
    drawing = Drawing(
        source=sources.name,
        view=DrawnView(page.label, "orthographic", (0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
        scale=1.0,
        origin=(0.0, 0.0),
        accuracy=Accuracy(options.accuracy, used),
        unit=1.0,
        up_axis=((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
        parts=tuple(content.parts),
        lines=tuple(content.lines),
        notes=tuple(dict.fromkeys(content.notes)),
        page=_paper(page, content.lines),
        sheet=Sheet(tuple(_shown(each) for each in content.views), content.template, texts=page.texts),
        style=_style(page) if options.style is None else style_of(options.style),
    )
    return drawing, content.views, refused


def _add(placed: PlacedView, content: _Content) -> None:
    """Put a view at its place."""
    first, name = len(content.parts), placed.view.name
    content.parts += [replace(part, name=f"{name}/{part.name}") for part in placed.drawing.parts]
    content.lines += lines_on_page(placed, first)
    content.notes += [note for note in placed.drawing.notes if note.code not in OF_ONE_VIEW]
    content.views.append(placed)


def _print(content: _Content, page: DocumentPage) -> None:
    """What fills cut faces, and the marks of sections and details. They have their place on a page with a size."""
    views = {placed.view.name: placed for placed in content.views}
    made = [placed for placed in content.views if placed.view.cuts or placed.view.detail is not None]
    if page.size is None:
        if made:
            content.notes.append(_left_out("hatches and marks of sections and details", page))
        return
    height, marks = page.size[1], ""
    for placed in made:
        # A detail of a section has its lines alone.
        section = placed.view.detail is None
        faces: list[CutFace] = cut_faces_of(placed) if section else []
        filled = filling(placed, faces, height) if section else ""
        if filled is None:
            content.notes.append(_left_out(f'the hatch of "{placed.view.label}" (it has too many strokes)', page))
        content.template += filled or ""
        marks += mark_of(placed, views, faces, height)
    content.template += marks


def _shown(placed: PlacedView) -> SheetView:
    view, origin = placed.view, None
    if view.focus is None:
        x, y = (placed.matrix @ np.array(placed.drawing.origin) - placed.shift).tolist()
        origin = x, y
    return SheetView(
        view.name, view.label, view.scale, view.place, view.rotation, view.direction, view.right, origin=origin
    )


def _left_out(what: str, page: DocumentPage) -> Note:
    return Note("page-items-left-out", f'Page "{page.label}": {what} not drawn.')


def _paper(page: DocumentPage, lines: list[Line]) -> Page:
    if page.size is not None:
        return Page(page.label, *page.size, 0.0, 0.0)
    bounds = bounds_of(lines)
    width, height = bounds.width + 2.0 * MARGIN, bounds.height + 2.0 * MARGIN
    return Page(page.label, width, height, MARGIN - bounds.x0, MARGIN - bounds.y0)


def _style(page: DocumentPage) -> Style:
    """The widths of the views: those of the first for all, and rules for the views that have others."""
    widths = {view.name: view.widths for view in page.views if view.widths is not None}
    if not widths:
        return Style()
    usual = next(iter(widths.values()))
    rules = [
        LineRule(parts=name, visible=visible, width=width)
        for name, own in widths.items()
        if own != usual
        for visible, width in zip((True, False), own, strict=True)
    ]
    return Style(lines=(*STANDARD, *rules), wide=usual[0], narrow=usual[1])
