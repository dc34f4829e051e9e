"""One row as the scan-line methods see it: for teaching, and for the worked examples of the literature."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from hlr import _kernel
from hlr.image.camera import Camera
from hlr.lab.methods.limits import limits
from hlr.lab.methods.polygons import Polygons, checked_values, polygons_of
from hlr.lab.methods.viewport import Screen, Viewport, viewport

Span = tuple[int, int, list[int]]


@dataclass(frozen=True, slots=True)
class EdgeRecord:
    """An entry of the active edge list: its values in one row, and their increments from row to row.

    polygon, edge  edge k starts at the polygon's corner k
    x, dx          in pixels; dx is 1 / m for the slope m of the edge
    z, dz          depth of the plane Ax + By + Cz + D = 0 along the edge; dz is -(A / m + B) / C
    values, steps  values interpolated from the corners, and their increments; only if values were given
    """

    polygon: int
    edge: int
    x: float
    dx: float
    z: float
    dz: float
    values: tuple[float, ...] | None = None
    steps: tuple[float, ...] | None = None


def _prepared(scene: Any, camera: Camera | Screen, size: tuple[int, int], rule: str) -> tuple[Polygons, Viewport]:
    polygons = polygons_of(scene, rule)
    return polygons, viewport(camera, polygons.points, size)


def _row(
    polygons: Polygons, port: Viewport, row: int, values: Any = None
) -> tuple[list[_kernel.RasterRecord], list[Span]]:
    within = limits()
    with within.over("the scan of a row"):
        return polygons.kernel(values, within).scan_row(port.kernel(), row, within.kernel())


def active_edges(
    scene: Any, camera: Camera | Screen, size: tuple[int, int], row: int, rule: str = "even-odd"
) -> list[tuple[int, int, float]]:
    """The active edge list of a row, left to right: (polygon, edge, x in pixels); edge k starts at corner k."""
    polygons, port = _prepared(scene, camera, size, rule)
    return [(polygon, edge, x[0]) for polygon, edge, x, _, _ in _row(polygons, port, row)[0]]


def edge_records(
    scene: Any,
    camera: Camera | Screen,
    size: tuple[int, int],
    row: int,
    rule: str = "even-odd",
    values: Any = None,
) -> list[EdgeRecord]:
    """The active edge list of a row with all that an entry holds; values (points, 3) as for `render`.

    Raises OptionError for values of another shape.
    """
    polygons, port = _prepared(scene, camera, size, rule)
    found = _row(polygons, port, row, checked_values(values, polygons))[0]
    return [EdgeRecord(polygon, edge, x[0], x[1], z[0], z[1], *_pair(v)) for polygon, edge, x, z, v in found]


def _pair(found: list[list[float]] | None) -> tuple[tuple[float, ...] | None, tuple[float, ...] | None]:
    return (None, None) if found is None else (tuple(found[0]), tuple(found[1]))


def spans(scene: Any, camera: Camera | Screen, size: tuple[int, int], row: int, rule: str = "even-odd") -> list[Span]:
    """The spans between neighbouring edges of a row: (from, to, polygons that cover it), columns, end exclusive."""
    polygons, port = _prepared(scene, camera, size, rule)
    return _row(polygons, port, row)[1]


def crossing_pairs(
    scene: Any, camera: Camera | Screen, size: tuple[int, int], rule: str = "even-odd"
) -> list[tuple[int, int, int, int]]:
    """Pairs of edges that the merged edge list forms, in order of completion: (row, from, to, polygon)."""
    polygons, port = _prepared(scene, camera, size, rule)
    within = limits()
    with within.over("pairing crossings"):
        flat: list[int] = polygons.kernel(within=within).pairs(port.kernel(), within.kernel()).tolist()
    return [(flat[k], flat[k + 1], flat[k + 2], flat[k + 3]) for k in range(0, len(flat), 4)]
