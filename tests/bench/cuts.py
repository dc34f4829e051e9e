"""Sections: drawings of models that a plane cuts, beside the same with OpenCASCADE's cut, and beside plain drawings.

    python -m bench.run --only sections MODEL...

From the shape in memory to the SVG on disk, seen and cut from the front, in turns; the model is not known from an
earlier cut.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Sequence
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from bench import scenes
from bench.table import Table, geometric_mean

import hlr
from hlr.errors import HlrError
from hlr.pipeline.section import sources
from hlr.source.cad.kernel_cut import KernelCut


@contextmanager
def opencascade():
    """OpenCASCADE cuts all parts."""
    sources.KernelCut = lambda *asked: KernelCut(*asked[:3], ())
    try:
        yield
    finally:
        sources.KernelCut = KernelCut


def drawn(shape, file: Path, **options) -> float:
    """Seconds of a drawing; infinite where it cannot be drawn."""
    begin = time.perf_counter()
    try:
        hlr.draw(shape, "front", **options).save(file)
    except HlrError:
        return float("inf")
    return time.perf_counter() - begin


def table(names: Sequence[str], runs: int) -> Table:
    """A row for each scene or file."""
    rows, results = [], []
    with TemporaryDirectory() as folder:
        file = Path(folder) / "a.svg"
        for name in names:
            shape = scenes.make(name)
            drawn(shape, file)
            times: dict[str, list[float]] = {"plain": [], "kernel": [], "opencascade": []}
            for _ in range(runs):
                times["plain"].append(drawn(shape, file))
                times["kernel"].append(drawn(shape, file, section=True))
                with opencascade():
                    times["opencascade"].append(drawn(shape, file, section=True))
            found = {who: statistics.median(each) for who, each in times.items()}
            ratio = found["opencascade"] / found["kernel"]
            results.append({"scene": name, **found})
            rows.append([Path(name).name, *(f"{found[who]:.3g}" for who in times), f"{ratio:.1f} x"])
    ratios = [r["opencascade"] / r["kernel"] for r in results if max(r["opencascade"], r["kernel"]) < float("inf")]
    headings = ["shape", "drawing s", "section s", "section cut by OpenCASCADE s", "ratio"]
    return Table(headings, rows, results, [f"Geometric mean of {len(ratios)} ratios: {geometric_mean(ratios):.2f}."])
