"""The same work done by hlr, timed: the kernel alone, the visibility stage of a drawing, shape to SVG file."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import numpy as np
from bench.triangulation import Triangulation

from hlr.request.drawing_effects import DEEP_EDGES, DEEP_GROUPS
from support.at_size import AT_SIZE

DIRECTION = (1.0, -1.0, 1.0)


class Kernel:
    """One isometric view of a triangulated shape, hidden lines on.

    The time covers the counterpart of OpenCASCADE's load, update and extraction: from triangles and the numbers of the
    drawn edges to visible and hidden pieces, including the edge table and the rotation into view space.
    """

    def __init__(self, shape: Any, contact: float) -> None:
        self._mesh = Triangulation(shape)
        self._contact = contact
        self.triangles = len(self._mesh.triangles)
        self.counters: dict[str, int] = {}

    def run(self) -> float:
        from hlr import _kernel

        mesh = self._mesh
        start = time.perf_counter()
        points = _camera().image(mesh.points)
        edges, offsets, incident = _kernel.edge_table(mesh.triangles, len(points))
        keys = edges[:, 0].astype(np.int64) * len(points) + edges[:, 1]
        role = np.full(len(edges), 2, np.uint8)
        # Both ascend, and few edges are drawn.
        place = np.searchsorted(keys, mesh.drawn)
        role[place[np.append(keys, -1)[place] == mesh.drawn]] = 1
        edge_part = mesh.triangle_part.take(incident.take(offsets[:-1]))
        closed = np.full(mesh.parts, True)
        given = _kernel.VisibilityInput.of(
            mesh.triangle_part,
            edge_part,
            role,
            cull=closed,
            sound=closed,
            delta=np.full(mesh.parts, self._contact),
            cap=np.full(mesh.parts, self._contact),
            tight=np.zeros(mesh.parts, bool),
            drawn=[],
        )
        whole = _kernel.Mesh(points, mesh.triangles, edges, offsets, incident)
        # As in a drawing.
        deep = mesh.parts >= DEEP_GROUPS and len(edges) >= DEEP_EDGES
        found = _kernel.visibility(whole, points, given, pyramid=deep)
        seconds = time.perf_counter() - start
        self.counters = {name: int(value) for name, value in found.counters.items()}
        self.counters["pieces"] = len(found.edge)
        return seconds


def _camera() -> Any:
    """x right, y up, z away from the viewer."""
    from hlr import _kernel

    toward = np.array(DIRECTION) / np.linalg.norm(DIRECTION)
    right = np.cross((0.0, 0.0, 1.0), toward)
    right /= np.linalg.norm(right)
    axes = (tuple(map(float, axis)) for axis in (toward, right, np.cross(toward, right)))
    return _kernel.Camera(*axes, None, 1.0)


def draw(shape: Any, accuracy: float) -> tuple[float, dict[str, int]]:
    """Seconds of the stage "visibility" of a whole drawing with its own tessellation; and its counters."""
    import hlr
    from hlr.request.options import Options

    (drawing,) = hlr.draw_views(shape, [DIRECTION], Options(accuracy=accuracy, **AT_SIZE))
    return float(drawing.timings["visibility"]), dict(drawing.counters)


def svg(shape: Any, path: Path) -> float:
    """Seconds from a shape without triangulation to an SVG file, hidden lines on, default accuracy."""
    import hlr

    start = time.perf_counter()
    hlr.draw(shape, view=DIRECTION, hidden=True, scale=1.0, smooth=False).save(path)
    return time.perf_counter() - start


def build123d_svg(shape: Any, path: Path) -> float:
    """The drop-in of build123d's `project_to_viewport`, and build123d's own `ExportSVG`. Seconds."""
    import build123d as bd
    from bench.occt import write_build123d

    from hlr.compat.build123d import project_to_viewport

    whole = bd.Compound(shape)
    whole.center()
    start = time.perf_counter()
    write_build123d(*project_to_viewport(whole, tuple(1000 * c for c in DIRECTION)), path)
    return time.perf_counter() - start
