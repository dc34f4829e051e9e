"""The ray referee: draw models and judge every line by casting rays against an independent mesh.

    python tests/peers/referee.py FOLDER_OR_FILES... [--views front,top,right,iso] [--random 2] [--table out.md]
    python tests/peers/referee.py M6.step --views iso --peer occt-exact --why

Drawings are made at scale 1 with an accuracy of the diagonal / 20000 and judged as `peers.judge` says. With
`--against MODEL` the files given are drawings (.json) made elsewhere, judged as they are.
Exit code 1 if anything is wrong.
"""

from __future__ import annotations

import argparse
import itertools
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[1]))

from peers import exchange, reference, report
from peers.judge import RayCaster, Verdict, judge, offenders
from peers.missing import Edges, Missing, missing

VIEWS = "front,top,right,iso"
PEERS = ("hlr", "occt-exact", "occt-poly")
View = str | tuple[float, float, float]
Drawn = tuple[str, exchange.Exchange | str, float]
"""View name, the drawing or why there is none, seconds."""


@dataclass(frozen=True)
class Judged:
    """One drawing and all that is known of it; only the row where there is no drawing."""

    row: report.Row
    drawing: exchange.Exchange | None = None
    verdict: Verdict | None = None
    gaps: Missing | None = None

    def why(self) -> Iterator[str]:
        """The wrong lines, worst first, and then where lines are missing."""
        if self.drawing is not None and self.verdict is not None:
            yield from offenders(self.drawing, self.verdict)
        for x, y, z in self.gaps.places if self.gaps else ():
            yield f"no visible line at ({x:.6g}, {y:.6g}, {z:.6g})"


class Referee:
    """An independent mesh of one model, ready to judge drawings of it."""

    def __init__(self, model: reference.Reference) -> None:
        self._caster = RayCaster(model)
        self._edges = Edges(model)

    def judge(self, file: str, drawer: str, drawing: exchange.Exchange, seconds: float = 0.0) -> Judged:
        start = time.perf_counter()
        verdict = judge(drawing, self._caster)
        gaps = missing(drawing, self._edges, self._caster) if drawing.camera.eye is None else None
        spent = time.perf_counter() - start
        row = report.row(file, drawer, drawing, verdict, gaps=gaps, draw=seconds, judge=spent)
        return Judged(row, drawing, verdict, gaps)


def random_views(count: int, seed: int = 1) -> list[View]:
    """Directions spread evenly over the sphere; none is special, so nothing lies edge-on by design."""
    vectors = np.random.default_rng(seed).normal(size=(count, 3))
    return [(float(x), float(y), float(z)) for x, y, z in vectors / np.linalg.norm(vectors, axis=1)[:, None]]


def view_name(view: View) -> str:
    return view if isinstance(view, str) else ",".join(f"{value:.6g}" for value in view)


def draw_with_hlr(path: Path, views: Sequence[View], model: reference.Reference) -> Iterator[Drawn]:
    """All views in one call, as a user would; what is judged is the JSON that is written."""
    import hlr
    from hlr.errors import HlrError
    from hlr.plan.options import Options
    from hlr.writers import render

    options = Options(hidden=True, scale=1.0, accuracy=model.accuracy)
    start = time.perf_counter()
    try:
        drawings = hlr.draw_views(path, list(views), options)
    except HlrError as error:
        yield "all", f"refused: {error}", time.perf_counter() - start
        return
    seconds = (time.perf_counter() - start) / len(views)
    for drawing in drawings:
        document = exchange.parse(render(drawing, "json"))
        yield document.camera.name, document, seconds


def draw_with_occt(path: Path, views: Sequence[View], method: str, timeout: float) -> Iterator[Drawn]:
    """One child process per view: some models keep the exact algorithm busy for ever, or crash it."""
    script = Path(__file__).with_name("occt.py")
    for view in views:
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "drawing.json"
            command = [sys.executable, str(script), str(path), f"--method={method}", f"--view={view_name(view)}"]
            try:
                done = subprocess.run(
                    [*command, f"--out={out}"], timeout=timeout, capture_output=True, text=True, check=False
                )
            except subprocess.TimeoutExpired:
                yield view_name(view), f"no end within {timeout:.0f} s", timeout
                continue
            if done.returncode or not out.exists():
                last = (done.stderr.strip().splitlines() or ["no message"])[-1]
                yield view_name(view), f"failed ({done.returncode}): {last}", 0.0
                continue
            document = exchange.read(out)
            yield document.camera.name, document, float(document.document["timings"]["total"])


def drawings(
    path: Path, views: Sequence[View], peer: str, model: reference.Reference, timeout: float
) -> Iterator[Drawn]:
    if peer == "hlr":
        return draw_with_hlr(path, views, model)
    if path.suffix.lower() not in reference.BREP:
        return iter([("all", "no B-rep, nothing for OpenCASCADE to draw", 0.0)])
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
    fineness: float = reference.FINENESS,
    cache: Path | None = None,
) -> Iterator[Judged]:
    """Judge one file; a file that cannot be meshed here is reported, not raised."""
    start = time.perf_counter()
    try:
        model = reference.load(path, fineness, cache)
    except Exception as error:
        yield Judged(report.Row(path.name, "all", "referee", failure=f"no reference mesh: {error}"))
        return
    judging = Referee(model)
    print(
        f"{path.name}: {len(model.triangles)} triangles, diagonal {model.diagonal:.6g}, "
        f"{model.unmeshed} faces unmeshed, {time.perf_counter() - start:.1f} s",
        file=sys.stderr,
    )
    for peer in peers:
        for name, drawing, seconds in drawings(path, views, peer, model, timeout):
            if isinstance(drawing, str):
                yield Judged(report.Row(path.name, name, peer, failure=drawing))
            else:
                yield judging.judge(path.name, peer, drawing, seconds)


def judge_drawings(given: argparse.Namespace) -> Iterator[Judged]:
    """Drawings that exist already, all of one model."""
    judging = Referee(reference.load(given.against, given.fineness, given.cache))
    for path in given.paths:
        yield judging.judge(path.name, "file", exchange.read(path))


def judge_models(given: argparse.Namespace) -> Iterator[Judged]:
    views: list[View] = [name for name in given.views.split(",") if name]
    views += random_views(given.random, given.seed)
    for path in files(given.paths):
        yield from judge_file(
            path, views, given.peer or ["hlr"], timeout=given.timeout, fineness=given.fineness, cache=given.cache
        )


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("paths", nargs="+", type=Path, help="folders or model files")
    parser.add_argument("--views", default=VIEWS, help=f"names, separated by commas (default {VIEWS}); '' for none")
    parser.add_argument("--random", type=int, default=0, metavar="N", help="N random views more")
    parser.add_argument("--seed", type=int, default=1, help="of the random views")
    parser.add_argument("--peer", action="append", choices=PEERS, help="who draws (default hlr); may be repeated")
    parser.add_argument("--against", type=Path, metavar="MODEL", help="judge the drawings given against this model")
    parser.add_argument("--timeout", type=float, default=120.0, help="seconds for each view of a peer")
    parser.add_argument("--table", type=Path, help="write the table here as Markdown too")
    parser.add_argument("--why", type=int, nargs="?", const=10, default=0, help="list the N worst lines of each view")
    parser.add_argument("--svg", type=Path, help="folder for pictures with the wrong samples marked")
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
        if given.svg and judged.drawing and judged.verdict:
            given.svg.mkdir(parents=True, exist_ok=True)
            picture = given.svg / f"{Path(row.file).stem}-{row.drawer}-{row.view}.svg"
            report.save_picture(picture, judged.drawing, judged.verdict, judged.gaps)
    if not rows:
        print("no model files found", file=sys.stderr)
        return 2
    table = report.markdown(report.HEADINGS, [row.cells() for row in [*rows, report.total(rows)]])
    print(table)
    if given.table:
        given.table.write_text(table + "\n")
    return int(any(row.bad for row in rows))


if __name__ == "__main__":
    raise SystemExit(main())
