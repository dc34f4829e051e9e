"""`hlr.draw_pages`: the TechDraw pages of a FreeCAD document, drawn without FreeCAD."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from hlr.drawing.curve import Arc, Bezier, Curve
from hlr.drawing.drawing import Accuracy, Drawing, DrawnPart, DrawnView
from hlr.drawing.line import Line, Points
from hlr.drawing.lines import bounds_of
from hlr.drawing.notes import Note
from hlr.drawing.page import Page
from hlr.drawing.sheet import Sheet, SheetView
from hlr.errors import OptionError, SourceError
from hlr.pipeline.draw import draw_views
from hlr.pipeline.session import refuse_warnings
from hlr.request.check import WIDEST, checked
from hlr.request.options import Options, Perspective
from hlr.request.style import STANDARD, LineRule, Style
from hlr.request.style_file import style_of
from hlr.source.cad.brep_source import BrepSource
from hlr.source.cad.source_builder import build_source
from hlr.source.file_checks import check_readable
from hlr.source.freecad.fcstd import leaves_of, opened_document
from hlr.source.freecad.pages import DocumentPage, PageView, pages_of
from hlr.source.freecad.shapes import Shapes
from hlr.tables.entry import listed

if TYPE_CHECKING:
    from hlr.common.types import Floats, Progress
    from hlr.source.freecad.document import Document

MARGIN = 10.0
"""Millimetres around the views of a page that has no template, and so no size."""

FREE = {"accuracy", "crease", "details", "intersections", "strict", "style", "threads"}
"""Options that a page leaves open; all others are said by its views."""


OF_ONE_VIEW = {"hidden-objects-left-out", "thin-lines", "crowded", "paper-size", "nothing-in-view"}
"""Notes that say nothing of a page: its views choose objects, widths and scales."""


def page_names(source: str | os.PathLike[str]) -> list[tuple[str, str]]:
    """Name and label of each page of a FreeCAD document.

    Raises SourceError where it cannot be read.
    """
    path = _path(source)
    with opened_document(path) as document:
        return [(page.name, page.label) for page in pages_of(document, path)]


def draw_pages(
    source: str | os.PathLike[str],
    pages: Sequence[str] | None = None,
    options: Options | None = None,
    progress: Progress | None = None,
) -> list[Drawing]:
    """The TechDraw pages of a FreeCAD document: template, views and groups of projections, at their places.

    source    the path of a document (.FCStd)
    pages     names or labels; None: all
    options   accuracy, style, threads, strict, details, crease, intersections; all else is said by the views
    progress  as of `hlr.draw`

    What else is on a page, such as dimensions, is not drawn, and a note names it.

    Raises SourceError, OptionError; with options.strict StrictError for any warning.

    >>> import hlr
    >>> (page,) = hlr.draw_pages("housing.FCStd")
    >>> page, page.page.width, len(page.sheet.views)
    (<Drawing housing.FCStd, Page, 1:1, 99 visible and 40 hidden lines, 1 note>, 420.0, 7)
    >>> page.save("page.svg").name
    'page.svg'
    """
    options = _page_options(options or Options())
    path = _path(source)
    with opened_document(path) as document:
        wanted = _chosen(pages_of(document, path), pages, path)
        sources = _Sources(document, path)
        drawings = []
        for number, page in enumerate(wanted):
            told = None if progress is None else _part_of(progress, number, len(wanted))
            drawings.append(_drawn(page, sources, options, told))
    for drawing in drawings:
        if options.strict:
            refuse_warnings(drawing.notes)
    return drawings


def _path(source: Any) -> Path:
    path = Path(os.fspath(source))
    check_readable(path)
    if path.suffix.lower() != ".fcstd":
        raise OptionError(f"only FreeCAD documents (.FCStd) have pages, and {path.name} is none: leave the page out.")
    return path


def _page_options(options: Options) -> Options:
    usual = Options()
    given = [name for name in Options.__dataclass_fields__ if getattr(options, name) != getattr(usual, name)]
    if barred := [name for name in given if name not in FREE]:
        raise OptionError(f"the views of a page say {listed(barred, 'and')} themselves: leave that out")
    return checked(options)


def _chosen(pages: list[DocumentPage], names: Sequence[str] | None, path: Path) -> list[DocumentPage]:
    if not pages:
        raise SourceError(f"{path.name} has no TechDraw pages.")
    if names is None:
        return pages
    found = []
    for name in names:
        page = next((page for page in pages if page.name == name), None)
        page = page or next((page for page in pages if page.label == name), None)
        if page is None:
            known = listed((f'"{page.label}"' for page in pages), "and")
            raise OptionError(f'{path.name} has no page "{name}": its pages are {known}')
        found.append(page)
    return found


def _part_of(progress: Progress, number: int, count: int) -> Progress:
    return lambda stage, done: progress(stage, (number + done) / count)


class _Sources:
    """The objects that views show, opened once for all views of the same objects."""

    def __init__(self, document: Document, path: Path) -> None:
        self.name = path.name
        self._document, self._shapes = document, Shapes()
        self._opened: dict[tuple[str, ...], BrepSource | SourceError] = {}

    def of(self, names: tuple[str, ...]) -> BrepSource:
        """Raises SourceError where nothing of it can be drawn."""
        if names not in self._opened:
            try:
                leaves, notes = leaves_of(self._document, self.name, self._shapes, only=names)
                self._opened[names] = build_source(self.name, "fcstd", leaves, notes)
            except SourceError as error:
                self._opened[names] = error
        found = self._opened[names]
        if isinstance(found, SourceError):
            raise found
        return found


@dataclass(slots=True)
class _Content:
    """What is on a page so far."""

    parts: list[DrawnPart]
    lines: list[Line]
    notes: list[Note]
    accuracies: list[Accuracy]


def _drawn(page: DocumentPage, sources: _Sources, options: Options, progress: Progress | None) -> Drawing:
    content = _Content([], [], [], [])
    shown = []
    for number, view in enumerate(page.views):
        told = None if progress is None else _part_of(progress, number, len(page.views))
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
    used = max((accuracy.used for accuracy in content.accuracies), default=options.accuracy or 0.05)
    return Drawing(
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
    content.lines += [_moved(x, matrix, shift, first) for x in drawing.lines if (x.kind, x.visible) in view.lines]
    content.notes += [note for note in drawing.notes if note.code not in OF_ONE_VIEW]
    content.accuracies.append(drawing.accuracy)


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


def _moved(line: Line, matrix: Points, shift: Points, first: int) -> Line:
    """A line turned and shifted on paper; first: the number of its view's first part."""
    return replace(
        line,
        part=line.part + first,
        other=None if line.other is None else line.other + first,
        points=line.points @ matrix.T + shift,
        curve=_moved_curve(line.curve, matrix, shift),
    )


def _moved_curve(curve: Curve | None, matrix: Points, shift: Points) -> Curve | None:
    match curve:
        case Arc():
            return Arc(curve.centre @ matrix.T + shift, curve.axes @ matrix.T, curve.angles)
        case Bezier():
            return Bezier(curve.degree, curve.points @ matrix.T + shift)
    return None
