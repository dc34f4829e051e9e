"""`hlr.draw` and `hlr.draw_views`: one pass of the pipeline, or as many as fit into a time, and a report on request."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from time import perf_counter
from typing import TYPE_CHECKING, Any, Unpack

from hlr.common.keywords import expect_record, record_of, shown
from hlr.common.threads import at_most
from hlr.errors import OptionError
from hlr.pipeline.draw import draw_views as drawn_once
from hlr.request.check import checked, checked_views
from hlr.request.options import Options, View, Wishes
from hlr.source.selection import open_selected

if TYPE_CHECKING:
    from hlr.common.types import Progress
    from hlr.drawing.drawing import Drawing
    from hlr.drawing.notes import Noted


@shown(Options)
def draw_views(
    source: Any,
    views: Sequence[View],
    options: Options | None = None,
    progress: Progress | None = None,
    noted: Noted | None = None,
    **wishes: Unpack[Wishes],
) -> list[Drawing]:
    """One drawing per view, or per section of a view that several planes cut; the source is read and meshed once.

    source    as of `draw`
    views     names or directions, as of `draw`
    options   what is asked for; None: the keywords, which are its fields, and else the defaults
    progress  as of `draw`
    noted     called with the notes on the size of the views as soon as it is known, before the work begins

    Raises SourceError, ViewError, OptionError; with options.strict StrictError for any warning.

    >>> import hlr
    >>> front, top = hlr.draw_views("part.step", ["front", "top"], hlr.Options(scale=0.5))
    >>> top
    <Drawing part.step, top, 1:2, 5 visible and 0 hidden lines>
    """
    options = expect_record(Options, options, "draw_views", wishes)
    if not options.report and options.within is None:
        return drawn_once(source, views, options, progress, noted)  # which checks what is asked for
    started = perf_counter()
    options = checked(options)
    views = checked_views(views, options)
    with at_most(options.threads):
        opened = open_selected(source, options)
        if options.within is None:
            drawings = drawn_once(opened, views, options, progress, noted)
        else:
            from hlr.pipeline.within import draw_within

            drawings = draw_within(opened, views, options, progress, started=started, noted=noted)
        return [with_report(opened, drawing, progress) for drawing in drawings] if options.report else drawings


@shown(Options)
def draw(source: Any, view: View = "iso", *, progress: Progress | None = None, **options: Unpack[Wishes]) -> Drawing:
    """One view of a source; the keywords are the fields of `Options`.

    source    the path of a file or a script; a CadQuery, build123d, OpenCASCADE, trimesh or manifold3d object; a pair
              of arrays: vertices (n, 3) and faces (m, 3) that index them; or a list of CAD objects or of meshes, or a
              dict that gives them names
    view      a name such as "iso" or "front", or a direction (x, y, z) from the object toward the viewer
    progress  called with the name of each stage and the fraction done, 0 to 1

    Raises SourceError for what cannot be read, ViewError for a view that does not exist, OptionError for an option out
    of its range; with strict=True StrictError for any warning.

    >>> import hlr
    >>> drawing = hlr.draw("part.step", view="front")
    >>> drawing
    <Drawing part.step, front, 5:1, 4 visible and 2 hidden lines>
    >>> drawing.save("part.svg").name
    'part.svg'

    Without a scale the drawing goes on a sheet, A4 unless `page` names another, at the largest standard scale that
    fits. With one it is as large as that makes it:

    >>> hlr.draw("part.step", view="front", scale=0.5).bounds
    Bounds(x0=0.0, y0=0.0, x1=15.0, y1=5.0)

    A bare triangle, as arrays, seen from above:

    >>> triangle = ([(0, 0, 0), (30, 0, 0), (0, 20, 0)], [(0, 1, 2)])
    >>> hlr.draw(triangle, view=(0, 0, 1), scale=1).bounds
    Bounds(x0=0.0, y0=0.0, x1=30.0, y1=20.0)

    Every error says what is wrong, in one sentence:

    >>> hlr.draw("part.step", scale=-1)
    Traceback (most recent call last):
    hlr.errors.OptionError: scale -1 cannot be drawn: give a positive number or a ratio, 0.5 or 1:2.
    """
    asked = record_of(Options, options, "draw")
    if asked.section is not None:
        from hlr.request.section import by_view, checked_section

        if asked.whole or len(by_view(checked_section(asked.section)) or ()) > 1:
            what = "a view and its sections" if asked.whole else "several sections"
            raise OptionError(f"one drawing is cut once: draw {what} with draw_views, or draw_arranged")
    return draw_views(source, [view], asked, progress)[0]


def with_report(source: Any, drawing: Drawing, progress: Progress | None = None) -> Drawing:
    """The drawing with `reached`, measured; of a window, what the whole drawing reached."""
    from hlr.lab.measure import measured

    if progress is not None:
        progress("measure", 0.0)
    threads = drawing.request.options.threads if drawing.request is not None else 0
    whole = drawing
    if drawing.window is not None and drawing.request is not None:
        # What lies outside the window is no loss: the drawing is measured before anything was cut off.
        asked = replace(drawing.request.options, window=None, within=None, accuracy=drawing.accuracy.used)
        whole = drawn_once(source, [drawing.request.view], asked)[0]
    with at_most(threads):
        reached = measured(source, whole)
    return replace(drawing, reached=reached)
