"""OpenCASCADE's mesher and hidden-line algorithms and the exporters of CadQuery and build123d, timed."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

from hlr.lab.rivals import opencascade
from hlr.lab.rivals.opencascade import HiddenLines

DIRECTION = (1.0, -1.0, 1.0)


def mesh(shape: Any, deflection: float, angle: float) -> float:
    """Triangulate with OpenCASCADE's defaults, in parallel. Seconds."""
    start = time.perf_counter()
    opencascade.mesh(shape, deflection, angle)
    return time.perf_counter() - start


def hide(shape: Any, algorithm: type[HiddenLines]) -> float:
    """One view by either algorithm, its result extracted, the exact one's with 3-D curves. Seconds."""
    start = time.perf_counter()
    rival = algorithm(shape, DIRECTION)
    rival.hide()
    rival.extract()
    rival.flat_compounds()
    return time.perf_counter() - start


def build123d_svg(shape: Any, path: Path) -> float:
    """build123d's `project_to_viewport` and its `ExportSVG`, without their import. Seconds."""
    import build123d as bd

    whole = bd.Compound(shape)
    whole.center()
    start = time.perf_counter()
    write_build123d(*whole.project_to_viewport(tuple(1000 * c for c in DIRECTION)), path)
    return time.perf_counter() - start


def write_build123d(visible: Any, hidden: Any, path: Path) -> None:
    """Two layers, as build123d's documentation does it."""
    import build123d as bd

    exporter = bd.ExportSVG()
    exporter.add_layer("visible")
    exporter.add_layer("hidden", line_type=bd.LineType.ISO_DOT)
    exporter.add_shape(visible, layer="visible")
    exporter.add_shape(hidden, layer="hidden")
    exporter.write(str(path))


def cadquery_svg(shape: Any, path: Path) -> float:
    """`cadquery.exporters.export(..., "SVG")` with hidden lines, without its import. Seconds."""
    import cadquery as cq
    from cadquery.occ_impl.exporters.svg import getSVG

    start = time.perf_counter()
    path.write_text(getSVG(cq.Shape.cast(shape), {"projectionDir": DIRECTION, "showHidden": True}))
    return time.perf_counter() - start
