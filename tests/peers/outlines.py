"""Whether outlines lie where the true surface is seen edge-on: `python -m peers.outlines FOLDER`.

Each point of an outline, before visibility, is put on the surface of its face by OpenCASCADE. The table has the largest
|N . v| there and the largest distance, in accuracies, of all outlines of all models, in an orthographic and a
perspective view.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

import hlr
from hlr.image.camera import Camera, resolve
from hlr.image.image import image_of
from hlr.image.outlines import outlined
from hlr.image.placement import place
from hlr.request.accuracy import Tolerances
from hlr.request.drawing_effects import drawing_effects
from hlr.request.effect import Planner
from hlr.request.options import Options
from hlr.scene.build import build
from hlr.source import open_source
from hlr.source.cad.shapes import sub_shapes
from support.at_size import ALL_LINES

ENDINGS = (".stp", ".step", ".igs", ".iges", ".brep")
SHEET = (277, 190)
VIEWS: tuple[tuple[Any, Options], ...] = (
    ("iso", Options(fit=SHEET, **ALL_LINES)),
    ((3, -2, 1.5), Options(fit=SHEET, perspective=hlr.Perspective(), **ALL_LINES)),
)


def outlines(scene: Any) -> Iterator[tuple[int, int, np.ndarray]]:
    """(part, face, points) of every outline."""
    chains = scene.walks
    for c in np.flatnonzero(chains.face >= 0):
        ends = scene.edges[chains.edges[chains.offsets[c] : chains.offsets[c + 1]]]
        yield int(chains.part[c]), int(chains.face[c]), scene.points[np.append(ends[:, 0], ends[-1, 1])]


def judged(face: Any, transform: np.ndarray, points: np.ndarray, camera: Camera) -> np.ndarray:
    """(n, 2): |N . v| and the distance in the model, by OpenCASCADE; NaN where its normal does not exist."""
    from OCP.BRep import BRep_Tool
    from OCP.GeomLProp import GeomLProp_SLProps
    from OCP.gp import gp_Pnt
    from OCP.ShapeAnalysis import ShapeAnalysis_Surface

    surface = BRep_Tool.Surface_s(face)
    find = ShapeAnalysis_Surface(surface)
    turn, shift = transform[:3, :3], transform[:3, 3]
    out = []
    for p in points:
        q = np.linalg.solve(turn, p - shift)
        uv = find.ValueOfUV(gp_Pnt(*q), 1e-12)
        props = GeomLProp_SLProps(surface, uv.X(), uv.Y(), 1, 1e-12)
        away = float(np.linalg.norm(turn @ (np.array(props.Value().Coord()) - q)))
        if not props.IsNormalDefined():
            out.append((np.nan, away))
            continue
        normal = turn @ np.array(props.Normal().Coord())
        sight = np.array(camera.direction) if camera.eye is None else np.array(camera.eye) - p
        out.append((abs(normal @ sight) / (np.linalg.norm(normal) * np.linalg.norm(sight)), away))
    return np.array(out)


def measured(path: Path, view: Any, options: Options) -> tuple[int, int, int, float, float]:
    """Outlines, their points, those above a millionth, the largest |N . v|, the largest distance in accuracies."""
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopoDS import TopoDS

    source = open_source(path)
    bounds = source.bounds()
    camera = resolve(view, options, source.frame, bounds)
    at = place(camera, options, source, bounds)
    tolerances: Tolerances = at.tolerances
    meshed = source.mesh(tolerances.deflection, tolerances.angle)
    bare = image_of(build(meshed, options.crease, tolerances.deflection), camera, at)
    scene = outlined(bare, Planner(drawing_effects(), options))
    faces = [sub_shapes(root, TopAbs_ShapeEnum.TopAbs_FACE) for root in source.prototypes.shapes]
    parts, values, count = source.parts, [np.zeros((0, 2))], 0
    for part, face, points in outlines(scene):
        own = parts[part]
        values.append(judged(TopoDS.Face_s(faces[own.prototype][face]), np.array(own.transform), points, camera))
        count += 1
    found = np.concatenate(values)
    slope = found[:, 0][~np.isnan(found[:, 0])]
    accuracy = float(tolerances.accuracy) / at.per_model
    over = int((slope > 1e-6).sum())
    return count, len(found), over, slope.max(initial=0.0), found[:, 1].max(initial=0.0) / accuracy


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--only", default="", help="part of a file's name")
    given = parser.parse_args()
    print("| model | view | outlines | points | above 1e-6 | largest | off by |\n|---|---|---|---|---|---|---|")
    for path in sorted(given.folder.rglob("*")):
        if path.suffix.lower() not in ENDINGS or given.only not in path.name:
            continue
        for view, options in VIEWS:
            try:
                count, points, over, slope, away = measured(path, view, options)
            except hlr.HlrError as error:
                print(f"| {path.name} | {error} |")
                break
            kind = "orthographic" if options.perspective is None else "perspective"
            print(f"| {path.name} | {kind} | {count} | {points} | {over} | {slope:.2g} | {away:.3f} |", flush=True)


if __name__ == "__main__":
    main()
