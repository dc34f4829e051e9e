"""One row as the scan-line methods see it: for teaching, and for the worked examples of the literature."""

from __future__ import annotations

from typing import Any

from hlr.surfaces.limits import limits
from hlr.surfaces.polygons import Polygons, polygons_of
from hlr.surfaces.viewport import Screen, Viewport, viewport
from hlr.view.camera import Camera

Span = tuple[int, int, list[int]]


def _prepared(scene: Any, camera: Camera | Screen, size: tuple[int, int], rule: str) -> tuple[Polygons, Viewport]:
    polygons = polygons_of(scene, rule)
    return polygons, viewport(camera, polygons.points, size)


def _row(polygons: Polygons, port: Viewport, row: int) -> tuple[list[tuple[int, int, float]], list[Span]]:
    within = limits()
    with within.over("the scan of a row"):
        return polygons.kernel(within=within).scan_row(port.kernel(), row, within.kernel())


def active_edges(
    scene: Any, camera: Camera | Screen, size: tuple[int, int], row: int, rule: str = "even-odd"
) -> list[tuple[int, int, float]]:
    """The active edge list of a row, left to right: (polygon, edge, x in pixels); edge k starts at corner k."""
    polygons, port = _prepared(scene, camera, size, rule)
    return _row(polygons, port, row)[0]


def spans(scene: Any, camera: Camera | Screen, size: tuple[int, int], row: int, rule: str = "even-odd") -> list[Span]:
    """Between neighbouring crossings of a row, (from, to, polygons that are in), columns end exclusive."""
    polygons, port = _prepared(scene, camera, size, rule)
    return _row(polygons, port, row)[1]


def crossing_pairs(
    scene: Any, camera: Camera | Screen, size: tuple[int, int], rule: str = "even-odd"
) -> list[tuple[int, int, int, int]]:
    """(row, from, to, polygon): how the merged edge list pairs crossings, in the order in which pairs are complete."""
    polygons, port = _prepared(scene, camera, size, rule)
    within = limits()
    with within.over("pairing crossings"):
        flat: list[int] = polygons.kernel(within=within).pairs(port.kernel(), within.kernel()).tolist()
    return [(flat[k], flat[k + 1], flat[k + 2], flat[k + 3]) for k in range(0, len(flat), 4)]
