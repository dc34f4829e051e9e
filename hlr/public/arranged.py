"""`hlr.draw_arranged`: several views on one page, by the first-angle or the third-angle method."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal, cast

from hlr.common.keywords import expect_record
from hlr.common.threads import at_most
from hlr.drawing.drawing import Drawing
from hlr.errors import OptionError
from hlr.pipeline.arranged import draw_on_one_page
from hlr.request.check import checked
from hlr.request.options import Options, View
from hlr.tables.entry import listed
from hlr.tables.projection_methods import PROJECTION_METHODS

if TYPE_CHECKING:
    from hlr.common.types import Progress

OF_ONE_VIEW = ("fit", "window", "up", "perspective", "fill", "report", "within")
"""Options that say something of a single view."""

Method = Literal["first-angle", "third-angle"]


def draw_arranged(
    source: Any,
    method: Method = "first-angle",
    views: Sequence[View] | None = None,
    options: Options | None = None,
    progress: Progress | None = None,
) -> Drawing:
    """Several views on one page, at one scale and in line with one another.

    source    as of `hlr.draw`
    method    "first-angle" (Europe, Asia) or "third-angle" (America): on which side of the front view the others lie
    views     names or directions; None: front, top, left (first-angle) or right (third-angle), and iso. Pictorial views
              lie in a corner that is free
    options   as of `hlr.draw`, without fit, window, up, perspective, fill, report and within; None: the defaults. The
              scale is the largest standard one at which all views fit the page, unless one is given
    progress  as of `hlr.draw`

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
    options = checked(expect_record(Options, options, "draw_arranged"))
    check_arranged(options)
    if views is not None and not views:
        raise OptionError("a page needs a view: give one, or None for the usual ones")
    with at_most(options.threads):
        chosen = cast("Sequence[View]", row.usual) if views is None else views
        return draw_on_one_page(source, chosen, row, options, progress)


def check_arranged(options: Options) -> None:
    """Raise OptionError for options that say something of a single view."""
    usual = Options()
    if barred := [name for name in OF_ONE_VIEW if getattr(options, name) != getattr(usual, name)]:
        what = f"option{'s' if len(barred) > 1 else ''} {listed(barred, 'and')}"
        raise OptionError(f"the views of a page have one scale and stand in line: leave out the {what}")
