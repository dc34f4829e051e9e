"""A page of a FreeCAD document as a side: it is drawn anew, without FreeCAD."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hlr.compare.reading.choice import ACCURACY_SHARE, Choice
from hlr.compare.reading.sides import Behind, DrawnPage
from hlr.drawing.sheet import Sheet
from hlr.errors import OptionError
from hlr.pipeline.page.placed_view import PlacedView
from hlr.public.pages import page_names, pages_with_views
from hlr.request.accuracy import DEFAULT_ACCURACY

if TYPE_CHECKING:
    from hlr.common.types import Progress


def with_pages(
    given: tuple[Any, Any],
    page: str | None,
    tolerance_mm: float,
    choice: Choice | None = None,
    progress: Progress | None = None,
) -> tuple[Any, Any]:
    """Two sides, documents among them with their page drawn; page: name or label, or "Page/View" for one view.

    choice: a page leaves none, and is refused with one.

    Raises SourceError, OptionError where there is no such document, page or view.
    """
    if page is None:
        return given
    documents = [_is_document(side) for side in given]
    if not any(documents):
        raise OptionError(
            f'the page "{page}" is given, and no side is a FreeCAD document (.FCStd): leave it out, or name one'
        )
    a, b = (
        page_of(side, page, tolerance_mm, choice, progress) if drawn else side
        for side, drawn in zip(given, documents, strict=True)
    )
    return a, b


def _is_document(given: Any) -> bool:
    return isinstance(given, str | os.PathLike) and Path(given).suffix.lower() == ".fcstd"


def page_of(
    document: str | os.PathLike[str],
    page: str,
    tolerance_mm: float,
    choice: Choice | None = None,
    progress: Progress | None = None,
) -> DrawnPage:
    """A page of a document, or one view of it, drawn to be compared: as of `with_pages`."""
    known = {name for pair in page_names(document) for name in pair}
    whole, mark, view = (page, "", "") if page in known else page.rpartition("/")
    accuracy = min(DEFAULT_ACCURACY, ACCURACY_SHARE * tolerance_mm)
    options = (choice or Choice()).options(accuracy=accuracy, details=True)
    ((drawing, placed),) = pages_with_views(document, [whole if mark else page], options, progress)
    shown = DrawnPage(drawing, {each.view.name: _behind(each) for each in placed if not each.cut})
    return one_view(shown, view) if mark else shown


def _behind(view: PlacedView) -> Behind:
    return Behind(view.source, view.drawing, view.matrix, view.shift)


def one_view(page: DrawnPage, name: str) -> DrawnPage:
    """The lines of one view of a page alone. Raises OptionError where there is no such view."""
    drawing = page.drawing
    views = drawing.sheet.views if drawing.sheet is not None else ()
    view = next((each for each in views if name in (each.name, each.label)), None)
    if view is None:
        known = ", ".join(f'"{each.name}"' for each in views)
        raise OptionError(f'page "{drawing.view.name}" has no view "{name}" that is drawn: it has {known or "none"}')
    own = [part.name.startswith(f"{view.name}/") for part in drawing.parts]
    lines = tuple(line for line in drawing.lines if own[line.part])
    shown = replace(drawing.view, name=f"{drawing.view.name}/{view.name}")
    alone = replace(drawing, lines=lines, view=shown, sheet=Sheet((), ""))
    return DrawnPage(alone, {each: behind for each, behind in page.behind.items() if each == view.name})
