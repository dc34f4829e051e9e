"""Options that several commands share: parts, view, camera, scale, accuracy, threads."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import click

from hlr.errors import OptionError
from hlr.request.accuracy import DEFAULT_ACCURACY
from hlr.request.concerns import OF_SOURCES
from hlr.request.defaults import CREASE
from hlr.request.directions import EYE, NAMED

from .parameters import (
    Duration,
    Number,
    Scale,
    ScriptParameter,
    Size,
    Vector,
    Vector3,
    ViewName,
    Whole,
    Window,
    as_table,
)

if TYPE_CHECKING:
    from hlr.request.options import Perspective, View

Command = Callable[..., Any]

VIEW = click.option(
    "--view",
    "views",
    type=ViewName(),
    metavar="NAME|X,Y,Z",
    multiple=True,
    help=f"{', '.join(NAMED)}, or a direction toward the viewer. May be repeated. Default: iso.",
)

SIZE = (
    click.option(
        "--page",
        metavar="A4|WxH",
        help="A sheet: A0 to A6, letter, legal or tabloid, with -landscape or -portrait; or its size in millimetres. "
        "Without --scale the drawing gets the largest standard scale that fits inside margins of 10 mm. Default: A4. "
        "FreeCAD: also the name of a TechDraw page of the document, which is drawn.",
    ),
    click.option(
        "--scale",
        type=Scale(),
        metavar="1:2|0.5|2",
        help="Paper to model. Without --page the page is as large as the drawing.",
    ),
    click.option(
        "--fit",
        type=Size(),
        metavar="WxH|A4",
        help="Instead of a scale: as large as fits into a size in millimetres, or as fills a sheet: A4, A4-landscape.",
    ),
    click.option("--same-scale", is_flag=True, help="All views have one scale: the smallest that one of them needs."),
)

WINDOW = click.option(
    "--window",
    type=Window(),
    metavar="X0,Y0,X1,Y1",
    help="Only this rectangle of the drawing, millimetres from its lower left corner. What lies outside still hides.",
)

CIRCLES = click.option(
    "--circles",
    is_flag=True,
    help="Meshes: rims become circles where all their vertices lie on one, less than the crease angle apart.",
)

ANNOTATIONS = click.option(
    "--annotations",
    is_flag=True,
    help=f"{OF_SOURCES['annotations'].whose}: also draw faces of annotation that the file hides or calls supplemental.",
)

HIDDEN_OBJECTS = click.option(
    "--hidden-objects",
    is_flag=True,
    help=f"{OF_SOURCES['hidden_objects'].whose}: also draw the objects that the document hides.",
)


def _uncached(ctx: click.Context, _parameter: click.Parameter, wanted: bool) -> None:
    if wanted:
        from hlr.cache.folder import without_cache

        ctx.with_resource(without_cache())


NO_CACHE = click.option(
    "--no-cache",
    is_flag=True,
    expose_value=False,
    callback=_uncached,
    help=f"{OF_SOURCES['no_cache'].whose}: read the file again, and do not keep it in the cache.",
)


PARAMETERS = click.option(
    "--param",
    "parameters",
    type=ScriptParameter(),
    metavar="NAME=VALUE",
    multiple=True,
    callback=as_table,
    help="Scripts: set a variable that the script sets to a plain value. May be repeated.",
)

CHOICE = (
    click.option(
        "--only",
        metavar="PART",
        multiple=True,
        help='Draw only these parts: a name or a pattern such as "bolt*", or an assembly. May be repeated.',
    ),
    click.option("--hide", metavar="PART", multiple=True, help="Leave these parts out. May be repeated."),
    click.option("--var", metavar="NAME", help="Scripts: the variable to draw, instead of what the script shows."),
    PARAMETERS,
    ANNOTATIONS,
    HIDDEN_OBJECTS,
    NO_CACHE,
)
"""Which parts are drawn, and where they come from."""

CAMERA = (
    click.option("--up", type=Vector(), metavar="X,Y,Z", help="What points up on paper."),
    click.option("--perspective", is_flag=True, help="Perspective instead of parallel projection."),
    click.option("--eye", type=Vector(), metavar="X,Y,Z", help="Perspective: where the eye is."),
    click.option("--target", type=Vector(), metavar="X,Y,Z", help="Perspective: what it looks at."),
    click.option(
        "--fov",
        type=Number(0.01, 170.0),
        metavar="DEG",
        help="Perspective: vertical field of view, 0.01 to 170.",
    ),
)

CARE = (
    click.option(
        "--accuracy",
        type=Number(0.0, above=True),
        metavar="MM",
        help=f"Largest error of a line on paper. Default: {DEFAULT_ACCURACY:g}, less for small drawings.",
    ),
    click.option(
        "--crease",
        type=Number(0.0, 180.0),
        metavar="DEG",
        default=CREASE,
        help=f"Meshes: angle between two triangles from which an edge is drawn. Default: {CREASE:g}.",
    ),
)

TIME_LIMIT = click.option(
    "--time-limit",
    type=Duration(),
    metavar="TIME",
    help="Give up after this time, and end a script with all that it has started: 60s, 5min. Not on Windows.",
)

RUN = (
    click.option(
        "--threads", type=Whole(0), metavar="N", default=0, help="How many at most; 0: one for each core. Default: 0."
    ),
    click.option("--strict", is_flag=True, help="Warnings are errors: nothing is written."),
)


def options(*chosen: Callable[[Command], Command]) -> Callable[[Command], Command]:
    """A decorator that adds several options, in the order of the help text."""

    def decorate(command: Command) -> Command:
        for option in reversed(chosen):
            command = option(command)
        return command

    return decorate


def names_of(views: tuple[View, ...], eye: Vector3 | None) -> list[str]:
    """The names of views in file names. Raises OptionError where both an eye and a view are given."""
    if eye is not None:
        if views:
            raise OptionError("--eye and --view contradict one another: both say where to look from; leave out one")
        return [EYE]
    return [view if isinstance(view, str) else ",".join(f"{x:g}" for x in view) for view in views or ("iso",)]


def perspective_of(
    perspective: bool, eye: Vector3 | None, target: Vector3 | None, fov: float | None
) -> Perspective | None:
    """The camera of these options; None for a parallel view. Eye, target or field of view imply perspective."""
    from hlr.request.options import Perspective

    if perspective or eye is not None or target is not None or fov is not None:
        return Perspective(eye=eye, target=target, fov=fov)
    return None
