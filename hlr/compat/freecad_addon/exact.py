"""Exact drawings as pages of a running FreeCAD's document: the drawing is the template of a new page.

So FreeCAD shows, prints and exports it as it is, in millimetres, and lines and texts can be added on top.
"""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from hlr.compat.freecad_addon.flat import flat_svg
from hlr.drawing.drawing import Drawing
from hlr.errors import SourceError
from hlr.pipeline.draw import draw_views
from hlr.public.pages import draw_pages
from hlr.request.options import Options, View

PAGE = "TechDraw::DrawPage"

MADE_OF = "DrawnFrom"
"""Property of the pages that are made here: the names of what they show. Made again, the same page is filled anew."""


def exact_page(page: Any, options: Options | None = None) -> Any:
    """Draw a page of an open document exactly, with its template, into a page beside it.

    page     a TechDraw page, or the name of one in the active document
    options  as of `hlr.draw_pages`

    Returns the new page, or the one that an earlier call has made. The document is not saved; what of the page is not
    drawn is printed to FreeCAD's report view.

    Raises SourceError, OptionError.
    """
    document = page.Document
    with tempfile.TemporaryDirectory(prefix="hlr-freecad-") as folder:
        path = Path(folder) / f"{document.Name}.FCStd"
        document.saveCopy(str(path))
        (drawing,) = draw_pages(path, [page.Name], options)
    return _put(document, drawing, [page], page.Label)


def exact_drawing(objects: Sequence[Any], view: View = "iso", options: Options | None = None) -> Any:
    """Draw objects of an open document exactly, on a new page of it: A4, unless options say another.

    view: as of `hlr.draw`; a direction is from the objects toward the viewer. All else as of `exact_page`.
    """
    things = list(objects)
    if not things:
        raise SourceError("Nothing is selected: select a page, or objects that have shapes.")
    (drawing,) = draw_views(things, [view], options)
    return _put(things[0].Document, drawing, things, ", ".join(thing.Label for thing in things[:3]))


def _put(document: Any, drawing: Drawing, made_of: Sequence[Any], label: str) -> Any:
    """A page of the document with the drawing as its template."""
    names = [thing.Name for thing in made_of]
    page = next((each for each in document.findObjects(PAGE) if getattr(each, MADE_OF, None) == names), None)
    if page is None:
        page = document.addObject(PAGE, "ExactPage")
        page.Label = f"{label}, exact"
        page.addProperty("App::PropertyStringList", MADE_OF, "Exact drawing", "What this page shows")
        setattr(page, MADE_OF, names)
        page.Template = document.addObject("TechDraw::DrawSVGTemplate", "ExactDrawing")
    with tempfile.TemporaryDirectory(prefix="hlr-freecad-") as folder:
        path = Path(folder) / "exact.svg"
        path.write_bytes(flat_svg(drawing.to_svg()))
        page.Template.Template = str(path)
        document.recompute([page.Template, page])
    for note in drawing.notes:
        _say(str(note))
    return page


def _say(text: str) -> None:
    import FreeCAD

    FreeCAD.Console.PrintWarning(f"{text}\n")
