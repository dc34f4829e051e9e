"""`hlr preview`: shaded pictures of a model."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import click

from hlr.errors import OptionError
from hlr.request.defaults import PREVIEW_BACKGROUND, PREVIEW_LOOK, PREVIEW_SIZE

from ..guard import start
from ..meter import meter
from ..outputs import STDOUT, Target, check, is_folder, place, plan
from ..parameters import OutputName, Pixels, Vector3
from ..streams import result_only, say
from ..telling import of_views, tell_notes, tell_written
from ..verb import Verb
from ..view_options import CAMERA, CARE, CHOICE, RUN, TIME_LIMIT, VIEW, names_of, options, perspective_of

if TYPE_CHECKING:
    from hlr.drawing.picture import Picture
    from hlr.request.options import View
    from hlr.request.picture_effects import PreviewOptions


@click.command(cls=Verb)
@click.argument("source")
@click.option(
    "-o",
    "--output",
    type=OutputName(),
    metavar="FILE",
    help="Where to write: .png; a folder/; - for standard output. {stem}, {view} and {n} stand for the source, the "
    "view and its number. Default: {stem}.png in this folder.",
)
@VIEW
@options(*CHOICE)
@click.option(
    "--size",
    type=Pixels(),
    metavar="WxH",
    default=Pixels.text(PREVIEW_SIZE),
    help=f"In pixels. Default: {Pixels.text(PREVIEW_SIZE)}.",
)
@click.option(
    "--look",
    type=click.Choice(["shaded", "wireframe", "depth-cued"]),
    default=PREVIEW_LOOK,
    help="Shaded faces; all lines, hidden or not, without faces; or these lines, paler with distance. "
    f"Default: {PREVIEW_LOOK}.",
)
@click.option("--edges", is_flag=True, help="The visible lines of the drawing on top; behind glass, lighter.")
@click.option(
    "--smooth/--no-smooth",
    default=None,
    help="With --edges: also tangent edges, thin. Default: in pictorial views only.",
)
@click.option(
    "--background",
    metavar="COLOUR",
    default=PREVIEW_BACKGROUND,
    help=f"A CSS name, #rrggbb or transparent. Default: {PREVIEW_BACKGROUND}.",
)
@click.option("--antialias/--no-antialias", default=True, help="Sixteen samples per pixel. Default: on.")
@click.option("--shadows", is_flag=True, help="The light casts shadows.")
@click.option("--occlusion", is_flag=True, help="Ambient occlusion: corners and crevices are darker.")
@click.option("--specular", is_flag=True, help="Highlights.")
@click.option("--depth", metavar="FILE", help="Also write a depth map: 16-bit grey, 0 is nearest, 65535 is background.")
@click.option("--ids", metavar="FILE", help="Also write a map of the faces: their numbers as colours.")
@options(*CARE, TIME_LIMIT, *CAMERA, *RUN)
@click.option("--explain", is_flag=True, help="Print which steps were needed, and why.")
@click.option("-q", "--quiet", is_flag=True, help="No progress and no summary on the terminal.")
def preview(
    *, source: str, output: str | None, views: tuple[View, ...], explain: bool, quiet: bool, **chosen: Any
) -> None:
    """Show SOURCE shaded, in its own colours.

    \b
      hlr preview part.step -o part.png --edges
      hlr preview part.step -o "{stem}-{view}.png" --view front --view iso --size 800x600
      hlr preview part.step --shadows --occlusion --background "#223344" --perspective

    Parts that are transparent in the file are drawn transparent.
    """
    names = names_of(views, chosen["eye"])
    views = views or ("iso",)
    time_limit = chosen.pop("time_limit")
    maps = {name: chosen.pop(name) for name in ("depth", "ids")}
    request = _options(**chosen, depth=maps["depth"] is not None, ids=maps["ids"] is not None)
    targets = _targets(output, maps, source, names)

    start(source, time_limit)
    # Scripts and libraries may print: meanwhile only the result can reach standard output.
    with result_only() as out:
        with meter(quiet) as progress:
            import hlr

            pictures = hlr.preview_views(source, list(views), request, progress=progress)
        tell_notes(of_views(pictures), request.strict, quiet)
        if explain:
            from hlr.request.effect import explained

            several = len(pictures) > 1
            tables = [(f"{each.view.name}\n" if several else "") + explained(each.plan) for each in pictures]
            say(*"\n\n".join(tables).split("\n"))
        place(_encoded(pictures, targets, out.put))
    for picture, row in zip(pictures, targets, strict=True):
        where = ", ".join(str(target) for target in row.values())
        tell_written(f"{where}: {picture.view.name}, {picture.timings.get('total', 0.0):.1f} s", quiet)


def _options(
    *, perspective: bool, eye: Vector3 | None, target: Vector3 | None, fov: float | None, **others: Any
) -> PreviewOptions:
    from hlr.common.colors import parse_color
    from hlr.request.picture_effects import PreviewOptions, check_size

    check_size(others["size"])
    parse_color(others["background"])
    return PreviewOptions(perspective=perspective_of(perspective, eye, target, fov), **others)


def _targets(output: str | None, maps: dict[str, str | None], source: str, names: list[str]) -> list[dict[str, Target]]:
    """For each view, where its pictures are written. What cannot be written is refused before any work."""
    from hlr.drawing.saving import check_png

    if output == STDOUT and len(names) > 1:
        raise OptionError("standard output takes one view; write several views to files with {view} in the name")
    if STDOUT in maps.values():
        raise OptionError("only the picture can be written to standard output; give depth and ids a file name each")
    found: list[dict[str, Target]] = [{} for _ in names]
    for what, pattern in {"picture": output, **maps}.items():
        if what != "picture":
            if pattern is None:
                continue
            if is_folder(pattern):
                raise OptionError(f"--{what} needs a file name, and {pattern} is a folder")
        if pattern == STDOUT:
            found[0][what] = Target(None, "png")
            continue
        made = pattern is not None and is_folder(pattern)
        for target, path in zip(found, plan(pattern, source, names, "png"), strict=True):
            check_png(path)
            target[what] = Target(path, "png", path.parent if made else None)
    check([target for row in found for target in row.values()])
    return found


def _encoded(
    pictures: list[Picture], targets: list[dict[str, Target]], put: Callable[[bytes], None]
) -> list[tuple[Target, bytes]]:
    """Encode all pictures: write those for standard output, return those for files."""
    from hlr.writers.png import depth_png, ids_png, picture_png

    make = {"picture": picture_png, "depth": depth_png, "ids": ids_png}
    files = []
    for picture, row in zip(pictures, targets, strict=True):
        for what, target in row.items():
            data = make[what](picture)
            if target.path is None:
                put(data)
            else:
                files.append((target, data))
    return files
