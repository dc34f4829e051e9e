"""A TechDraw page of a FreeCAD document: each view is drawn by itself and put at its place, over the template."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from hlr.drawing.drawing import Accuracy, Drawing, DrawnPart, DrawnView
from hlr.drawing.line import Bounds, Line
from hlr.drawing.lines import bounds_of
from hlr.drawing.moved import moved
from hlr.drawing.notes import Note
from hlr.drawing.page import Page
from hlr.drawing.sheet import Sheet, SheetView
from hlr.errors import SourceError
from hlr.pipeline.draw import draw_views
from hlr.request.accuracy import DEFAULT_ACCURACY
from hlr.request.check import WIDEST
from hlr.request.options import Options, Perspective
from hlr.request.style import STANDARD, LineRule, Style
from hlr.request.style_file import style_of
from hlr.source.cad.brep_source import BrepSource
from hlr.source.cad.kernel_shapes import without_opencascade
from hlr.source.cad.source_builder import build_source
from hlr.source.freecad.fcstd import leaves_of
from hlr.source.freecad.pages import DocumentPage, PageView
from hlr.source.freecad.shapes import Shapes
from hlr.tables.entry import listed
from hlr.window.frame import Frame
from hlr.window.lines import cut_lines

if TYPE_CHECKING:
    from hlr.common.types import Floats, Progress
    from hlr.source.freecad.document import Document

MARGIN = 10.0
"""Millimetres around the views of a page that has no template, and so no size."""

OF_ONE_VIEW = {"hidden-objects-left-out", "thin-lines", "crowded", "paper-size", "nothing-in-view"}
"""Notes that say nothing of a page: its views choose objects, widths and scales."""


def part_of(progress: Progress, number: int, count: int) -> Progress:
    """The progress of one of several pages, or of one of several views."""
    return lambda stage, done: progress(stage, (number + done) / count)


class Sources:
    """The objects that views show, opened once for all views of the same objects."""

    def __init__(self, document: Document, path: Path) -> None:
        self.name = path.name
        self._document, self._shapes = document, (Shapes(opencascade=False), Shapes(opencascade=True))
        self._opened: dict[tuple[str, ...], BrepSource | SourceError] = {}

    def of(self, names: tuple[str, ...]) -> BrepSource:
        """Raises SourceError where nothing of it can be drawn."""
        if names not in self._opened:
            try:
                leaves, notes = without_opencascade(
                    lambda opencascade: leaves_of(
                        self._document, self.name, self._shapes[opencascade], only=names, sketches=True
                    )
                )
                self._opened[names] = build_source(self.name, "fcstd", leaves, notes, wires_too=True)
            except SourceError as error:
                self._opened[names] = error
        found = self._opened[names]
        if isinstance(found, SourceError):
            raise found
        return found


@dataclass(frozen=True, slots=True, eq=False)
class PlacedView:
    """A view of a page before it was put at its place: what it shows, and its drawing. Lines lie at matrix @ (x, y) +
    shift on the page; cut: whether only those inside a window of the page are there."""

    name: str
    source: BrepSource
    drawing: Drawing
    matrix: Floats
    shift: Floats
    cut: bool


@dataclass(slots=True)
class _Content:
    """What is on a page so far."""

    parts: list[DrawnPart]
    lines: list[Line]
    notes: list[Note]
    accuracies: list[Accuracy]
    views: list[PlacedView]


def drawn_page(
    page: DocumentPage, sources: Sources, options: Options, progress: Progress | None
) -> tuple[Drawing, list[PlacedView]]:
    """The drawing of a page, and its views; what of it is not drawn is named in its notes. options: checked."""
    content = _Content([], [], [], [], [])
    shown = []
    for number, view in enumerate(page.views):
        told = None if progress is None else part_of(progress, number, len(page.views))
        try:
            _add(view, sources.of(view.sources), content, options, told)
        except SourceError as error:
            content.notes.append(_left_out(f'view "{view.label}" ({str(error).rstrip(".")})', page))
            continue
        shown.append(
            SheetView(view.name, view.label, view.scale, view.place, view.rotation, view.direction, view.right)
        )
    if page.left_out:
        content.notes.append(_left_out(listed(page.left_out, "and"), page))
    used = max((accuracy.used for accuracy in content.accuracies), default=options.accuracy or DEFAULT_ACCURACY)
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
        sheet=Sheet(tuple(shown), page.template),
        style=_style(page) if options.style is None else style_of(options.style),
    )
    return drawing, content.views


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


def _add(view: PageView, source: BrepSource, content: _Content, options: Options, progress: Progress | None) -> None:
    """Draw a view, and put it at its place."""
    asked = replace(
        options,
        strict=False,
        scale=view.scale,
        up=_up(view),
        hidden=any(not visible for _, visible in view.lines),
        smooth=any(kind == "smooth" for kind, _ in view.lines),
        seam=any(kind == "seam" for kind, _ in view.lines),
        perspective=None if view.focus is None else _camera(view, source),
    )
    (drawing,) = draw_views(source, [view.direction], asked, progress)
    bounds = drawing.bounds
    if view.focus is None:
        middle = np.array([0.5 * (bounds.x0 + bounds.x1), 0.5 * (bounds.y0 + bounds.y1)])
    else:
        middle = -np.array(drawing.origin)
    turn = math.radians(view.rotation)
    matrix = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    shift = np.array(view.place) - matrix @ middle
    first = len(content.parts)
    content.parts += [replace(part, name=f"{view.name}/{part.name}") for part in drawing.parts]
    lines = [moved(x, matrix, shift, first) for x in drawing.lines if (x.kind, x.visible) in view.lines]
    content.lines += lines if view.window is None else _inside(view.window, lines, drawing.view, view)
    content.notes += [note for note in drawing.notes if note.code not in OF_ONE_VIEW]
    content.accuracies.append(drawing.accuracy)
    content.views.append(PlacedView(view.name, source, drawing, matrix, shift, view.window is not None))


def _inside(window: tuple[float, ...], lines: list[Line], drawn: DrawnView, view: PageView) -> Sequence[Line]:
    """What of the lines on the page lies in the window of a clip."""
    turn = math.radians(view.rotation)
    right, up = np.array(drawn.right), np.array(drawn.up)
    right, up = math.cos(turn) * right - math.sin(turn) * up, math.sin(turn) * right + math.cos(turn) * up
    axes = replace(drawn, right=tuple(right.tolist()), up=tuple(up.tolist()))
    return cut_lines(lines, Frame(Bounds(*window), axes, view.scale))[0]


def _up(view: PageView) -> tuple[float, float, float]:
    x, y, z = np.cross(view.direction, view.right).tolist()
    return x, y, z


def _camera(view: PageView, source: BrepSource) -> Perspective:
    """The eye in front of the middle of what is seen, in the box whose sides lie along the view's axes."""
    toward = np.array(view.direction) / math.sqrt(sum(x * x for x in view.direction))
    axes = np.array([view.right, np.cross(toward, view.right), toward])
    low, high = source.bounds()
    size = float(np.max(high - low))
    points: Floats = np.concatenate([part.points for part in source.mesh(1e-4 * size, 0.2).parts]) @ axes.T
    target = 0.5 * (points.min(axis=0) + points.max(axis=0)) @ axes
    eye = target + (view.focus or 0.0) / view.scale * toward
    return Perspective(eye=tuple(eye.tolist()), target=tuple(target.tolist()), fov=WIDEST)
