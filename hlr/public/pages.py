"""`hlr.draw_pages`: the TechDraw pages of a FreeCAD document, drawn without FreeCAD."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack

from hlr.common.keywords import expect_record, shown
from hlr.common.threads import at_most
from hlr.drawing.drawing import Drawing
from hlr.errors import OptionError, SourceError
from hlr.pipeline.page.page import drawn_page, part_of
from hlr.pipeline.page.placed_view import PlacedView
from hlr.pipeline.page.sources import Sources
from hlr.pipeline.session import refuse_warnings
from hlr.request.check import checked
from hlr.request.options import Options, Wishes
from hlr.source.file_checks import check_readable
from hlr.source.freecad.fcstd import opened_document
from hlr.source.freecad.pages import DocumentPage, pages_of
from hlr.tables.entry import listed

if TYPE_CHECKING:
    from hlr.common.types import Progress

FREE = {"accuracy", "crease", "details", "intersections", "strict", "style", "threads"}
"""Options that a page leaves open; all others are said by its views."""


def page_names(source: str | os.PathLike[str]) -> list[tuple[str, str]]:
    """Name and label of each page of a FreeCAD document.

    Raises SourceError where it cannot be read.
    """
    path = _path(source)
    with opened_document(path) as document:
        return [(page.name, page.label) for page in pages_of(document, path)]


@shown(Options)
def draw_pages(
    source: str | os.PathLike[str],
    pages: Sequence[str] | None = None,
    options: Options | None = None,
    progress: Progress | None = None,
    **wishes: Unpack[Wishes],
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
    asked = expect_record(Options, options, "draw_pages", wishes)
    return [drawing for drawing, _ in pages_with_views(source, pages, asked, progress)]


def pages_with_views(
    source: str | os.PathLike[str],
    pages: Sequence[str] | None = None,
    options: Options | None = None,
    progress: Progress | None = None,
) -> list[tuple[Drawing, list[PlacedView]]]:
    """The same, each with its views as they were drawn."""
    options = _page_options(expect_record(Options, options, "draw_pages"))
    path = _path(source)
    with at_most(options.threads), opened_document(path) as document:
        wanted = _chosen(pages_of(document, path), pages, path)
        sources = Sources(document, path)
        found, refused = [], []
        for number, page in enumerate(wanted):
            told = None if progress is None else part_of(progress, number, len(wanted))
            drawing, views, errors = drawn_page(page, sources, options, told)
            found.append((drawing, views))
            refused += errors
    if refused and not any(views for _, views in found):
        # Sheets with nothing but their frames are no drawings.
        raise refused[0]
    for drawing, _ in found:
        if options.strict:
            refuse_warnings(drawing.notes)
    return found


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
        what = listed([f"`{name}`" for name in barred], "and")
        raise OptionError(f"a page of a document is drawn as it is: leave out {what}")
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
