"""The ray referee, independent of hlr on purpose: draws models and judges each drawing with a mesh of its own.

    python -m peers.referee FOLDER_OR_FILES... [--views front,top,right,iso] [--random 2] [--table out.md]
    python -m peers.referee part.step --view iso --view 1,-2,3 --why --png pictures
    python -m peers.referee M6.step --views iso --peer occt-exact --why
    python -m peers.referee part.step --perspective 60

Reported are wrong lines (`support.referee.judge` says what that is), missing lines (`missing`), gaps in lines
(`broken`), edges off their own curves (`off_curve`) and lost faces (`lost`). The diagonal of a model is 300 mm on
paper, the accuracy a 20000th of it; with `--fineness 6000` it is 0.05 mm, the default of hlr. With `--against MODEL`
the files given are finished drawings (.json), judged as they are. Exit code 1 if anything is wrong.
"""

from __future__ import annotations

import argparse
import itertools
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from support.markdown import markdown
from support.programs import environment
from support.referee import exchange, reference, report
from support.referee.depth import PIXELS
from support.referee.referee import Curves, Judged, Referee
from support.true_curves import file_curves

VIEWS = "front,top,right,iso"
NAMED = ("front", "back", "left", "right", "top", "bottom", "iso", "iso-sw", "iso-ne", "iso-nw")
PEERS = ("hlr", "occt-exact", "occt-poly")
SHEET = 300.0
"""Millimetres on paper of every model's diagonal: about A4."""
View = str | tuple[float, float, float]


@dataclass(frozen=True)
class Drawn:
    """A drawing, or why there is none.

    own    the triangles that it was made from, where they are known
    """

    view: str
    drawing: exchange.Exchange | str
    seconds: float
    own: reference.Reference | None = None


def random_views(count: int, seed: int = 1) -> list[View]:
    """Directions spread evenly over the sphere; none is special, so nothing lies edge-on by design."""
    vectors = np.random.default_rng(seed).normal(size=(count, 3))
    return [(float(x), float(y), float(z)) for x, y, z in vectors / np.linalg.norm(vectors, axis=1)[:, None]]


def parsed_view(text: str) -> View:
    """A name, or the direction that three numbers give."""
    if "," not in text:
        return text
    x, y, z = map(float, text.split(","))
    return x, y, z


def view_name(view: View) -> str:
    return view if isinstance(view, str) else ",".join(f"{value:.6g}" for value in view)


def draw_with_hlr(
    path: Path, views: Sequence[View], model: reference.Reference, fov: float | None = None
) -> Iterator[Drawn]:
    """All views in one call, as a user would; what is judged is the JSON that is written.

    fov   in perspective, this many degrees wide; None: without
    """
    import hlr
    from hlr.drawing.saving import render
    from hlr.errors import HlrError
    from hlr.request.options import Options, Perspective

    # The reference holds every face of the file, those of annotation too.
    scale, accuracy = SHEET / (model.diagonal * model.unit), SHEET / model.fineness
    options = Options(
        hidden=True,
        scale=scale,
        accuracy=accuracy,
        annotations=True,
        smooth=False,
        details=True,
        perspective=None if fov is None else Perspective(fov=fov),
    )
    start = time.perf_counter()
    own: list[reference.Reference] = []
    try:
        with own_triangles(own):
            drawings = hlr.draw_views(path, list(views), options)
    except HlrError as error:
        yield Drawn("all", f"refused: {error}", time.perf_counter() - start)
        return
    seconds = (time.perf_counter() - start) / len(views)
    for drawing in drawings:
        document = exchange.parse(render(drawing, "json"))
        yield Drawn(document.camera.name, document, seconds, own[0] if own else None)


@contextmanager
def own_triangles(found: list[reference.Reference]) -> Iterator[None]:
    """While this lasts, the triangles that drawings are made from are put into `found`."""
    from hlr.pipeline.session import Session

    former = Session.drawing

    def noted(session: Any, *rest: Any) -> Any:
        scene = session.scene
        if not found and len(scene.triangles):
            found.append(reference.from_arrays(scene.points, scene.triangles))
        return former(session, *rest)

    Session.drawing = noted  # type: ignore[method-assign]
    try:
        yield
    finally:
        Session.drawing = former  # type: ignore[method-assign]


def draw_with_occt(path: Path, views: Sequence[View], method: str, timeout: float) -> Iterator[Drawn]:
    """One child process per view: some models keep the exact algorithm busy for ever, or crash it."""
    for view in views:
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "drawing.json"
            command = [
                sys.executable,
                "-P",
                "-m",
                "peers.occt",
                str(path),
                f"--method={method}",
                f"--view={view_name(view)}",
            ]
            try:
                done = subprocess.run(
                    [*command, f"--out={out}"],
                    timeout=timeout,
                    capture_output=True,
                    text=True,
                    check=False,
                    env=environment(),
                )
            except subprocess.TimeoutExpired:
                yield Drawn(view_name(view), f"no end within {timeout:.0f} s", timeout)
                continue
            if done.returncode or not out.exists():
                last = (done.stderr.strip().splitlines() or ["no message"])[-1]
                yield Drawn(view_name(view), f"failed ({done.returncode}): {last}", 0.0)
                continue
            document = exchange.read(out)
            yield Drawn(document.camera.name, document, float(document.document["timings"]["total"]))


def drawings(
    path: Path, views: Sequence[View], peer: str, model: reference.Reference, timeout: float, fov: float | None
) -> Iterator[Drawn]:
    if peer == "hlr":
        return draw_with_hlr(path, views, model, fov)
    if path.suffix.lower() not in reference.BREP:
        return iter([Drawn("all", "no B-rep, nothing for OpenCASCADE to draw", 0.0)])
    return draw_with_occt(path, views, peer.removeprefix("occt-"), timeout)


def files(given: Sequence[Path]) -> list[Path]:
    found: list[Path] = []
    for path in given:
        inside = sorted(path.iterdir(), key=lambda each: each.name.lower()) if path.is_dir() else [path]
        found += [each for each in inside if each.suffix.lower() in reference.SUFFIXES]
    return found


def judge_file(
    path: Path,
    views: Sequence[View],
    peers: Sequence[str] = ("hlr",),
    *,
    timeout: float = 120.0,
    fov: float | None = None,
    fineness: float = reference.FINENESS,
    cache: Path | None = None,
    pixels: int = PIXELS,
) -> Iterator[Judged]:
    """Judge one file; a file that cannot be meshed here is reported, not raised."""
    start = time.perf_counter()
    try:
        model = reference.load(path, fineness, cache)
    except Exception as error:
        yield Judged(report.Row(path.name, "all", "referee", failure=f"no reference mesh: {error}"))
        return
    judging = Referee(model, curves_of(path), pixels)
    print(
        f"{path.name}: {len(model.triangles)} triangles, diagonal {model.diagonal:.6g}, "
        f"{model.unmeshed} faces unmeshed, {time.perf_counter() - start:.1f} s",
        file=sys.stderr,
    )
    for peer in peers:
        for drawn in drawings(path, views, peer, model, timeout, fov):
            if isinstance(drawn.drawing, str):
                yield Judged(report.Row(path.name, drawn.view, peer, failure=drawn.drawing))
            else:
                yield judging.judge(path.name, peer, drawn.drawing, drawn.seconds, drawn.own)


def curves_of(path: Path) -> Curves | None:
    """The curves of a B-rep file's edges."""
    if path.suffix.lower() not in reference.BREP:
        return None
    from hlr.source import open_source

    return file_curves(open_source(path))


def judge_drawings(given: argparse.Namespace) -> Iterator[Judged]:
    """Drawings that exist already, all of one model."""
    model = reference.load(given.against, given.fineness, given.cache)
    judging = Referee(model, curves_of(given.against), given.pixels)
    for path in given.paths:
        yield judging.judge(path.name, "file", exchange.read(path))


def judge_models(given: argparse.Namespace) -> Iterator[Judged]:
    names = given.view or (NAMED if given.views == "all" else [name for name in given.views.split(",") if name])
    views = [*map(parsed_view, names), *random_views(given.random, given.seed)]
    for path in files(given.paths):
        yield from judge_file(
            path,
            views,
            given.peer or ["hlr"],
            timeout=given.timeout,
            fov=given.perspective,
            fineness=given.fineness,
            cache=given.cache,
            pixels=given.pixels,
        )


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("paths", nargs="+", type=Path, help="folders or model files")
    parser.add_argument("--view", action="append", help="a name or x,y,z; may be repeated, takes the place of --views")
    parser.add_argument(
        "--views", default=VIEWS, help=f"names, separated by commas (default {VIEWS}); all; '' for none"
    )
    parser.add_argument("--random", type=int, default=0, metavar="N", help="N random views more")
    parser.add_argument("--perspective", type=float, metavar="FOV", help="hlr draws in perspective, FOV degrees wide")
    parser.add_argument("--seed", type=int, default=1, help="of the random views")
    parser.add_argument("--peer", action="append", choices=PEERS, help="who draws (default hlr); may be repeated")
    parser.add_argument("--against", type=Path, metavar="MODEL", help="judge the drawings given against this model")
    parser.add_argument("--timeout", type=float, default=120.0, help="seconds for each view of a peer")
    parser.add_argument("--table", type=Path, help="write the table here as Markdown too")
    parser.add_argument("--why", type=int, nargs="?", const=10, default=0, help="list the N worst lines of each view")
    parser.add_argument("--png", type=Path, help="folder for pictures in which everything wrong is marked")
    parser.add_argument("--pixels", type=int, default=PIXELS, help="of the depth image, along its longer side")
    parser.add_argument("--fineness", type=float, default=reference.FINENESS, help="coarser rules for a quick look")
    parser.add_argument("--cache", type=Path, help="folder that keeps the reference meshes of B-rep files")
    given = parser.parse_args(arguments)
    rows: list[report.Row] = []
    for judged in judge_drawings(given) if given.against else judge_models(given):
        row = judged.row
        rows.append(row)
        print("  " + " ".join(row.cells()).strip(), flush=True)
        for text in itertools.islice(judged.why(), given.why):
            print("    " + text)
        if given.png:
            judged.save_picture(given.png / f"{Path(row.file).stem}-{row.drawer}-{row.view}.png")
    if not rows:
        print("no model files found", file=sys.stderr)
        return 2
    table = markdown(report.HEADINGS, [row.cells() for row in [*rows, report.total(rows)]])
    print(table)
    if given.table:
        given.table.write_text(table + "\n")
    return int(any(row.bad for row in rows))


if __name__ == "__main__":
    raise SystemExit(main())
