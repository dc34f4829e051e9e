"""`hlr draw`: a model in, drawings out."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from hlr.errors import OptionError, SourceError, StrictError

from ..exits import warn
from ..guard import start
from ..meter import meter
from ..outputs import STDOUT, plan
from ..parameters import Duration, Scale, Size, Vector3
from ..signals import tidily
from ..streams import Output, result_only
from ..view_options import CAMERA, CARE, RUN, VIEW, names_of, options, perspective_of

if TYPE_CHECKING:
    from hlr.drawing import Drawing
    from hlr.plan.options import Options

    from ..meter import Progress


LINES = (
    click.option("--hidden/--no-hidden", default=True, help="Hidden lines, dashed. Default: on."),
    click.option("--smooth", is_flag=True, help="Also tangent edges, thin."),
    click.option("--seam", is_flag=True, help="Also the seams of closed surfaces."),
    click.option(
        "--intersections/--no-intersections",
        default=True,
        help="Lines where surfaces pass through each other. Default: on.",
    ),
    click.option("--fill", is_flag=True, help="Paint the visible faces under the lines, in SVG and PDF."),
)
"""What is drawn."""


@click.command()
@click.argument("source")
@click.option(
    "-o",
    "--output",
    metavar="FILE",
    help="Where to write: .svg, .pdf or .json; - for standard output. {stem}, {view} and {n} stand for the source, "
    "the view and its number. Default: {stem}.svg in this folder.",
)
@VIEW
@options(*LINES)
@click.option("--scale", type=Scale(), metavar="1:2|0.5|2", help="Paper to model. Default: 1:1.")
@click.option("--fit", type=Size(), metavar="WxH", help="Instead of a scale: fit into so many millimetres.")
@click.option(
    "--circles",
    is_flag=True,
    help="Meshes: rims become circles where all their vertices lie on one, less than the crease angle apart.",
)
@options(*CARE)
@click.option(
    "--within",
    type=Duration(),
    metavar="TIME",
    help="Draw coarsely first, then finer while time lasts: 2s, 500ms, 1min. Not finer than --accuracy.",
)
@click.option("--report", is_flag=True, help="Measure what accuracy was reached; takes longer than the drawing.")
@options(*CAMERA, *RUN)
@click.option("--format", type=click.Choice(["svg", "pdf", "json"]), help="Format, where the name does not say it.")
@click.option("--explain", is_flag=True, help="Say what the scene and the request called for, why, and what it cost.")
@click.option("--json", "as_json", is_flag=True, help="Print a summary for machines.")
@click.option("-q", "--quiet", is_flag=True, help="No progress and no summary on the terminal.")
def draw(
    *,
    source: str,
    output: str | None,
    views: tuple[str | Vector3, ...],
    format: str | None,
    explain: bool,
    as_json: bool,
    quiet: bool,
    **wishes: Any,
) -> None:
    """Draw SOURCE with its visible and hidden lines.

    \b
      hlr draw part.step -o part.svg
      hlr draw part.step -o "{stem}-{view}.pdf" --view front --view top --view right
      hlr draw part.stl --view -1,1,1 --scale 1:2 -o - > part.svg

    A CadQuery or build123d script is run to get its model.
    """
    started = time.perf_counter() - time.process_time()  # what loading has taken counts as well
    views = views or ("iso",)
    request = request_of(**wishes)
    targets = _targets(output, source, names_of(views), format, as_json)
    if request.fill and any(kind == "json" for _, kind in targets):
        raise OptionError("--fill paints SVG and PDF; JSON holds lines only")

    start(source)
    # While anything runs that is not ours, standard output is out of its reach.
    with result_only() as out:
        with meter(quiet) as progress:
            import hlr

            if request.within is None:
                drawings = hlr.draw_views(source, list(views), request, progress=progress)
            else:
                drawings = _within(source, list(views), request, progress, targets, out, started)
        _warn(drawings, request.strict)
        if request.within is None or (request.report and targets[0][0] is not None):
            _write(drawings, targets, out.put)
        if request.report:
            _report(drawings)
        if explain:
            _explain(drawings)
        if as_json:
            out.put(_summary(drawings, targets))
    if not quiet and sys.stderr is not None and sys.stderr.isatty():
        for drawing, (path, _) in zip(drawings, targets, strict=True):
            _tell(drawing, path)


def request_of(
    *,
    scale: float | None,
    fit: tuple[float, float] | None,
    perspective: bool,
    eye: Vector3 | None,
    target: Vector3 | None,
    fov: float | None,
    **others: Any,
) -> Options:
    """The options of the command line as a request. Raises OptionError where they contradict one another."""
    from hlr.plan.options import Options

    if scale is not None and fit is not None:
        raise OptionError("--scale and --fit contradict one another; give one of them")
    camera = perspective_of(perspective, eye, target, fov)
    return Options(scale=1.0 if scale is None else scale, fit=fit, perspective=camera, **others)


def _targets(
    output: str | None, source: str, names: list[str], format: str | None, as_json: bool
) -> list[tuple[Path | None, str]]:
    """Path (None: standard output) and format of each view. What cannot be written is refused before any work."""
    from hlr.writers import files, format_of

    if output == STDOUT:
        if len(names) > 1:
            raise OptionError("standard output takes one view; write several views to files with {view} in the name")
        if as_json:
            raise OptionError("--json and -o - both want standard output; write the drawing to a file")
        return [(None, format or "svg")]
    if Path(source).is_dir():  # "." has no stem to name an output after
        raise SourceError(f"{source} is a folder: name a model file in it.")
    paths = plan(output, source, names, format)
    for path in paths:
        files.check(path)
    return [(path, format or format_of(path)) for path in paths]


def _within(
    source: str,
    views: list[str | Vector3],
    request: Options,
    progress: Progress,
    targets: list[tuple[Path | None, str]],
    out: Output,
    started: float,
) -> list[Drawing]:
    """Each finished drawing is written at once, so that the last one stays, however the process ends."""
    from contextlib import ExitStack

    from hlr.drawings import with_report
    from hlr.source import open_source
    from hlr.within import draw_within

    with ExitStack() as stack:
        # What is measured afterwards is written again, with what was reached; standard output takes only one.
        put: Callable[[bytes], None] = out.put
        if targets[0][0] is None:
            from ..keeper import kept

            put = stack.enter_context(kept(out))

        def finished(drawings: list[Drawing]) -> None:
            if request.strict and any(drawing.notes for drawing in drawings):
                return
            _write(drawings, targets, put)

        opened = open_source(source)
        drawings = draw_within(opened, views, request, progress, finished, started)
        if request.report:
            drawings = [with_report(opened, drawing, progress) for drawing in drawings]
            if targets[0][0] is None:
                _write(drawings, targets, put)
    return drawings


def _warn(drawings: list[Drawing], strict: bool) -> None:
    """Each warning once, though every view has met it."""
    notes = list(dict.fromkeys(note for drawing in drawings for note in drawing.notes))
    if strict and notes:
        more = f" (and {len(notes) - 1} more)" if len(notes) > 1 else ""
        raise StrictError(f"{notes[0]}{more}; nothing is written, because of --strict")
    for note in notes:
        warn(str(note))


def _write(drawings: list[Drawing], targets: list[tuple[Path | None, str]], put: Callable[[bytes], None]) -> None:
    """All files or none."""
    from hlr.writers import files, note_time, render

    made: dict[Path, bytes] = {}
    for drawing, (path, format) in zip(drawings, targets, strict=True):
        begin = time.perf_counter()
        data = render(drawing, format)
        if path is None:
            put(data)
        else:
            made[path] = data
        note_time(drawing, time.perf_counter() - begin)
    with tidily():
        files.place(made)


def _report(drawings: list[Drawing]) -> None:
    """What was asked and what was reached, for people."""
    from hlr.measure.table import table

    for drawing in drawings:
        click.echo(table(drawing), err=True)


def _summary(drawings: list[Drawing], targets: list[tuple[Path | None, str]]) -> bytes:
    """What was drawn, as JSON."""
    import json

    entries = [
        {
            "file": str(path),
            "format": format,
            "source": drawing.source,
            "view": drawing.view.name,
            "scale": drawing.scale,
            "accuracy": dict(drawing.accuracy),
            "lines": _counts(drawing),
            "notes": [note.as_dict() for note in drawing.notes],
            "plan": [decision.as_dict() for decision in drawing.plan],
            "counters": dict(drawing.counters),
            "timings": dict(drawing.timings)
            | {"effects": {d.name: d.seconds for d in drawing.plan if d.seconds is not None}},
        }
        for drawing, (path, format) in zip(drawings, targets, strict=True)
    ]
    # Counters may be numbers of NumPy.
    return json.dumps({"drawings": entries}, indent=2, default=lambda value: value.tolist()).encode("ascii") + b"\n"


def _explain(drawings: list[Drawing]) -> None:
    """The table of effects, on standard error."""
    from hlr.plan.effect import explained

    for drawing in drawings:
        if len(drawings) > 1:
            click.echo(drawing.view.name, err=True)
        click.echo(explained(drawing.plan), err=True)


def _counts(drawing: Drawing) -> dict[str, int]:
    visible = sum(line.visible for line in drawing.lines)
    return {"visible": visible, "hidden": len(drawing.lines) - visible}


def _tell(drawing: Drawing, path: Path | None) -> None:
    """One line for people."""
    from hlr.writers.style import ratio

    counts = _counts(drawing)
    seconds = drawing.timings.get("total", 0.0)
    where = "standard output" if path is None else str(path)
    reached = f", accuracy {float(drawing.accuracy['used']):.3g} mm" if "within" in drawing.accuracy else ""
    click.echo(
        f"{where}: {drawing.view.name}, {ratio(drawing.scale)}, {counts['visible']} visible and "
        f"{counts['hidden']} hidden lines{reached}, {seconds:.1f} s",
        err=True,
    )
