"""`hlr draw`: draw a model."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

import click

from hlr.errors import OptionError
from hlr.tables.line_classes import optional
from hlr.tables.writers import WRITERS, formats

from ..arranged_page import ARRANGE, draw_arranged_page
from ..document_pages import draw_document_pages, names_a_page
from ..drawn_files import Targets, targets_of, to_stdout, write
from ..guard import start
from ..meter import meter
from ..parameters import Duration, OutputName, Vector3
from ..section_options import SECTION, names_of_drawings, with_sections
from ..streams import Output, result_only
from ..style_options import STYLE, style_from
from ..telling import of_views, summary, tell_early, tell_notes, tell_plan, tell_report, tell_written, written
from ..verb import Verb
from ..view_options import (
    CAMERA,
    CARE,
    CHOICE,
    CIRCLES,
    RUN,
    SIZE,
    TIME_LIMIT,
    VIEW,
    WINDOW,
    Command,
    options,
    perspective_of,
)

if TYPE_CHECKING:
    from hlr.drawing.drawing import Drawing
    from hlr.drawing.notes import Note, Noted
    from hlr.public.arranged import Method
    from hlr.request.options import Options, View

    from ..meter import Progress


def _asked_for() -> Iterator[Callable[[Command], Command]]:
    """The options that ask for lines of a class, or for none of them."""
    known = set()
    for row in optional():
        if row.option not in known:  # classes may share one
            name = row.option
            known.add(name)
            if row.by_default is False:
                yield click.option(f"--{name}", is_flag=True, help=row.help)
            else:
                yield click.option(f"--{name}/--no-{name}", default=row.by_default, help=row.help)


LINES: tuple[Callable[[Command], Command], ...] = (
    click.option(
        "--hidden/--no-hidden",
        default=None,
        help="Hidden lines, dashed. Default: in views along an axis, such as front; not in sections, nor in pictorial "
        "views, such as iso or in perspective.",
    ),
    *_asked_for(),
    click.option("--see-through", is_flag=True, help="Parts that are transparent in the file hide nothing."),
    click.option("--fill", is_flag=True, help="Paint the visible faces under the lines."),
)
"""What is drawn."""


@click.command(cls=Verb)
@click.argument("source")
@click.option(
    "-o",
    "--output",
    "outputs",
    type=OutputName(),
    metavar="FILE",
    multiple=True,
    help=f"Where to write: {formats('.')}; a folder/; - for standard output. May be repeated. {{stem}}, {{view}} and "
    "{n} stand for the source, the view and its number. Default: {stem}.svg in this folder.",
)
@VIEW
@options(*CHOICE, *LINES, *SECTION)
@options(*SIZE, WINDOW)
@options(*ARRANGE)
@click.option(
    "--all-pages", is_flag=True, help="FreeCAD: draw all TechDraw pages of the document, {view} in file names."
)
@options(CIRCLES)
@click.option("--details", is_flag=True, help="Draw also what is too small or too close together for the pen.")
@options(*CARE)
@click.option(
    "--within",
    type=Duration(),
    metavar="TIME",
    help="Draw coarsely first, then finer while time lasts: 2s, 500ms, 1min. Not finer than --accuracy.",
)
@TIME_LIMIT
@click.option("--report", is_flag=True, help="Measure the accuracy that was reached; takes longer than the drawing.")
@options(*CAMERA, *STYLE, *RUN)
@click.option("--format", type=click.Choice(list(WRITERS)), help="Format, where the name does not say it.")
@click.option("--explain", is_flag=True, help="Print which steps were needed, why, and what they cost.")
@click.option("--json", "as_json", is_flag=True, help="Print a summary as JSON.")
@click.option("-q", "--quiet", is_flag=True, help="No progress and no summary on the terminal.")
def draw(
    *,
    source: str,
    outputs: tuple[str, ...],
    views: tuple[View, ...],
    format: str | None,
    explain: bool,
    as_json: bool,
    quiet: bool,
    all_pages: bool,
    **chosen: Any,
) -> None:
    """Draw SOURCE with its visible and hidden lines.

    \b
      hlr draw part.step -o part.svg
      hlr draw part.step -o "{stem}-{view}.pdf" --view front --view top --view right
      hlr draw part.step -o part.pdf --arrange third-angle
      hlr draw part.step -o part.svg --section front
      hlr draw part.stl --view -1,1,1 --scale 1:2 -o - > part.svg

    A CadQuery or build123d script is run to get its model.
    """
    arrange: Method | None = chosen.pop("arrange")
    printed = {name: chosen.pop(name) for name in ("template", "texts", "room")}
    time_limit = chosen.pop("time_limit")
    sections = chosen["section"]
    chosen["section"] = sections or None
    told = {"as_json": as_json, "quiet": quiet, "time_limit": time_limit}
    if arrange is not None:
        if views:
            views = with_sections(views, sections, chosen["eye"])
        _check_arranged(all_pages or names_a_page(source, chosen["page"]), explain)
        request = request_of(style=style_from(chosen), **chosen)
        draw_arranged_page(source, outputs, arrange, views, format, request, printed, told)
        return
    if all_pages or names_a_page(source, chosen["page"]):
        page = None if all_pages else chosen["page"]
        asked = request_of(style=style_from(chosen), **{**chosen, "page": chosen["page"] if all_pages else None})
        _check_of_page(views, explain)
        draw_document_pages(source, outputs, page, format, asked, told)
        return
    started = time.perf_counter() - time.process_time()  # the time of loading counts as well
    views = with_sections(views, sections, chosen["eye"])
    names = names_of_drawings(views, sections, chosen["whole"], chosen["eye"])
    views = views or ("iso",)
    style = style_from(chosen)
    request = request_of(style=style, **chosen)
    targets = targets_of(outputs, source, names, format, as_json)

    start(source, time_limit)
    # Scripts and libraries may print: meanwhile only the result can reach standard output.
    with result_only() as out:
        with meter(quiet) as progress:
            import hlr

            early: list[Note] = []

            def noted(notes: Sequence[Note]) -> None:
                tell_early(notes, request.strict, quiet)
                early.extend(notes)

            if request.within is None:
                drawings = hlr.draw_views(source, list(views), request, progress=progress, noted=noted)
            else:
                drawings = _within(source, list(views), request, progress, noted, targets, out, started)
        tell_notes(of_views(drawings, early), request.strict, quiet)
        if request.within is None or (request.report and not to_stdout(targets)):
            drawings = write(drawings, targets, out.put)
        if request.report:
            tell_report(drawings)
        if explain:
            tell_plan(drawings)
        if as_json:
            out.put(summary(drawings, targets))
    for drawing, row in zip(drawings, targets, strict=True):
        tell_written(written(drawing, row), quiet)


def _check_arranged(of_document: bool, explain: bool) -> None:
    """Raises OptionError where something is asked for that a page with several views has not."""
    if of_document:
        raise OptionError(
            "a page of a document arranges its own views: leave out --arrange, or give the name of a sheet"
        )
    if explain:
        raise OptionError("each view of a page has steps of its own: leave out --explain, or --arrange")


def _check_of_page(views: tuple[View, ...], explain: bool) -> None:
    """Raises OptionError where something is asked for that a page of a document has not."""
    for name, given in (("--view", bool(views)), ("--explain", explain)):
        if given:
            raise OptionError(f"a page of a document has views of its own: leave out {name}")


def request_of(
    *,
    perspective: bool,
    eye: Vector3 | None,
    target: Vector3 | None,
    fov: float | None,
    **others: Any,
) -> Options:
    """The options of the command line as a request. Raises OptionError where they contradict each other."""
    from hlr.request.options import Options

    if others["scale"] is not None and others["fit"] is not None:
        raise OptionError("--scale and --fit contradict one another; give one of them")
    return Options(perspective=perspective_of(perspective, eye, target, fov), **others)


def _within(
    source: str,
    views: list[View],
    request: Options,
    progress: Progress,
    noted: Noted,
    targets: Targets,
    out: Output,
    started: float,
) -> list[Drawing]:
    """Draw within a time. Each finished drawing is written at once: the last one stays however the process ends."""
    from contextlib import ExitStack

    from hlr.pipeline.within import draw_within
    from hlr.public.draw import with_report
    from hlr.request.check import checked, checked_views
    from hlr.source.selection import open_selected

    with ExitStack() as stack:
        # With --report the drawing is written once more, with its measure; standard output takes only one drawing.
        put: Callable[[bytes], None] = out.put
        if to_stdout(targets):
            from ..keeper import kept

            put = stack.enter_context(kept(out))

        done: list[Drawing] = []

        def finished(drawings: list[Drawing]) -> None:
            if request.strict and any(note.is_warning for drawing in drawings for note in drawing.notes):
                return
            done[:] = write(drawings, targets, put)

        asked = checked_views(views, checked(request))
        opened = open_selected(source, request)
        drawings = draw_within(opened, asked, request, progress, finished, started, noted)
        drawings = done or drawings
        if request.report:
            drawings = [with_report(opened, drawing, progress) for drawing in drawings]
            if to_stdout(targets):
                write(drawings, targets, put)
    return drawings
