"""Which parts pass through one another: by hlr's intersection lines, and by OpenCASCADE's common volumes.

    python -m peers.crossings FILES [--accuracy 0.05 0.01] [--limit 300]

A pair of parts with an intersection line needs a common volume, else the line is wrong. A common volume needs a line,
else that is missing, unless

- it is thinner on paper than the accuracy, the depth up to which curved surfaces count as touching, or
- the box of one part lies within that of the other: a plate let into a block, flush, has no line but its own edges.

Exit code 1 if a line is wrong or missing. OpenCASCADE works in a process of its own: it may crash, or never end.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

import hlr
from hlr.drawing.drawing import Drawing
from hlr.source import open_source
from hlr.source.model import Source
from support.at_size import ALL_LINES
from support.programs import environment
from support.referee.reference import read_shape

Floats = npt.NDArray[np.float64]
Pair = tuple[int, int]

SHEET = (277.0, 190.0)
"""Millimetres: the inside of an A4 sheet."""
NEAR = 1e-6
"""Of a box: how far it may reach beyond another one within which it lies."""


@dataclass(frozen=True)
class Common:
    """The solids' boxes (n, 6), and per pair of solids twice the common volume over its surface, model units.

    That is the thickness of a thin volume. Pairs that OpenCASCADE did not get to are missing.
    """

    boxes: Floats
    thickness: dict[Pair, float]


def common_volumes(path: Path, limit: float) -> Common:
    """By OpenCASCADE's Boolean operations. limit: seconds for all pairs."""
    command = [sys.executable, "-P", "-m", "peers.crossings", str(path), "--volumes"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment()) as process:
        try:
            told, _ = process.communicate(timeout=limit)
        except subprocess.TimeoutExpired:
            process.kill()
            told, _ = process.communicate()
    boxes, *pairs = [json.loads(line) for line in told.splitlines() if line.endswith("]")] or [[]]
    return Common(np.array(boxes, float).reshape(-1, 6), {(i, j): thick for i, j, thick in pairs})


def write_volumes(path: Path) -> None:
    """Print the boxes of the solids, then a line per pair whose boxes overlap."""
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Common
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    solids = _solids(read_shape(path))
    boxes = np.array([_box(solid) for solid in solids]).reshape(-1, 6)
    print(json.dumps(boxes.tolist()), flush=True)
    for i, j in _overlapping(boxes):
        shape = BRepAlgoAPI_Common(solids[i], solids[j]).Shape()
        volume, surface = GProp_GProps(), GProp_GProps()
        BRepGProp.VolumeProperties_s(shape, volume)
        BRepGProp.SurfaceProperties_s(shape, surface)
        area = surface.Mass()
        print(json.dumps([i, j, 2.0 * abs(volume.Mass()) / area if area > 0.0 else 0.0]), flush=True)


def _solids(shape: Any) -> list[Any]:
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer

    found, explorer = [], TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_SOLID)
    while explorer.More():
        found.append(explorer.Current())
        explorer.Next()
    return found


def _box(shape: Any) -> tuple[float, ...]:
    from OCP.Bnd import Bnd_Box
    from OCP.BRepBndLib import BRepBndLib

    box = Bnd_Box()
    BRepBndLib.AddOptimal_s(shape, box, False, False)
    if box.IsVoid():
        return (0.0,) * 6
    corners: tuple[float, ...] = box.Get()
    return corners


def _overlapping(boxes: Floats) -> list[Pair]:
    low, high = boxes[:, :3], boxes[:, 3:]
    meet = ((low[:, None] < high[None]) & (low[None] < high[:, None])).all(axis=2)
    return [(int(i), int(j)) for i, j in np.argwhere(np.triu(meet, 1))]


@dataclass(frozen=True)
class Compared:
    """Pairs of solids: with lines and a common volume, with lines alone, and with a common volume alone.

    untold  pairs with lines for which OpenCASCADE told no volume, or whose part is no solid
    """

    both: list[Pair]
    wrong: list[Pair]
    missing: list[Pair]
    untold: int


def compare(drawing: Drawing, parts: Floats, common: Common) -> Compared:
    """parts: their boxes (p, 6), in the order of the drawing."""
    solid = [_nearest(box, common.boxes) for box in parts]
    near, drawn, untold = set(_overlapping(common.boxes)), set(), 0
    for one, other in {(line.part, line.other) for line in drawing.lines if line.kind == "intersection"}:
        if other is None or one == other:
            continue
        a, b = solid[one], solid[other]
        pair = None if a is None or b is None else (min(a, b), max(a, b))
        if pair is None or (pair in near and pair not in common.thickness):
            untold += 1
        else:
            drawn.add(pair)
    touching = drawing.accuracy.used / (drawing.unit * drawing.scale)
    volumes = {pair for pair, thick in common.thickness.items() if thick > 0.0}
    missing = {
        pair
        for pair, thick in common.thickness.items()
        if thick > touching and pair not in drawn and not _one_within(*(common.boxes[k] for k in pair))
    }
    return Compared(sorted(drawn & volumes), sorted(drawn - volumes), sorted(missing), untold)


def _nearest(box: Floats, boxes: Floats) -> int | None:
    """The solid with this box; None if all are far from it."""
    if not len(boxes):
        return None
    off = np.abs(boxes - box).max(axis=1)
    best = int(off.argmin())
    return best if off[best] <= 0.05 * float((box[3:] - box[:3]).max()) else None


def _one_within(one: Floats, other: Floats) -> bool:
    def within(a: Floats, b: Floats) -> bool:
        spare = NEAR * float((b[3:] - b[:3]).max())
        return bool((a[:3] >= b[:3] - spare).all() and (a[3:] <= b[3:] + spare).all())

    return within(one, other) or within(other, one)


def part_boxes(source: Source, deflection: float) -> Floats:
    """(p, 6) the boxes of the meshes of all parts."""
    meshes = source.mesh(deflection, 0.5).parts
    return np.array([[*part.points.min(axis=0), *part.points.max(axis=0)] for part in meshes])


def compared(path: Path, accuracy: float, common: Common) -> tuple[Drawing, Compared]:
    """The drawing of a file, isometric, and its intersections beside the common volumes."""
    source = open_source(path)
    (drawing,) = hlr.draw_views(source, ["iso"], hlr.Options(accuracy=accuracy, fit=SHEET, **ALL_LINES))
    return drawing, compare(drawing, part_boxes(source, drawing.accuracy.deflection), common)


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", type=Path)
    parser.add_argument("--accuracy", type=float, nargs="+", default=[0.05, 0.01])
    parser.add_argument("--limit", type=float, default=300.0, help="seconds for the common volumes of a file")
    parser.add_argument("--volumes", action="store_true", help=argparse.SUPPRESS)
    given = parser.parse_args(arguments)
    if given.volumes:
        write_volumes(given.files[0])
        return 0
    bad = 0
    for path in given.files:
        common = common_volumes(path, given.limit)
        for accuracy in given.accuracy:
            _, found = compared(path, accuracy, common)
            bad += len(found.wrong) + len(found.missing)
            print(
                f"{path.name} at {accuracy:g} mm: {len(common.boxes)} solids, {len(found.both)} pairs cross, "
                f"wrong {found.wrong}, missing {found.missing}, not told {found.untold}",
                flush=True,
            )
    return int(bad > 0)


if __name__ == "__main__":
    raise SystemExit(main())
