"""The properties of `tests/properties`, checked on a folder of models of your own, one row each.

    python -m properties.over FOLDER_OR_FILES... [--accuracy 2000] [--views front,iso] [--ink] [--table out.md]

Each model is read and meshed once, with a chord error of half the accuracy: its diagonal / 2000, or as given. Then
every view is drawn with 1, 2 and 4 threads and again, and with its parts, triangles, faces and edges shuffled; the
files (SVG, PDF, JSON without timings) must be the same bytes. Where only the lines are the same, in every
coordinate, the table says "lines": parts or edges that have one in common may trade it, and intersection lines are
listed in the order of the triangles.

With --ink it is also turned, moved, scaled, mirrored, split, with its points shuffled and jiggled. Those columns tell
the longest stretch of ink that came, went or changed class, in accuracies, and the whole of it in per mille of the
ink; stretches up to 21 are what rounding may decide (`ink.LONGEST`).

Exit code 1 where bytes differ. Models that cannot be read are reported and passed over.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from properties import changes
from properties.assemblies import rotation
from properties.frozen import Frozen, draw, freeze
from properties.identity import everything, ownerless, renumbered
from properties.ink import change

import hlr
from hlr.tables.readers import endings

THREADS = (2, 4, 1)
JIGGLE = 5e-4
SAME, LISTED, DIFFERENT = "same", "lines", "DIFFERENT"
IDENTITY = ("threads", "parts", "triangles", "faces", "edges")
INK = ("turned", "moved", "scaled", "mirrored", "split", "points", "jiggled")


def identity(model: Frozen, view: str, accuracy: float) -> Iterator[tuple[str, str]]:
    """Per column SAME, or what is not."""

    def drawn(of: Frozen, threads: int = 0) -> hlr.Drawing:
        return draw(of, view, accuracy, smooth=True, threads=threads)

    def verdict(after: hlr.Drawing) -> str:
        return SAME if everything(after) == whole else LISTED if ownerless(after) == lines else DIFFERENT

    rng = np.random.default_rng(1)
    before = drawn(model, 1)
    whole, lines = everything(before), ownerless(before)
    yield "threads", SAME if all(everything(drawn(model, n)) == whole for n in THREADS) else DIFFERENT
    order = rng.permutation(len(model.parts)).tolist()
    yield "parts", verdict(replace(renumbered(drawn(changes.reordered(model, order)), order), notes=before.notes))
    yield "triangles", verdict(drawn(changes.shuffled_triangles(model, rng)))
    shuffled, old = changes.shuffled_faces(model, rng)
    yield "faces", verdict(replace(renumbered(drawn(shuffled), range(len(model.parts)), old), notes=before.notes))
    yield "edges", verdict(drawn(changes.shuffled_edges(model, rng)))


def ink_changes(model: Frozen, view: str, accuracy: float) -> Iterator[tuple[str, str]]:
    """Per column the longest stretch that changed, in accuracies, and the whole of it in per mille."""
    before = draw(model, view, accuracy)
    v, rng = before.view, np.random.default_rng(1)
    # View and up are given in a world with z up, whatever the file's axes.
    frame = np.array(model.frame.up)
    toward, up, right = (np.array(a) for a in (v.direction, v.up, v.right))
    turn = rotation((1, 2, 3), 37)
    far = 1e6 * model.diagonal * np.array([1.0, 0.7, -0.3])
    paper = np.array([far @ right, far @ up]) * before.unit * before.scale

    def told(after: Frozen, matrix: np.ndarray | None = None, scale: float = 1.0, back: Callable | None = None) -> str:
        d, u = (frame @ (a if matrix is None else matrix @ a) for a in (toward, up))
        found = change(before, draw(after, tuple(d), accuracy, up=tuple(u), scale=scale), back=back or (lambda p: p))
        return f"{found.longest:.1f} ({1000 * found.share:.2f})"

    yield "turned", told(changes.moved(model, turn), turn)
    yield "moved", told(changes.moved(model, np.eye(3), far), back=lambda p: p - paper)
    yield "scaled", told(changes.moved(model, 3.0 * np.eye(3)), scale=1.0 / 3.0)
    glass = np.eye(3) - 2.0 * np.outer(right, right)
    yield "mirrored", told(changes.moved(model, glass), back=lambda p: p * [-1.0, 1.0])
    yield "split", told(changes.split(model, rng))
    yield "points", told(changes.shuffled_points(model, rng))
    yield "jiggled", told(changes.jiggled(model, JIGGLE * accuracy / before.unit, rng))


def rows(path: Path, views: Sequence[str], fineness: float, ink: bool) -> Iterator[list[str]]:
    start = time.perf_counter()
    try:
        model = freeze(path, 2.0 * fineness)
    except hlr.HlrError as error:
        yield [path.name, "", f"refused: {error}"]
        return
    accuracy = model.diagonal * model.frame.unit / fineness
    counts = [str(len(model.parts)), str(sum(len(part.triangles) for part in model.parts))]
    for view in views:
        found = dict(identity(model, view, accuracy))
        if ink:
            found |= dict(ink_changes(model, view, accuracy))
        seconds = f"{time.perf_counter() - start:.1f}"
        start = time.perf_counter()
        yield [path.name, view, *counts, *found.values(), seconds]


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("paths", nargs="+", type=Path, help="folders or model files")
    parser.add_argument("--accuracy", type=float, default=2000.0, metavar="N", help="a model's diagonal / N")
    parser.add_argument("--views", default="front,iso", help="names, separated by commas")
    parser.add_argument("--ink", action="store_true", help="move, split and jiggle the model too")
    parser.add_argument("--table", type=Path, help="write the table here as Markdown too")
    given = parser.parse_args(arguments)
    files: list[Path] = []
    for path in given.paths:
        inside = sorted(path.rglob("*"), key=lambda each: each.name.lower()) if path.is_dir() else [path]
        files += [each for each in inside if each.suffix.lower() in endings() and each.suffix.lower() != ".py"]
    heads = ["file", "view", "of parts", "of triangles", *IDENTITY, *(INK if given.ink else ()), "seconds"]
    lines = ["| " + " | ".join(heads) + " |", "|" + " --- |" * len(heads)]
    print("\n".join(lines), flush=True)
    for path in files:
        for row in rows(path, given.views.split(","), given.accuracy, given.ink):
            lines.append("| " + " | ".join(row) + " |")
            print(lines[-1], flush=True)
    if given.table:
        given.table.write_text("\n".join(lines) + "\n")
    return int(any(DIFFERENT in line for line in lines) or not files)


if __name__ == "__main__":
    raise SystemExit(main())
