"""Pictures of a model as drawn by OpenCASCADE's two algorithms and by hlr.

    python -m peers.side_by_side FILE... -o DIR
    python -m peers.side_by_side FILE -o DIR --window 120,80,10     only that square of the sheet

OpenCASCADE has a process of its own and a time limit, for the exact algorithm may never end. The polygonal one meshes
as finely as hlr does. The picture says how many lines each made, and how long it took without reading the file: hlr
with its meshing, OpenCASCADE without.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import hlr
from hlr.drawing.drawing import Drawing
from support.at_size import ALL_LINES
from support.ink import flat
from support.programs import environment

SHEET = (277, 190)
NAMES = {"exact": "HLRBRep_Algo", "poly": "HLRBRep_PolyAlgo", "hlr": "hlr"}


@dataclass(frozen=True)
class Panel:
    """What one drawer made: polylines in millimetres on paper, visible or not; or why there are none."""

    title: str
    lines: list[tuple[bool, np.ndarray]]


def ours(drawing: Drawing) -> Panel:
    """Our lines, before they were moved to their origin."""
    seconds = drawing.timings["total"] - drawing.timings["source"]
    lines = [(line.visible, flat(line) + np.array(drawing.origin)) for line in drawing.lines]
    return Panel(f"hlr: {seconds:.2g} s, {len(lines)} lines", lines)


def theirs(path: Path, drawing: Drawing, method: str, limit: float) -> Panel:
    """OpenCASCADE's lines of the same view, in the same place."""
    per_model = drawing.scale * drawing.unit
    deflection = drawing.accuracy.deflection / drawing.unit
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "drawing.json"
        command = [
            sys.executable,
            "-P",
            "-m",
            "peers.occt",
            str(path),
            f"--method={method}",
            f"--view={drawing.view.name}",
        ]
        command += [f"--out={out}", f"--deflection={deflection}", "--flat"]
        try:
            subprocess.run(command, timeout=limit, check=True, capture_output=True, env=environment())
        except subprocess.TimeoutExpired:
            return Panel(f"{NAMES[method]}: not finished in {limit:.0f} s", [])
        except subprocess.CalledProcessError as error:
            return Panel(f"{NAMES[method]}: exit code {error.returncode}", [])
        document: dict[str, Any] = json.loads(out.read_text())
    lines = [(line["visible"], np.array(line["points"]) * per_model) for line in document["lines"]]
    return Panel(f"{NAMES[method]}: {document['timings']['total']:.2g} s, {len(lines)} lines", lines)


def picture(panels: Sequence[Panel], box: np.ndarray, path: Path, width: float) -> None:
    """One PNG, the panels side by side; box: lower left and upper right corner of what is shown."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.collections import LineCollection
    from matplotlib.figure import Figure

    size = box[1] - box[0]
    figure = Figure(figsize=(width * len(panels), width * size[1] / size[0] + 0.3), layout="constrained")
    canvas = FigureCanvasAgg(figure)
    for axes, panel in zip(np.atleast_1d(figure.subplots(1, len(panels))), panels, strict=True):
        for visible in (False, True):
            style: dict[str, Any] = {"linewidths": 0.8} if visible else {"linewidths": 0.4, "linestyles": (0, (6, 2))}
            found = [points for seen, points in panel.lines if seen == visible]
            axes.add_collection(LineCollection(found, colors="black" if visible else "#5a7fb0", **style))
        axes.set(xlim=box[:, 0], ylim=box[:, 1], aspect="equal", xticks=[], yticks=[])
        axes.set_title(panel.title, fontsize=7)
        for spine in axes.spines.values():
            spine.set_visible(False)
    canvas.print_png(str(path), metadata={"Software": None})


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", type=Path)
    parser.add_argument("-o", "--out", type=Path, required=True)
    parser.add_argument("--view", default="iso")
    parser.add_argument("--limit", type=float, default=120.0, help="seconds that OpenCASCADE may take")
    parser.add_argument("--window", help="X,Y,SIZE in millimetres from the lower left corner")
    parser.add_argument("--width", type=float, default=4.5, help="inches of one panel")
    parser.add_argument("--suffix", default="", help="after the name of the picture")
    given = parser.parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    for path in given.files:
        drawing = hlr.draw(path, given.view, fit=SHEET, **ALL_LINES)
        panel, origin = ours(drawing), np.array(drawing.origin)
        panels = [theirs(path, drawing, method, given.limit) for method in ("exact", "poly")]
        points = np.concatenate([points for _, points in panel.lines])
        box = np.stack([points.min(axis=0) - 1.0, points.max(axis=0) + 1.0])
        if given.window:
            x, y, half = map(float, given.window.split(","))
            box = np.array([[x - half, y - half], [x + half, y + half]]) + origin
        name = path.name.split(".")[0] + given.suffix
        picture([*panels, panel], box, given.out / f"{name}.png", given.width)
        print(path.name, *(p.title for p in (*panels, panel)), sep=" | ", flush=True)


if __name__ == "__main__":
    main()
