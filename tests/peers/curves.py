"""How far the emitted curves lie from the true ones: `python -m peers.curves FOLDER`.

For every B-rep model of a folder, in an orthographic and a perspective view, each line of an edge is sampled densely
and measured against OpenCASCADE's own evaluation of that edge, projected to paper. Beside it, the size of the SVG and
that of CadQuery's.
"""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

import hlr
from hlr.drawing.saving import render
from hlr.source import open_source
from support.at_size import ALL_LINES
from support.true_curves import measured, true_curves

ENDINGS = (".stp", ".step", ".igs", ".iges", ".brep")
SHEET = (277, 190)
"""What fits on A4, in millimetres: models of 39 m and of 4 mm are as demanding there."""


def cadquery_size(path: Path) -> int | None:
    """Bytes of CadQuery's SVG in the same view; None where it cannot read the file."""
    import cadquery as cq
    from cadquery import exporters

    if path.suffix.lower() not in (".stp", ".step"):
        return None
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "out.svg"
        exporters.export(cq.importers.importStep(str(path)), str(target), opt={"projectionDir": (1, -1, 1)})
        return target.stat().st_size


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--only", default="", help="part of a file's name")
    parser.add_argument("--cadquery", action="store_true", help="measure CadQuery's SVG as well")
    arguments = parser.parse_args()
    print(
        "| model | view | curves off by | polylines | forms | SVG | CadQuery | worst |",
        "|---|---|---|---|---|---|---|---|",
        sep="\n",
    )
    for path in sorted(arguments.folder.rglob("*")):
        if path.suffix.lower() not in ENDINGS or arguments.only not in path.name:
            continue
        try:
            source = open_source(path)
            drawings = hlr.draw_views(path, ["iso"], hlr.Options(fit=SHEET, **ALL_LINES))
            drawings += hlr.draw_views(
                path, [(3, -2, 1.5)], hlr.Options(fit=SHEET, perspective=hlr.Perspective(), **ALL_LINES)
            )
        except hlr.HlrError as error:
            print(f"| {path.name} | {error} |")
            continue
        theirs = cadquery_size(path) if arguments.cadquery else None
        true = true_curves(source)
        for drawing in drawings:
            curve, polyline, forms, where = measured(drawing, true)
            told = ", ".join(f"{n} {name}" for name, n in sorted(forms.items()))
            print(
                f"| {path.name} | {drawing.view.projection} | {curve:.3f} | {polyline:.3f} | {told} "
                f"| {len(render(drawing, 'svg'))} | {theirs or ''} | {where} |",
                flush=True,
            )


if __name__ == "__main__":
    main()
