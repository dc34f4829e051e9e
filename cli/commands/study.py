"""`hlr study`: measure what accuracy costs on one model, and compare with other programs."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from hlr.errors import OptionError, SourceError
from hlr.request.defaults import STUDY_LIMIT_S, STUDY_RUNS
from hlr.tables.sheets import papers

from ..guard import without_worker
from ..meter import meter
from ..outputs import Target, in_folder, place
from ..parameters import Number, OutputName, Scale, Size, ViewName, Whole
from ..signals import Stopped, tidily
from ..telling import tell_written
from ..verb import Verb
from ..view_options import CHOICE, options

if TYPE_CHECKING:
    from hlr.lab.study.sweep import Study
    from hlr.request.options import View

FILES = ("study.csv", "study.md", "error.png", "stages.png", "arithmetic.csv")

_MILLIMETRES = Number(0.0, above=True)


@click.command(cls=Verb)
@click.argument("source")
@click.option(
    "-o",
    "--output",
    type=OutputName(),
    metavar="DIR",
    required=True,
    help="A folder for study.md, its tables and its plots.",
)
@click.option("--view", type=ViewName(), metavar="NAME|X,Y,Z", default="iso", help="Default: iso.")
@options(*CHOICE)
@click.option("--scale", type=Scale(), metavar="1:2|0.5|2", help="Paper to model.")
@click.option("--fit", type=Size(), metavar="WxH|A4", help="Size in millimetres, or a sheet. Default: A4-landscape.")
@click.option(
    "--accuracy",
    "accuracies",
    type=_MILLIMETRES,
    metavar="MM",
    multiple=True,
    help="May be repeated. Default: 2 to 0.0005 in steps of 1-2-5.",
)
@click.option(
    "--pixels",
    type=Whole(16, 16384),
    metavar="N",
    multiple=True,
    help="Along the longer side of a depth buffer; may be repeated. Default: 512, 1024, 2048, 4096 and 8192.",
)
@click.option("--rivals/--no-rivals", default=True, help="Compare with OpenCASCADE and a z-buffer. Default: on.")
@click.option(
    "--reached/--no-reached", default=True, help="Measure the errors of each class of line; takes long. Default: on."
)
@click.option(
    "--limit",
    type=_MILLIMETRES,
    metavar="S",
    default=STUDY_LIMIT_S,
    help=f"Processor time for each point in seconds, reading included. Default: {STUDY_LIMIT_S:g}.",
)
@click.option(
    "--runs", type=Whole(1), metavar="N", default=STUDY_RUNS, help=f"Runs of each point. Default: {STUDY_RUNS}."
)
@click.option("-q", "--quiet", is_flag=True, help="No progress on the terminal.")
def study(  # noqa: PLR0913 - one for each option of the command
    *,
    source: str,
    output: str,
    view: View,
    scale: float | None,
    fit: tuple[float, float] | str | None,
    accuracies: tuple[float, ...],
    pixels: tuple[int, ...],
    rivals: bool,
    reached: bool,
    limit: float,
    runs: int,
    quiet: bool,
    **chosen: Any,
) -> None:
    """Measure what accuracy costs on SOURCE, and compare with OpenCASCADE, a z-buffer, and rounding predicates.

    \b
      hlr study part.step -o figures
      hlr study part.step -o figures --accuracy 0.5 --accuracy 0.05 --no-rivals --runs 1

    After Ctrl-C the points that are finished are written.
    """
    targets = {target.name: target for target in in_folder(output, FILES)}
    if scale is not None and fit is not None:
        raise OptionError("--scale and --fit contradict one another; give one of them")
    from hlr.lab.study import plot
    from hlr.lab.study.job import ACCURACIES, PIXELS, PREDICATES
    from hlr.lab.study.sweep import Scope, Study
    from hlr.lab.study.sweep import study as measure
    from hlr.source.file_checks import check_readable

    check_readable(Path(source))
    plot.available()
    scope = Scope(
        accuracies=accuracies or ACCURACIES,
        pixels=pixels or PIXELS,
        predicates=accuracies or PREDICATES,
        rivals=rivals,
        reached=reached,
    )
    found = Study(source, view, limit, runs)
    # Each point runs in a process of its own, and this one writes the result after Ctrl-C.
    without_worker()
    with tidily():
        try:
            with meter(quiet) as progress:
                measure(
                    source,
                    view,
                    scale=scale,
                    fit=papers(fit)[0].room if isinstance(fit, str) else fit,
                    scope=scope,
                    limit=limit,
                    runs=runs,
                    into=found,
                    progress=progress,
                    **chosen,
                )
        except Stopped:
            _write(targets, found)
            raise
        _write(targets, found)
    tell_written(f"{targets['study.md']}: {len(found.points)} points", quiet)


def _write(targets: dict[str, Target], found: Study) -> None:
    """Write all files; none where nothing was measured."""
    from hlr.lab.study import plot, report, table

    if not any(point.failure is None for point in found.points):
        if not found.points:
            return
        why = next((point.failure for point in found.points if point.failure is not None), "no point was finished")
        raise SourceError(f"{found.source} cannot be studied: {why}")
    made = {
        "study.csv": table.comma_separated(found).encode("utf-8"),
        "study.md": report.markdown(found, ("error.png", "stages.png")).encode("utf-8"),
        "error.png": plot.error_plot(found.points, found.look["name"]),
        "stages.png": plot.stage_plot(found.points, found.look["name"]),
    }
    if found.arithmetic:
        made["arithmetic.csv"] = table.arithmetic_csv(found).encode("utf-8")
    place([(targets[name], data) for name, data in made.items()])
