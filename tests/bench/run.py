"""Benchmarks beside the peers: one command for all tables, in Markdown.

    python -m bench.run                              all tables but the slow peers; medians of five
    python -m bench.run FOLDER FILE...               with STEP and BREP files of your own
    python -m bench.run --only svg,kernel --json out.json
    python -m bench.run --slow --tori 125            PolyAlgo on 888,872 triangles; ten million as arrays

meshing    B-reps to triangles, beside BRepMesh at the same deflection: time, triangles, errors
svg        shape in memory to SVG on disk, triangulation included, beside CadQuery's export
sections   a section, beside the same with OpenCASCADE's cut
build123d  the same through the drop-in, beside build123d's own projection
kernel     hidden-line removal of one view, beside HLRBRep_PolyAlgo on the same triangles
arrays     `hlr.draw` of tori as arrays
commands   whole commands: mesh files, and a STEP file with and without the cache (the first file that is given)

Pairs are measured in turns in one process, memory in processes of their own. Ratios below one are lost, and stand out.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
from collections.abc import Callable, Sequence
from pathlib import Path

from bench import brepmesh, cuts, loads, scenes
from bench.pairs import kernel_table, svg_table
from bench.table import Table

KERNEL_SCENES = ("plate20", "asm1000", "asm4000", "asm16000", "tori250")
SVG_SCENES = ("box", "filleted box", "sphere", "plate20", "asm1000", "asm4000")
SECTION_SCENES = ("filleted box", "plate20", "asm1000")
MESHING_SCENES = ("plate20", "asm1000", "asm4000")


def models(given: argparse.Namespace) -> list[str]:
    """The files that were given, and those of folders that hold a solid."""
    return [
        found for path in map(Path, given.files) for found in (scenes.solids(path) if path.is_dir() else [str(path)])
    ]


def tables(given: argparse.Namespace) -> dict[str, Callable[[], Table]]:
    """What can be measured, by name."""
    files = models(given)

    def chosen(known: Sequence[str]) -> list[str]:
        return [scene for scene in known if not given.scenes or scene in given.scenes]

    step = next((Path(name) for name in files if name.lower().endswith((".step", ".stp"))), None)
    shapes = [*chosen(SVG_SCENES), *files]
    return {
        "meshing": lambda: brepmesh.table([*chosen(MESHING_SCENES), *files], given.share, given.repeat),
        "svg": lambda: svg_table(shapes, given, "hlr-svg", "cadquery-svg", "CadQuery"),
        "sections": lambda: cuts.table([*chosen(SECTION_SCENES), *files], given.repeat),
        "build123d": lambda: svg_table(shapes, given, "hlr-build123d", "build123d", "build123d"),
        "kernel": lambda: kernel_table(chosen(KERNEL_SCENES), given),
        "arrays": lambda: loads.arrays(given.tori),
        "commands": lambda: loads.commands(given.repeat, step),
    }


def machine() -> str:
    """The machine of the measurements, and its other load."""
    load = ", ".join(f"{value:.1f}" for value in os.getloadavg()) if hasattr(os, "getloadavg") else "unknown"
    cores = os.cpu_count()
    return f"{platform.platform()}, {cores} cores, Python {platform.python_version()}; load average {load}"


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", help="STEP or BREP files, or folders of them")
    parser.add_argument("--only", type=lambda text: text.split(","), help="these tables, as listed above")
    parser.add_argument("--scenes", type=lambda text: text.split(","), help="of the scenes built in, only these")
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--budget", type=float, default=300.0, help="seconds after which a pair has no further turn")
    parser.add_argument("--timeout", type=float, default=1200.0, help="seconds for one process")
    parser.add_argument("--no-memory", dest="memory", action="store_false", help="do not measure memory")
    parser.add_argument("--slow", action="store_true", help="peers that take minutes too, once each")
    parser.add_argument("--exact", action="store_true", help="OpenCASCADE's exact algorithm beside the polygonal one")
    parser.add_argument("--tori", type=int, default=13, help="of 80,800 triangles each")
    parser.add_argument("--share", type=float, default=5e-5, help="of the model's diagonal: the deflection of meshing")
    parser.add_argument("--json", type=Path, help="a file for all figures")
    given = parser.parse_args(arguments)
    known = tables(given)
    for name in given.only or ():
        if name not in known:
            parser.error(f"--only takes {', '.join(known)}, not {name!r}")
    figures: dict[str, object] = {"machine": machine()}
    print(machine(), flush=True)
    for name in given.only or known:
        table = known[name]()
        print(f"\n## {name}\n\n{table}", flush=True)
        figures[name] = table.results
        if given.json:
            given.json.write_text(json.dumps(figures, indent=1))
    print(f"\nLoad average at the end: {machine().rpartition('average ')[2]}")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
