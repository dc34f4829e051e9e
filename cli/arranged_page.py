"""Several views on one page on the command line: `--arrange` of `hlr draw`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from hlr.tables.projection_methods import PROJECTION_METHODS

from .document_pages import left_out_of
from .drawn_files import targets_of, write
from .guard import start
from .meter import meter
from .parameters import FieldText, Window, as_table
from .streams import result_only
from .telling import summary, tell_notes, tell_written, written

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from hlr.public.arranged import Method
    from hlr.request.options import Options, View


ARRANGE = (
    click.option(
        "--arrange",
        type=click.Choice(list(PROJECTION_METHODS)),
        help="All views on one page, in line and at one scale, by this method. Default of --view then: front, top, "
        "left or right, and iso.",
    ),
    click.option(
        "--template",
        metavar="FILE",
        help="--arrange: an SVG with a frame and a title block, printed under the views, such as those of TechDraw.",
    ),
    click.option(
        "--text",
        "texts",
        type=FieldText(),
        metavar="FIELD=TEXT",
        multiple=True,
        callback=as_table,
        help="--template: the text for one of its fields; may be repeated. The scale is filled in.",
    ),
    click.option(
        "--room",
        type=Window(),
        metavar="X0,Y0,X1,Y1",
        help="--arrange: where views may lie, millimetres from the page's lower left corner. Default: what the "
        "template says, or all inside margins of 10 mm.",
    ),
)


def draw_arranged_page(
    source: str,
    outputs: Sequence[str],
    method: Method,
    views: Sequence[View],
    format: str | None,
    request: Options,
    printed: Mapping[str, Any],
    told: Mapping[str, Any],
) -> None:
    """Draw views on one page into files.

    views: none for the usual ones; printed: template, texts and room; told: as_json, quiet and time_limit.

    Raises OptionError where other options contradict the page; else as `hlr.draw_arranged`.
    """
    targets = targets_of(outputs, source, [method], format, told["as_json"])
    start(source, told["time_limit"])
    with result_only() as out:
        with meter(told["quiet"]) as progress:
            import hlr

            drawing = hlr.draw_arranged(source, method, list(views) or None, request, progress, **printed)
        tell_notes([*left_out_of([drawing], targets), *drawing.notes], request.strict, told["quiet"])
        (drawing,) = write([drawing], targets, out.put)
        if told["as_json"]:
            out.put(summary([drawing], targets))
    tell_written(written(drawing, targets[0]), told["quiet"])
