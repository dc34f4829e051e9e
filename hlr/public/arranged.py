"""`hlr.draw_arranged`: several views on one page, by the first-angle or the third-angle method."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Unpack, cast

from hlr.common.keywords import expect_record, shown
from hlr.common.numbers import is_finite, typed_value
from hlr.common.threads import at_most
from hlr.drawing.drawing import Drawing
from hlr.errors import OptionError, ViewError
from hlr.pipeline.arranged import Printed, draw_on_one_page
from hlr.request.check import checked
from hlr.request.options import Options, View, Wishes
from hlr.request.style import Style
from hlr.source.page_template import Rectangle, read_page_template
from hlr.tables.entry import listed
from hlr.tables.projection_methods import PROJECTION_METHODS

if TYPE_CHECKING:
    from hlr.common.types import Progress

OF_ONE_VIEW = ("fit", "window", "up", "perspective", "fill", "report", "within")
"""Options that say something of a single view."""

_CORNERS = 4
"""Coordinates of the two corners of a rectangle."""

Method = Literal["first-angle", "third-angle"]


@shown(Options)
def draw_arranged(
    source: Any,
    method: Method = "first-angle",
    views: Sequence[View] | None = None,
    options: Options | None = None,
    progress: Progress | None = None,
    *,
    template: str | os.PathLike[str] | None = None,
    texts: Mapping[str, str] | None = None,
    room: Rectangle | None = None,
    **wishes: Unpack[Wishes],
) -> Drawing:
    """Several views on one page, at one scale and in line with one another.

    source    as of `hlr.draw`
    method    "first-angle" (Europe, Asia) or "third-angle" (America): on which side of the front view the others lie
    views     names or directions; None: front, top, left (first-angle) or right (third-angle), iso, and those that are
              cut. Other views lie in a cell that is free
    options   as of `hlr.draw`, without fit, window, up, perspective, fill, report and within; None: the keywords, or
              the defaults. The scale is the largest standard one at which all views fit the page, unless one is given.
              Sections are said by their views, {"front": True}, or as pairs, [("left", 10), ("left", 40)], where
              several planes cut a view: the first lies in its place, the others beside it or in other free cells,
              called left-B and so on. Each has its name, A-A, above it, with letters in the order of `section`, and in
              a view that sees its plane from the edge a cutting line with arrows and letters
    progress  as of `hlr.draw`
    template  an SVG with a frame and a title block, such as those of FreeCAD's TechDraw; it says how large the page is,
              and is printed under the views. None: the symbol of the method in the lower right corner
    texts     for the fields of the template, by their keys. A field for the scale is filled in
    room      (x0, y0, x1, y1), millimetres from the lower left corner of the page: where views may lie. None: what the
              template says (`hlr.source.page_template`), or all but margins of 10 mm

    The parts of a view are called by it: front/bolt.

    Raises SourceError, ViewError, OptionError; with options.strict StrictError for any warning.

    >>> import hlr
    >>> page = hlr.draw_arranged("part.step", "third-angle")
    >>> page
    <Drawing part.step, third-angle, 2:1, 23 visible and 4 hidden lines>
    >>> [(view.name, view.scale) for view in page.sheet.views]
    [('front', 2.0), ('top', 2.0), ('right', 2.0), ('iso', 2.0)]
    """
    row = PROJECTION_METHODS.get(method) if isinstance(method, str) else None
    if row is None:
        raise OptionError(f"no method is called {method!r}: give {listed(PROJECTION_METHODS, 'or')}")
    options = checked(expect_record(Options, options, "draw_arranged", wishes))
    check_arranged(options)
    chosen = cast("Sequence[View]", row.usual) if views is None else _listed(views)
    printed = _printed(template, {} if texts is None else texts, room, options)
    with at_most(options.threads):
        if views is None and options.section is not None:
            from hlr.request.section import by_view, with_sections

            chosen = with_sections(chosen, by_view(options.section) or ())
        return draw_on_one_page(source, chosen, row, options, printed, progress)


def _listed(views: Any) -> list[View]:
    """The views that are given; a single name is one. Raises ViewError for no list, OptionError for an empty one."""
    if isinstance(views, str):
        return [cast("View", views)]
    try:
        found: list[View] = list(views)
    except TypeError:
        raise ViewError(f"{views!r} is no list of views: give names such as 'iso', or directions") from None
    if not found:
        raise OptionError("a page needs a view: give one, or None for the usual ones")
    return found


def _printed(
    template: str | os.PathLike[str] | None, texts: Mapping[str, str], room: Rectangle | None, options: Options
) -> Printed:
    """What is on the page besides its views, checked."""
    if room is not None:
        check_room(room)
    if not isinstance(texts, Mapping):
        raise OptionError(f"texts are needed by the keys of fields, such as {{'TITLE': 'Bracket'}}, not {texts!r}")
    if template is None:
        if texts:
            raise OptionError("`texts` is for the fields of a template: give `template` as well, or leave it out")
        return Printed(room=room)
    if options.page is not None:
        raise OptionError("a template has a size of its own: leave out `page`, or `template`")
    if not isinstance(template, str | os.PathLike) or not os.fspath(template):
        raise OptionError(f"template needs the name of an SVG file, not {template!r}")
    read = read_page_template(Path(template))
    texts = {str(key): str(text) for key, text in texts.items()}
    read.check(texts)
    return Printed(read, texts, room)


def check_room(room: Any) -> None:
    """Raise OptionError where this is no rectangle on paper."""
    numbers = list(room) if isinstance(room, Sequence) and not isinstance(room, str) else []
    if (
        len(numbers) != _CORNERS
        or not all(map(is_finite, numbers))
        or not (numbers[0] < numbers[2] and numbers[1] < numbers[3])
    ):
        raise OptionError(f"`room` needs two corners in millimetres, such as 20,60,287,200, not {typed_value(room)}")


def check_arranged(options: Options) -> None:
    """Raise OptionError for options that say something of a single view. options: checked"""
    usual = Options()
    if isinstance(options.style, Style) and options.style.part_colors == "fills":
        raise OptionError("arranged views have lines alone: leave out `part_colors`, or let it colour the lines")
    if barred := [name for name in OF_ONE_VIEW if getattr(options, name) != getattr(usual, name)]:
        what = listed([f"`{name}`" for name in barred], "and")
        raise OptionError(f"only a view by itself has {listed(barred, 'or')}: leave out {what}, or `arrange`")
