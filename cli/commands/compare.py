"""`hlr compare`: what differs between two drawings."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from hlr.errors import OptionError
from hlr.request.defaults import COMPARE_TOLERANCE_MM
from hlr.tables.readers import is_model, of_ending

from ..guard import possible, start
from ..meter import meter
from ..outputs import Target, check, place
from ..parameters import Number, OutputName, Scale, ViewName
from ..signals import tidily
from ..streams import result_only
from ..verb import Verb
from ..view_options import CHOICE, TIME_LIMIT, options

if TYPE_CHECKING:
    from hlr.compare.compare import Registration
    from hlr.compare.failing import FailOn
    from hlr.request.options import View

DIFFERENT = 1
"""Exit code."""

_MOST_ROWS = 20


@click.command(cls=Verb)
@click.argument("before", metavar="A")
@click.argument("after", metavar="B", required=False)
@click.option(
    "-o", "--output", "outputs", type=OutputName(), metavar="FILE", multiple=True,
    help="Overlay as SVG, PNG or HTML, figures as JSON, by the ending; may be repeated.",
)  # fmt: skip
@click.option(
    "--tolerance",
    type=Number(),
    metavar="MM",
    default=COMPARE_TOLERANCE_MM,
    help=f"How far apart on paper two lines may lie that count as the same. Default: {COMPARE_TOLERANCE_MM:g}.",
)
@click.option(
    "--register",
    type=click.Choice(["auto", "off", "translation", "similarity"]),
    default="auto",
    help="translation: B is first moved to where most of its lines match those of A; similarity: turned by quarters, "
    "mirrored and scaled as well; auto: off for two drawings of hlr, else similarity. Default: auto.",
)
@click.option(
    "--page",
    metavar="NAME[/VIEW]",
    help="The page of a FreeCAD document (.FCStd) that is A or B, by name or label, or one view of it.",
)
@click.option(
    "--view",
    type=ViewName(),
    metavar="NAME|X,Y,Z",
    help="Of the model that is A or B: a name or a direction. Default: the view that the other side states, else the "
    "named one that it shows.",
)
@options(*CHOICE)
@click.option(
    "--scale",
    type=Scale(),
    metavar="1:2|0.5|2",
    help="Paper to model, of a drawing of another program. Default: it is found. With --against: of both drawings; "
    "default: as `hlr draw` puts the view on a page.",
)
@click.option(
    "--against",
    type=click.Choice(["freecad"]),
    help="Compare hlr's drawing of the model A with that of an installed FreeCAD, which is run without its window "
    "and has 120 s, unless --time-limit says otherwise. --view is iso then, if none is given.",
)
@click.option("--coarse", is_flag=True, help="With --against: FreeCAD's coarse view, which is faster.")
@click.option(
    "--fail-on",
    type=click.Choice(["any", "ours", "never"]),
    default="any",
    help="What makes the exit code 1. any: a difference; ours: a difference in which hlr's drawing of the model is "
    "wrong, or for which that could not be told; never: nothing. Default: any.",
)
@TIME_LIMIT
@click.option("-q", "--quiet", is_flag=True, help="Print nothing; the exit code tells.")
def compare(  # noqa: PLR0913 - one for each option of the command
    *,
    before: str,
    after: str | None,
    outputs: tuple[str, ...],
    tolerance: float,
    register: Registration,
    page: str | None,
    view: View | None,
    scale: float | None,
    against: str | None,
    coarse: bool,
    fail_on: FailOn,
    time_limit: float | None,
    quiet: bool,
    **choice: Any,
) -> int:
    """Tell what differs from drawing A to drawing B.

    Each is an SVG, PDF, DXF or JSON file of hlr, or an SVG, PDF or DXF file of FreeCAD and other programs.

    Or it is a model, which is drawn as the other side shows it; of two models both are drawn. Two pages are compared
    view by view; so are a page and a model, where the page is an SVG or JSON file of hlr. Places are told in mm on
    the paper of A.

    \b
      hlr compare old.svg new.svg
      hlr compare old.svg new.svg -o difference.svg --register translation
      hlr compare freecad_view.svg ours.svg -o difference.svg
      hlr compare freecad_view.svg part.step
      hlr compare drawing.dxf part.step --view iso
      hlr compare freecad_page.svg housing.FCStd --page Page
      hlr compare --against freecad part.step --view front --fail-on ours

    Exit codes, as those of diff: 0 the same, 1 different (--fail-on), 2 a file or an option was refused.
    """
    from hlr.compare.failing import fails, who_is_wrong
    from hlr.compare.overlay.table import left_out, rows, view_rows

    if against is not None and (after is not None or page is not None):
        raise OptionError(f"--against {against} compares one model: leave out {'B' if after else '--page'}")
    if against is None and after is None:
        raise OptionError("a comparison needs two drawings: name B, or say --against freecad")
    if against is not None and register != "auto":
        raise OptionError("--register is for two drawings: leave it out, FreeCAD draws elsewhere on paper")
    sides = [before] if after is None else [before, after]
    for side in sides:
        if os.path.isdir(side):
            raise OptionError(
                f"{side} is a folder: name a file in it; to compare all drawings of a folder with new ones, draw their "
                "models with hlr batch MODELS --baseline FOLDER"
            )
    targets = [_target(output) for output in outputs]
    check(targets)
    models = [side for side in sides if is_model(side)]
    if fail_on == "ours" and len(models) != 1:
        raise OptionError(
            "--fail-on ours finds out by a model which drawing is right: name one model, and a drawing of it"
        )
    if models or time_limit is not None:
        # Without a worker, FreeCAD's own process can be ended all the same.
        of_all = time_limit if possible() or against is None else None
        start(_blamed(models or sides), of_all, coarser="ask for a larger --tolerance")
    with result_only() as out:
        with meter(quiet) as progress:
            more: dict[str, Any] = {"tolerance_mm": tolerance, "scale": scale, "progress": progress, **choice}
            if after is None:
                from hlr.compare.freecad import TIME_LIMIT_S, compare_with_freecad

                limit = TIME_LIMIT_S if time_limit is None else time_limit
                with tidily():  # FreeCAD and its folder are gone when a signal ends the command
                    found = compare_with_freecad(before, view or "iso", coarse=coarse, time_limit_s=limit, **more)
            else:
                from hlr.compare import compare as compared

                found = compared(before, after, register=register, page=page, view=view, **more)
        place([(target, found.rendered(f".{target.format}")) for target in targets])
        if not quiet:
            judged = [who_is_wrong(found)] if fail_on == "ours" and not found.same else []
            told = [found.summary, *judged, *view_rows(found), *rows(found, _MOST_ROWS)[:-1], *left_out(found)]
            out.show(told)
    return DIFFERENT if fails(found, fail_on) else 0


def _blamed(sides: list[str]) -> str:
    """The side that is named where the work crashes or takes too long: a script, else the first."""
    readers = ((side, of_ending(Path(side).suffix)) for side in sides)
    return next((side for side, reader in readers if reader is not None and reader.kind == "script"), sides[0])


def _target(output: str) -> Target:
    from hlr.compare.comparison import ending_of

    path = Path(output)
    return Target(path, ending_of(path)[1:])
