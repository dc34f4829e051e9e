"""Measurements of one scene in a process of their own, so that memory and caches are their own. Prints one JSON list.

Several that are named together take turns: what else the machine does falls on all of them alike.
"""

from __future__ import annotations

import argparse
import json
import resource
import statistics
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from bench import occt, ours, scenes

from hlr.lab.rivals.opencascade import ExactAlgo, HiddenLines, PolyAlgo, forget_mesh, triangle_count

WHO = {
    "kernel": "our kernel on OpenCASCADE's triangulation",
    "draw": "the visibility stage of hlr.draw, which tessellates for itself",
    "poly": "HLRBRep_PolyAlgo on its triangulation",
    "exact": "HLRBRep_Algo",
    "hlr-svg": "shape in memory to SVG on disk by hlr",
    "cadquery-svg": "the same by CadQuery",
    "hlr-build123d": "project_to_viewport of hlr.compat.build123d, and build123d's ExportSVG",
    "build123d": "the same by build123d's own project_to_viewport",
    "memory": "nothing: what the scene itself takes",
}
HIDERS: dict[str, type[HiddenLines]] = {"poly": PolyAlgo, "exact": ExactAlgo}
SVG = {
    "hlr-svg": ours.svg,
    "cadquery-svg": occt.cadquery_svg,
    "hlr-build123d": ours.build123d_svg,
    "build123d": occt.build123d_svg,
}


def _megabytes() -> float:
    """Peak resident set so far; Linux counts kilobytes, macOS bytes."""
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / (1024 * 1024 if sys.platform == "darwin" else 1024)


def _fresh(shape: Any) -> Any:
    """The shape without triangulation, so that the next program has to tessellate."""
    forget_mesh(shape)
    return shape


def measure(scene: str, who: Sequence[str], repeat: int, budget: float = float("inf")) -> list[dict[str, Any]]:
    """Of each the median of some runs, in turns, and what else is worth knowing of them.

    budget: seconds after which no further turn begins.
    """
    shape = scenes.make(scene)
    results: list[dict[str, Any]] = [{"scene": scene, "who": each} for each in who]
    seconds: list[list[float]] = [[] for _ in who]
    with tempfile.TemporaryDirectory() as folder:
        outs = [Path(folder, f"{each}.svg") for each in who]
        runners = [
            _runner(shape, scenes.deflection(scene), each, out, result)
            for each, out, result in zip(who, outs, results, strict=True)
        ]
        before, start = _megabytes(), time.perf_counter()
        for turn in range(repeat):
            if turn and time.perf_counter() - start > budget:
                break
            # The order alternates, so that no program always comes first.
            for k in range(len(who)) if turn % 2 == 0 else reversed(range(len(who))):
                seconds[k].append(runners[k]())
        peak = _megabytes()
        for out, taken, result in zip(outs, seconds, results, strict=True):
            if out.exists():
                text = out.read_bytes()
                names = ("path", "circle", "ellipse", "line", "polyline")
                result |= {"bytes": len(text), "lines": sum(text.count(f"<{name} ".encode()) for name in names)}
            result |= {"seconds": statistics.median(taken), "all": taken}
            if len(who) == 1:  # with several, the peak cannot be attributed
                result |= {"peak_mb": peak, "grown_mb": peak - before}
    return results


def _runner(shape: Any, deflection: float, who: str, out: Path, result: dict[str, Any]) -> Callable[[], float]:
    """The function to be timed repeatedly; its input is prepared here and not timed."""
    if who == "memory":
        return lambda: 0.0
    if who in SVG:
        export = SVG[who]
        return lambda: export(_fresh(shape), out)
    if who == "draw":

        def run_draw() -> float:
            seconds, result["counters"] = ours.draw(_fresh(shape), deflection)
            return seconds

        return run_draw
    result["mesh"] = occt.mesh(shape, deflection, scenes.ANGLE)
    result["triangles"] = triangle_count(shape)
    if who in HIDERS:
        return lambda: occt.hide(shape, HIDERS[who])
    kernel = ours.Kernel(shape, contact=deflection)

    def run() -> float:
        seconds = kernel.run()
        result["counters"] = kernel.counters
        return seconds

    return run


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scene")
    parser.add_argument("who", type=lambda text: text.split(","), help="of " + ", ".join(WHO))
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--budget", type=float, default=float("inf"), help="seconds after which no further turn begins")
    given = parser.parse_args(arguments)
    for each in given.who:
        if each not in WHO:
            parser.error(f"{each} is none of {', '.join(WHO)}")
    print(json.dumps(measure(given.scene, given.who, given.repeat, given.budget)))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
