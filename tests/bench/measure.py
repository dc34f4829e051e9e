"""One measurement in a process of its own, so that peak memory and caches are its own. Prints one JSON object."""

from __future__ import annotations

import argparse
import json
import resource
import statistics
import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

sys.path.append(str(Path(__file__).resolve().parents[1]))

from bench import occt, ours, scenes

WHO = {
    "kernel": "our kernel on OpenCASCADE's triangulation",
    "draw": "the visibility stage of hlr.draw, which tessellates for itself",
    "poly": "HLRBRep_PolyAlgo on its triangulation",
    "exact": "HLRBRep_Algo",
    "hlr-svg": "shape in memory to SVG on disk by hlr",
    "cadquery-svg": "the same by CadQuery",
}


def _megabytes() -> float:
    """Peak resident set so far; Linux counts kilobytes, macOS bytes."""
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / (1024 * 1024 if sys.platform == "darwin" else 1024)


def _fresh(shape: Any) -> Any:
    """The shape without triangulation: whoever comes next has to tessellate."""
    from OCP.BRepTools import BRepTools

    BRepTools.Clean_s(shape)
    return shape


def measure(scene: str, who: str, repeat: int) -> dict[str, Any]:
    """The median of some runs, and what else is worth knowing of them."""
    shape = scenes.make(scene)
    result: dict[str, Any] = {"scene": scene, "who": who}
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "drawing.svg"
        run = _runner(shape, scenes.deflection(scene), who, out, result)
        before = _megabytes()
        seconds = [run() for _ in range(repeat)]
        if out.exists():
            text = out.read_bytes()
            result["bytes"] = len(text)
            result["lines"] = sum(text.count(f"<{name} ".encode()) for name in ("path", "circle", "ellipse"))
    median, peak = statistics.median(seconds), _megabytes()
    return result | {"seconds": median, "all": seconds, "peak_mb": peak, "grown_mb": peak - before}


def _runner(shape: Any, deflection: float, who: str, out: Path, result: dict[str, Any]) -> Callable[[], float]:
    """What is run again and again; what it needs is prepared here and not timed."""
    if who in {"poly", "exact", "kernel"}:
        result["mesh"] = occt.mesh(shape, deflection, scenes.ANGLE)
        result["triangles"] = occt.triangle_count(shape)
    if who == "poly":
        return lambda: occt.poly(shape)
    if who == "exact":
        return lambda: occt.exact(shape)
    if who == "kernel":
        kernel = ours.Kernel(shape, contact=deflection)

        def run() -> float:
            seconds = kernel.run()
            result["counters"] = kernel.counters
            return seconds

        return run
    if who == "draw":

        def run_draw() -> float:
            seconds, result["counters"] = ours.draw(_fresh(shape), deflection)
            return seconds

        return run_draw
    export = occt.cadquery_svg if who == "cadquery-svg" else ours.svg
    return lambda: export(_fresh(shape), out)


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scene")
    parser.add_argument("who", choices=WHO)
    parser.add_argument("--repeat", type=int, default=5)
    given = parser.parse_args(arguments)
    print(json.dumps(measure(given.scene, given.who, given.repeat)))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
