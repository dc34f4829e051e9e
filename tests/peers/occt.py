"""OpenCASCADE's own hidden-line removal as a peer, handed over in the exchange format.

The exact algorithm gives its edges in 3-D. The polygonal one gives flat pieces only: each is lifted back onto the
triangle edge it came from, where several lie on one another in favour of the peer (see `peers.lift`).
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from peers.lift import Lifter

from hlr.lab.rivals.opencascade import ExactAlgo, PolyAlgo, mark_tangent_edges
from support.referee.exchange import Camera
from support.referee.reference import FINENESS, Floats, from_shape, read_shape, shape_diagonal

DIRECTIONS: dict[str, tuple[float, float, float]] = {
    "front": (0, -1, 0),
    "back": (0, 1, 0),
    "right": (1, 0, 0),
    "left": (-1, 0, 0),
    "top": (0, 0, 1),
    "bottom": (0, 0, -1),
    "iso": (1, -1, 1),
}
METHODS = ("exact", "poly")


def camera_of(view: str | Sequence[float]) -> Camera:
    """A named view or a direction; up is z, along z it is y."""
    name = view if isinstance(view, str) else ",".join(f"{value:.6g}" for value in view)
    direction = np.asarray(DIRECTIONS[view] if isinstance(view, str) else view, dtype=np.float64)
    direction = direction / np.linalg.norm(direction)
    up = np.array([0.0, 0.0, 1.0]) if abs(direction[2]) < 0.9999 else np.array([0.0, 1.0, 0.0])
    right = np.cross(up, direction)
    right = right / np.linalg.norm(right)
    return Camera(name, direction, right, np.cross(direction, right))


Lines = list[tuple[str, bool, Floats]]
"""Class, visibility, and points in the model (n, 3); flat ones (n, 2) where they have not been lifted."""


def _exact(shape: Any, camera: Camera, deflection: float) -> tuple[Lines, float]:
    """The lines, and the algorithm's seconds."""
    start = time.perf_counter()
    rival = ExactAlgo(shape, camera.direction, camera.right)
    rival.hide()
    rival.extract()
    seconds = time.perf_counter() - start
    return rival.lines(rival.compounds(), deflection), seconds


def _poly(shape: Any, camera: Camera, fineness: float, flat: bool) -> tuple[Lines, float]:
    """The same; meshing is not counted."""
    reference = from_shape(shape, fineness)
    start = time.perf_counter()
    rival = PolyAlgo(shape, camera.direction, camera.right)
    rival.hide()
    rival.extract()
    seconds = time.perf_counter() - start
    found = rival.lines(rival.compounds())
    if flat:
        return found, seconds
    lifter = Lifter(reference, camera)
    lifted = ((name, visible, lifter.lift(points, nearest=visible)) for name, visible, points in found)
    return [(name, visible, points) for name, visible, points in lifted if points is not None], seconds


def draw(
    shape: Any,
    method: str,
    camera: Camera,
    source: str = "shape",
    deflection: float | None = None,
    flat: bool = False,
) -> dict[str, Any]:
    """The drawing of one view as an exchange document; timings hold the peer's own seconds.

    flat: leave the polygonal algorithm's lines on paper, without `points3`; lifting loses those it finds no edge for.
    """
    diagonal = shape_diagonal(shape)
    if deflection is None:
        deflection = diagonal / FINENESS
    if method == "exact":
        lines, seconds = _exact(shape, camera, deflection)
    else:
        lines, seconds = _poly(shape, camera, diagonal / deflection, flat)
    axes = np.stack([camera.right, camera.up], axis=1)
    return {
        "format": "hlr-drawing",
        "version": 2,
        "source": source,
        "units": "mm",
        "accuracy": {},
        "view": {
            "name": camera.name,
            "projection": "orthographic",
            "direction": camera.direction.tolist(),
            "right": camera.right.tolist(),
            "up": camera.up.tolist(),
        },
        "scale": 1.0,
        "origin": [0.0, 0.0],
        "model": {"unit": 1.0, "up_axis": np.eye(3).tolist()},
        "parts": [{"name": source, "color": None, "transform": np.eye(4).tolist()}],
        "lines": [
            {
                "class": kind,
                "visible": visible,
                "part": 0,
                "edge": None,
                "face": None,
                "points": (points if points.shape[1] == 2 else points @ axes).tolist(),
                "points3": points.tolist() if points.shape[1] == 3 else None,
            }
            for kind, visible, points in lines
        ],
        "notes": [],
        "counters": {},
        "timings": {"total": seconds},
    }


def main(arguments: Sequence[str] | None = None) -> int:
    """Draw one file in one view; the referee runs this as a child, because the exact algorithm may never end."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("file", type=Path)
    parser.add_argument("--method", choices=METHODS, default="exact")
    parser.add_argument("--view", default="iso", help="a name or X,Y,Z")
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--deflection", type=float, help="of the triangulation and of curves; default: very fine")
    parser.add_argument("--flat", action="store_true", help="lines on paper only, tangent edges left out")
    given = parser.parse_args(arguments)
    view = given.view if given.view in DIRECTIONS else [float(value) for value in given.view.split(",")]
    shape = read_shape(given.file)
    if given.flat:
        mark_tangent_edges(shape)
    document = draw(shape, given.method, camera_of(view), given.file.name, given.deflection, given.flat)
    given.out.write_text(json.dumps(document))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
