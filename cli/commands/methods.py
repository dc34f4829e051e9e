"""`hlr methods`: time the visible-surface methods side by side."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from hlr.request.defaults import METHODS_LIMIT_S, METHODS_SIZE

from ..guard import start
from ..meter import meter
from ..outputs import in_folder, place
from ..parameters import Number, OutputName, Pixels, ViewName, Whole
from ..streams import result_only
from ..telling import tell_written
from ..verb import Verb
from ..view_options import CHOICE, TIME_LIMIT, options

if TYPE_CHECKING:
    from hlr.request.options import View


@click.command(cls=Verb)
@click.argument("source", required=False)
@click.option(
    "-o",
    "--output",
    type=OutputName(),
    metavar="DIR",
    help="A folder for methods.csv, methods.md and the plot methods.png.",
)
@options(*CHOICE)
@click.option(
    "--size",
    type=Pixels(),
    metavar="WxH",
    default=Pixels.text(METHODS_SIZE),
    help=f"Pixels. Default: {Pixels.text(METHODS_SIZE)}.",
)
@click.option(
    "--polygons",
    "counts",
    type=Whole(1),
    metavar="N",
    multiple=True,
    help="Polygons of a scene; may be repeated. Default without SOURCE: 100, 250, 550, 2500, 8000, 60000 and 1000000.",
)
@click.option(
    "--crossing",
    type=Whole(1),
    metavar="N",
    multiple=True,
    help="Polygons of a scene in which they pass through one another; may be repeated. Default without SOURCE: 100, "
    "2500 and 60000.",
)
@click.option(
    "--method",
    "methods",
    metavar="NAME",
    multiple=True,
    help='Only this method or variant: "scan-line z-buffer, per polygon", "ray casting, flat"; may be repeated.',
)
@click.option("--view", type=ViewName(), metavar="NAME|X,Y,Z", default="iso", help="View of SOURCE. Default: iso.")
@click.option(
    "--limit",
    type=Number(0.0, above=True),
    metavar="S",
    default=METHODS_LIMIT_S,
    help=f"Processor time for each method and scene, in seconds. Default: {METHODS_LIMIT_S:g}.",
)
@TIME_LIMIT
@click.option("-q", "--quiet", is_flag=True, help="No progress on the terminal.")
def methods(  # noqa: PLR0913 - one for each option of the command
    *,
    source: str | None,
    output: str | None,
    size: tuple[int, int],
    counts: tuple[int, ...],
    crossing: tuple[int, ...],
    methods: tuple[str, ...],
    view: View,
    limit: float,
    time_limit: float | None,
    quiet: bool,
    **chosen: Any,
) -> None:
    """Time the visible-surface methods on SOURCE, or on scenes of many polygons, or on both.

    \b
      hlr methods
      hlr methods part.step
      hlr methods part.step --polygons 100 --limit 2 -o figures
    """
    targets = [] if output is None else in_folder(output, ("methods.csv", "methods.md", "methods.png"))
    start(source or "methods", time_limit, coarser="")
    with result_only() as out:
        with meter(quiet) as progress:
            from hlr.lab.methods import report
            from hlr.lab.methods.comparison import compare_methods

            # With a choice of scenes only those are measured; a model is a choice as well.
            some = bool(counts or crossing or source)
            found = compare_methods(
                source,
                counts=counts if some else None,
                crossing=crossing if some else (100, 2_500, 60_000),
                view=view,
                size=size,
                limit=limit,
                methods=methods,
                progress=progress,
                **chosen,
            )
        out.show(report.text(found).splitlines())
        if targets:
            from hlr.lab.methods.plot import png

            csv, md, plot = targets
            place(
                [
                    (csv, report.comma_separated(found).encode("utf-8")),
                    (md, report.markdown(found).encode("utf-8")),
                    (plot, png(found, size)),
                ]
            )
    if targets:
        tell_written(", ".join(str(target) for target in targets), quiet)
