"""Entities of DXF as lines of a sketch: what is straight, an arc or a Bezier curve stays that."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from typing import Any

from hlr.compare.lines.sketch import Pair, Sketch

CHORDS = 100
"""Of each piece of a curve that no Bezier curve of degree three is: a quarter of a circle of 100 mm is 0.003 mm off."""

_FRAME = 16
"""Flag of a vertex that is no point of the line."""

_CLOSED = 1


def _line(sketch: Sketch, entity: Any, scale: float) -> None:
    sketch.polyline([_flat(entity.dxf.start, scale), _flat(entity.dxf.end, scale)])


def _circle(sketch: Sketch, entity: Any, scale: float) -> None:
    _round(sketch, entity, scale, (0.0, math.tau))


def _arc(sketch: Sketch, entity: Any, scale: float) -> None:
    first, last = (math.radians(angle % 360.0) for angle in (entity.dxf.start_angle, entity.dxf.end_angle))
    _round(sketch, entity, scale, (first, last if last > first else last + math.tau))


def _round(sketch: Sketch, entity: Any, scale: float, angles: Pair) -> None:
    to_world, radius = entity.ocs().to_wcs, abs(entity.dxf.radius)
    centre, x, y = to_world(entity.dxf.center), to_world((radius, 0.0, 0.0)), to_world((0.0, radius, 0.0))
    sketch.arc(_flat(centre, scale), (_flat(x, scale), _flat(y, scale)), angles)


def _ellipse(sketch: Sketch, entity: Any, scale: float) -> None:
    first, last = entity.dxf.start_param % math.tau, entity.dxf.end_param % math.tau
    axes = _flat(entity.dxf.major_axis, scale), _flat(entity.minor_axis, scale)
    sketch.arc(_flat(entity.dxf.center, scale), axes, (first, last if last > first + 1e-9 else last + math.tau))


def _light_polyline(sketch: Sketch, entity: Any, scale: float) -> None:
    points = [((x, y, entity.dxf.elevation), bulge) for x, y, bulge in entity.get_points("xyb")]
    _bulged(sketch, points, entity.closed, entity.ocs().to_wcs, scale)


def _polyline(sketch: Sketch, entity: Any, scale: float) -> None:
    """Faces and meshes, which are polylines too, are drawn by their edges."""
    if entity.is_poly_face_mesh or entity.is_polygon_mesh:
        for each in entity.virtual_entities():
            corners = each.wcs_vertices(close=True)
            sketch.polyline([_flat(corner, scale) for corner in corners])
        return
    vertices = [each.dxf for each in entity.vertices if not each.dxf.flags & _FRAME]
    points = [(tuple(each.location), each.get("bulge", 0.0)) for each in vertices]
    to_world = entity.ocs().to_wcs if entity.is_2d_polyline else tuple
    _bulged(sketch, points, bool(entity.dxf.flags & _CLOSED), to_world, scale)


def _bulged(
    sketch: Sketch,
    points: list[tuple[Any, float]],
    closed: bool,
    to_world: Callable[[Any], Any],
    scale: float,
) -> None:
    """Straight lines and arcs; a bulge is the tangent of a quarter of the arc's turn, and leads to the next point."""
    chain = [*points, points[0]] if closed and points else points
    for (a, bulge), (b, _) in pairwise(chain):
        if abs(bulge) < 1e-9 or a == b:
            sketch.polyline([_flat(to_world(a), scale), _flat(to_world(b), scale)])
            continue
        (ax, ay, height), (bx, by, _) = a, b
        high = (1.0 / bulge - bulge) / 4.0
        x, y = 0.5 * (ax + bx) - high * (by - ay), 0.5 * (ay + by) + high * (bx - ax)
        radius, first = math.hypot(ax - x, ay - y), math.atan2(ay - y, ax - x)
        axes = to_world((radius, 0.0, 0.0)), to_world((0.0, radius, 0.0))
        angles = (first, first + 4.0 * math.atan(bulge))
        sketch.arc(_flat(to_world((x, y, height)), scale), (_flat(axes[0], scale), _flat(axes[1], scale)), angles)


def _spline(sketch: Sketch, entity: Any, scale: float) -> None:
    curve = entity.construction_tool()
    if curve.is_rational or not curve.is_clamped or curve.degree > 3:
        sketch.polyline([_flat(point, scale) for point in curve.points(_along(curve))])
        return
    for piece in curve.bezier_decomposition():
        points = [_flat(point, scale) for point in piece]
        if curve.degree == 1:
            sketch.polyline(points)
        else:
            sketch.cubic(*(points if curve.degree == 3 else _raised(*points)))


def _along(curve: Any) -> list[float]:
    """Parameters from one end of a spline to the other."""
    inside = curve.knots()[curve.order - 1 : curve.count + 1]
    knots = [knot for knot, following in pairwise(inside) if following > knot]
    ends = [*knots[1:], inside[-1]]
    steps = [(low + (high - low) * n / CHORDS) for low, high in zip(knots, ends, strict=True) for n in range(CHORDS)]
    return [*steps, inside[-1]]


def _raised(a: Pair, b: Pair, c: Pair) -> tuple[Pair, Pair, Pair, Pair]:
    """A quadratic Bezier curve as a cubic one."""
    first = (a[0] + 2.0 * b[0]) / 3.0, (a[1] + 2.0 * b[1]) / 3.0
    second = (c[0] + 2.0 * b[0]) / 3.0, (c[1] + 2.0 * b[1]) / 3.0
    return a, first, second, c


def _flat(point: Any, scale: float) -> Pair:
    return float(point[0]) * scale, float(point[1]) * scale


CURVES: dict[str, Callable[[Sketch, Any, float], None]] = {
    "LINE": _line,
    "CIRCLE": _circle,
    "ARC": _arc,
    "ELLIPSE": _ellipse,
    "LWPOLYLINE": _light_polyline,
    "POLYLINE": _polyline,
    "SPLINE": _spline,
    "HELIX": _spline,
}
"""What adds an entity of this type to the line that was begun; scale: millimetres per unit of the file."""
