"""All methods on real models, picture by picture: python -m surfaces.real_models FOLDER... [--size 1920x1080]

Prints, for each model and view, which methods differ from the z-buffer and how long each took.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from hlr.errors import HlrError
from hlr.image.camera import resolve
from hlr.lab.methods import METHODS, NotFinishedError, render
from hlr.lab.methods.polygons import polygons_of
from hlr.request.accuracy import ANGLE, SMALL_DRAWING
from hlr.request.options import Options, Perspective
from hlr.scene.build import build
from hlr.source import open_source

ENDINGS = (".step", ".stp", ".iges", ".igs", ".brep", ".stl", ".obj", ".ply", ".off", ".3mf", ".glb")
VIEWS = (("iso", None), ("front", None), ("-2,1,3", Perspective()))


def different(path, size, limit, views=VIEWS):
    """(view, method, pixels that differ or None where it did not finish, seconds), for every method but the first."""
    source = open_source(path)
    bounds = source.bounds()
    deflection = float(((bounds[1] - bounds[0]) ** 2).sum() ** 0.5) / SMALL_DRAWING
    scene = polygons_of(build(source.mesh(deflection, ANGLE), 30.0, deflection))
    for view, perspective in views:
        direction = tuple(map(float, view.split(","))) if "," in view else view
        camera = resolve(direction, Options(perspective=perspective), source.frame, bounds)
        first = render(scene, camera, size, "z-buffer")
        for method in METHODS:
            try:
                found = render(scene, camera, size, method, time_limit=limit)
            except NotFinishedError:
                yield view, method, None, limit
                continue
            same = (found.ids == first.ids) & ((found.depth == first.depth) | (first.ids < 0))
            yield view, method, int((~same).sum()), found.statistics.seconds


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("models", nargs="+", type=Path)
    arguments.add_argument("--size", default="1920x1080")
    arguments.add_argument("--limit", type=float, default=20.0, help="seconds for each picture")
    given = arguments.parse_args()
    size = tuple(int(side) for side in given.size.split("x"))
    files = [f for m in given.models for f in ([m] if m.is_file() else sorted(m.rglob("*")))]
    wrong = pictures = late = 0
    for path in files:
        if path.suffix.lower() not in ENDINGS:
            continue
        try:
            for view, method, pixels, seconds in different(path, size, given.limit):
                pictures += pixels is not None
                late += pixels is None
                if pixels != 0:
                    wrong += pixels is not None
                    said = "not finished" if pixels is None else f"{pixels} pixels differ"
                    print(f"{path.name}, {view}, {method}: {said} ({seconds:.1f} s)", flush=True)
        except HlrError as error:
            print(f"{path.name}: refused: {error}", flush=True)
            continue
        print(f"{path.name}: done", flush=True)
    print(f"{pictures} pictures, {wrong} differ, {late} not finished")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
