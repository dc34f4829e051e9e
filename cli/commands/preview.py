"""`hlr preview`: a model in, shaded pictures out."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from hlr.errors import OptionError, SourceError, StrictError

from ..exits import warn
from ..guard import start
from ..meter import meter
from ..outputs import STDOUT, plan
from ..parameters import Pixels, Vector3
from ..signals import tidily
from ..streams import result_only
from ..view_options import CAMERA, CARE, RUN, VIEW, names_of, options, perspective_of

if TYPE_CHECKING:
    from hlr.picture import Picture
    from hlr.plan.effects import PreviewOptions


@click.command()
@click.argument("source")
@click.option(
    "-o",
    "--output",
    metavar="FILE",
    help="Where to write: .png, or - for standard output. {stem}, {view} and {n} stand for the source, the view and "
    "its number. Default: {stem}.png in this folder.",
)
@VIEW
@click.option("--size", type=Pixels(), metavar="WxH", default="1920x1080", help="In pixels. Default: 1920x1080.")
@click.option("--edges", is_flag=True, help="The visible lines of the drawing on top.")
@click.option("--smooth", is_flag=True, help="With --edges: also tangent edges, thin.")
@click.option(
    "--background", metavar="COLOUR", default="white", help="A CSS name, #rrggbb or transparent. Default: white."
)
@click.option("--antialias/--no-antialias", default=True, help="Sixteen samples a pixel. Default: on.")
@click.option("--shadows", is_flag=True, help="The light casts shadows.")
@click.option("--occlusion", is_flag=True, help="Corners and crevices are darker.")
@click.option("--specular", is_flag=True, help="Highlights.")
@click.option("--depth", metavar="FILE", help="Also a depth map: 16-bit grey, 0 nearest, 65535 nothing.")
@click.option("--ids", metavar="FILE", help="Also a map of the faces: their numbers as colours.")
@options(*CARE, *CAMERA, *RUN)
@click.option("--explain", is_flag=True, help="Say what the scene and the request called for, and why.")
@click.option("-q", "--quiet", is_flag=True, help="No progress and no summary on the terminal.")
def preview(
    *, source: str, output: str | None, views: tuple[str | Vector3, ...], explain: bool, quiet: bool, **wishes: Any
) -> None:
    """Show SOURCE shaded, in its own colours.

    \b
      hlr preview part.step -o part.png --edges
      hlr preview part.step -o "{stem}-{view}.png" --view front --view iso --size 800x600
      hlr preview part.step --shadows --occlusion --background "#223344" --perspective

    Where the file says that a part is transparent, it is.
    """
    views = views or ("iso",)
    names = names_of(views)
    maps = {name: wishes.pop(name) for name in ("depth", "ids")}
    request = _options(**wishes, depth=maps["depth"] is not None, ids=maps["ids"] is not None)
    targets = _targets(output, maps, source, names)

    start(source)
    # While anything runs that is not ours, standard output is out of its reach.
    with result_only() as out:
        with meter(quiet) as progress:
            import hlr

            pictures = hlr.preview_views(source, list(views), request, progress=progress)
        _warn(pictures, request.strict)
        if explain:
            from hlr.plan.effect import explained

            click.echo("\n\n".join(explained(picture.plan) for picture in pictures), err=True)
        made = _encoded(pictures, targets)
        if output == STDOUT:
            out.put(made.pop(Path(STDOUT)))
        with tidily():
            from hlr.writers import files

            files.place(made)
    if not quiet and sys.stderr is not None and sys.stderr.isatty():
        for picture, target in zip(pictures, targets, strict=True):
            seconds = picture.timings.get("total", 0.0)
            click.echo(f"{target['picture']}: {picture.view.name}, {seconds:.1f} s", err=True)


def _options(
    *, perspective: bool, eye: Vector3 | None, target: Vector3 | None, fov: float | None, **others: Any
) -> PreviewOptions:
    from hlr.plan.effects import PreviewOptions, check_size
    from hlr.writers.png import parse_color

    check_size(others["size"])
    parse_color(others["background"])
    return PreviewOptions(perspective=perspective_of(perspective, eye, target, fov), **others)


def _targets(output: str | None, maps: dict[str, str | None], source: str, names: list[str]) -> list[dict[str, Path]]:
    """Per view the paths of what is written. What cannot be written is refused before any work."""
    from hlr.writers.png import check_png

    if output == STDOUT and len(names) > 1:
        raise OptionError("standard output takes one view; write several views to files with {view} in the name")
    if STDOUT in maps.values():
        raise OptionError("only the picture can be written to standard output; give depth and ids a file name each")
    if Path(source).is_dir():  # "." has no stem to name an output after
        raise SourceError(f"{source} is a folder: name a model file in it.")
    found: list[dict[str, Path]] = [{} for _ in names]
    for what, pattern in {"picture": output, **maps}.items():
        if what != "picture" and pattern is None:
            continue
        paths = [Path(STDOUT)] if pattern == STDOUT else plan(pattern, source, names, "png")
        for target, path in zip(found, paths, strict=True):
            if pattern != STDOUT:
                check_png(path)
            if path in target.values():
                raise OptionError(f"two things would be written to {path}; give each a name of its own")
            target[what] = path
    return found


def _warn(pictures: list[Picture], strict: bool) -> None:
    """Each warning once, though every view has met it."""
    notes = list(dict.fromkeys(note for picture in pictures for note in picture.notes))
    if strict and notes:
        more = f" (and {len(notes) - 1} more)" if len(notes) > 1 else ""
        raise StrictError(f"{notes[0]}{more}; nothing is written, because of --strict")
    for note in notes:
        warn(str(note))


def _encoded(pictures: list[Picture], targets: list[dict[str, Path]]) -> dict[Path, bytes]:
    from hlr.writers.png import depth_png, ids_png, picture_png

    make = {"picture": picture_png, "depth": depth_png, "ids": ids_png}
    return {
        path: make[what](picture)
        for picture, target in zip(pictures, targets, strict=True)
        for what, path in target.items()
    }
