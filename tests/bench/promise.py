"""Whether drawings keep their promise: `python -m bench.promise FOLDER [-o results.jsonl]`.

Each model is drawn at 1:1 where that is 20 to 400 mm large, else fitted to A4, at each of four accuracies, and measured
(`hlr.lab.measure`). The table has measured error / promise, class by class; what is above 1 is broken. Each drawing has
a process and a time limit of its own. Results that are already in the file are not measured again.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

from support.at_size import ALL_LINES

ACCURACIES = (0.5, 0.1, 0.05, 0.01)
SHEET = (277.0, 190.0)
SMALLEST, LARGEST = 20.0, 400.0
LIMIT = 600.0
"""Seconds for one drawing and its measuring."""
CLASSES = ("edges", "outlines", "meshes", "intersections", "changes", "lost")
ENDINGS = (".step", ".stp", ".iges", ".igs", ".brep", ".stl", ".obj", ".ply", ".off", ".3mf", ".glb")

TWENTY = (
    "as1-oc-214.stp",
    "Axis_of_bearing.brep",
    "Base_08q.step",
    "bearing.iges",
    "BMV080.step",
    "bunny.ply",
    "cube_gears.3mf",
    "cycloidal.ply",
    "hammer.iges",
    "IM19.step",
    "linkrods.step",
    "M.2-E.step",
    "M6-1x12-countersunk-screw.step",
    "Motor-c.brep",
    "nist_ctc_01_asme1_ap242-e1.stp",
    "nist_ctc_03_asme1_ap242-e2.stp",
    "nist_ctc_05_asme1_ap242-e1.stp",
    "plate_mode_samples_creo.stp",
    "profile4040.step",
    "Wrist_Roll_Pitch_SO101.step",
)
"""Of different kind: machined parts, assemblies, freeform, thread, circuit, NIST's test cases, meshes."""


def one(path: Path, accuracy: float) -> dict[str, Any]:
    """Draw and measure."""
    import hlr
    from hlr.lab.measure import measured
    from hlr.source import open_source

    opened = open_source(path)
    low, high = opened.bounds()
    size = float(((high - low) ** 2).sum() ** 0.5) * opened.frame.unit
    usual = SMALLEST <= size <= LARGEST
    options = hlr.Options(accuracy=accuracy, scale=1.0 if usual else None, fit=None if usual else SHEET, **ALL_LINES)
    (drawing,) = hlr.draw_views(opened, ["iso"], options)
    reached = measured(opened, drawing)
    return {
        "scale": drawing.scale,
        "lines": len(drawing.lines),
        "draw": drawing.timings["total"],
        "measure": reached.seconds,
        "kept": reached.kept(),
        **reached.as_dict(),
    }


def tried(path: Path, accuracy: float, limit: float) -> dict[str, Any]:
    """The same in a process of its own; `failed` says why there is nothing."""
    command = [sys.executable, "-m", "bench.promise", str(path.resolve()), "--one", str(accuracy)]
    tests = Path(__file__).resolve().parents[1]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=limit, check=False, cwd=tests)
    except subprocess.TimeoutExpired:
        return {"failed": f"not finished in {limit:g} s"}
    if done.returncode:
        return {"failed": (done.stderr.strip().splitlines() or ["no message"])[-1][:200]}
    result: dict[str, Any] = json.loads(done.stdout)
    return result


def row(result: dict[str, Any]) -> str:
    """One row of the table."""
    head = f"| {result['model']} | {result['accuracy']:g} |"
    if "failed" in result:
        return f"{head} {result['failed']} |" + " |" * (len(CLASSES) + 4)
    promise = result["accuracy"]

    def share(value: float | None) -> str:
        return "" if value is None else f"{value / promise:.2f}"

    cells = [share(result[name]["worst"]) for name in CLASSES]
    cells += [
        share(result["labels"].get("longest")),
        share(result["grazing"]["worst"]),
        share(result["short"]["worst"]),
    ]
    return f"{head} {' | '.join(cells)} | {result['draw']:.1f} | {result['measure']:.0f} |"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="with the models, or one model")
    parser.add_argument("-o", "--output", type=Path, help="keep the results, one JSON object a line")
    parser.add_argument("--only", default="", help="part of a file's name")
    parser.add_argument("--all", action="store_true", help="every model of the folder, not only the twenty")
    parser.add_argument("--accuracy", type=float, action="append", help=f"instead of {ACCURACIES}")
    parser.add_argument("--limit", type=float, default=LIMIT, help="seconds for each")
    parser.add_argument("--one", type=float, help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.one is not None:
        print(json.dumps(one(given.folder, given.one)))
        return
    known = {}
    if given.output is not None and given.output.exists():
        known = {(r["model"], r["accuracy"]): r for r in map(json.loads, given.output.read_text().splitlines())}
    if given.folder.is_file():
        paths = [given.folder]
    else:
        paths = [p for p in sorted(given.folder.iterdir()) if p.suffix.lower() in ENDINGS and given.only in p.name]
        paths = [p for p in paths if given.all or p.name in TWENTY]
    print(f"| model | accuracy | {' | '.join(CLASSES)} | mislabelled | grazing | shortest | draw, s | measure, s |")
    print("|---" * (len(CLASSES) + 7) + "|")
    for path in paths:
        for accuracy in given.accuracy or ACCURACIES:
            result = known.get((path.name, accuracy))
            if result is None:
                result = {"model": path.name, "accuracy": accuracy, **tried(path, accuracy, given.limit)}
                if given.output is not None:
                    with given.output.open("a") as file:
                        file.write(json.dumps(result) + "\n")
            print(row(result), flush=True)


if __name__ == "__main__":
    main()
