"""Circles of meshes: a crease or border whose vertices all lie on a circle is drawn as that circle, on request.

The vertices of a regular polygon lie on a circle, too. The angle between neighbours, seen from the centre, decides:

::

      hexagon: 60 degrees        rim of a coarse cylinder: 16 chords of 22.5 degrees
        ____                            ___
       /    \\                         /     \\      each must be less than the crease angle: where the surface folds
       \\____/                         \\ ___ /      by more, an edge is drawn, and the figure is meant to have corners

Twelve chords of 30 degrees are a polygon with the usual crease of 30, thirteen may be a circle; an octagon never
is, whatever the crease (`Plan.step`). A chord much longer than the others is a flat, not a part of the circle.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, atan2, cos, degrees, fsum, hypot, isfinite, sqrt, tau

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.types import Floats, Ints
from hlr.image.camera import Camera
from hlr.image.image import Image
from hlr.request.accuracy import CIRCLE_FIT
from hlr.source.curve_records import ELLIPSE, Record, pack_curves
from hlr.source.model import Curves
from hlr.tables.line_classes import EdgeClass
from hlr.visibility.plan import Plan

FEWEST = 5
"""Vertices of an arc."""

LEAST_SPAN = 30.0
"""Degrees: a shorter arc could be any curve."""

UNEVEN = 2.0
"""A chord longer than this many times the usual one is a flat, unless it is within the accuracy of the circle."""

Point = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Circles:
    """curves: n records; number (c,) of each chain's circle, -1 for none.

    bulge (n,): the most that a circle rises above its chords, millimetres on paper
    """

    curves: Curves
    number: Ints
    bulge: Floats


def circles(image: Image, plan: Plan, chains: _kernel.Chains) -> Circles | None:
    """The circles along creases and borders of meshes; None where there are none, or none were asked for."""
    if plan.step <= 0.0 or image.has_faces.all():
        return None
    bare = ~image.has_faces[chains.part]
    wanted = bare & np.isin(chains.kind, (EdgeClass.SHARP, EdgeClass.BOUNDARY))
    offsets, walked, backward = chains.offsets, chains.edges, chains.reversed
    wanted &= np.diff(offsets) >= FEWEST - 1
    number = np.full(len(wanted), -1, np.int32)
    allowed = CIRCLE_FIT * image.placement.tolerances.accuracy
    records: list[Record] = []
    bulges: list[float] = []
    for chain in np.flatnonzero(wanted).tolist():
        span = slice(offsets[chain], offsets[chain + 1])
        points = _vertices(image, image.edges[walked[span]], backward[span])
        if points is None or _bent(points, 2.0 * plan.step):
            continue
        on_paper = image.placement.per_model * _magnified(image.camera, points)
        found = _circle([tuple(p) for p in points.tolist()], allowed / on_paper, plan.step)
        if found is not None:
            record, bulge = found
            number[chain] = len(records)
            records.append(record)
            bulges.append(bulge * on_paper)
    return Circles(pack_curves(records), number, np.array(bulges)) if records else None


def _vertices(image: Image, edges: Ints, backward: npt.NDArray[np.bool_]) -> Floats | None:
    """(n, 3) along a walk over edges (k, 2), the first one again at the end of a loop; None where something was clipped
    away."""
    start = np.where(backward, edges[:, 1], edges[:, 0])
    end = np.where(backward, edges[:, 0], edges[:, 1])
    if (start[1:] != end[:-1]).any():
        return None
    points: Floats = image.points[np.append(start, end[-1])]
    return points


def _bent(points: Floats, most: float) -> bool:
    """Whether a chain turns by more than `most` radians anywhere: a quick test that rules out most chains."""
    way = np.diff(points, axis=0)
    one, two = way[:-1], way[1:]
    size = np.sqrt((one * one).sum(axis=1) * (two * two).sum(axis=1))
    return bool(((one * two).sum(axis=1) < cos(most) * size).any())


def _magnified(camera: Camera, points: Floats) -> float:
    """How much larger than in the image plane the nearest of the points (n, 3) is drawn."""
    if camera.eye is None or camera.distance is None:
        return 1.0
    return camera.distance / max(float(camera.ahead(points).min()), 1e-9 * camera.distance)


def _circle(points: list[Point], most: float, step: float) -> tuple[Record, float] | None:
    """The circle that passes the points within `most`, and how far it rises above their chords; both in model units.

    step: radians between neighbouring vertices, which all must be below; None where there is no such circle
    """
    closed = points[0] == points[-1]
    ring = points[:-1] if closed else points
    n = len(ring)
    middle = _scaled([fsum(p[k] for p in ring) for k in range(3)], 1.0 / n)
    away = [_minus(p, middle) for p in ring]
    normal = _sum([_cross(away[i - 1], away[i]) for i in range(n)])
    size = sqrt(_dot(normal, normal))
    if not isfinite(size) or size == 0.0:
        return None
    normal = _scaled(normal, 1.0 / size)
    centre = _centre(away, normal)
    if centre is None:
        return None
    spokes = [_minus(p, centre) for p in away]
    rises = [_dot(s, normal) for s in spokes]
    spokes = [_minus(s, _scaled(normal, rise)) for s, rise in zip(spokes, rises, strict=True)]
    lengths = [sqrt(_dot(s, s)) for s in spokes]
    radius = fsum(lengths) / n
    if max(hypot(rise, length - radius) for rise, length in zip(rises, lengths, strict=True)) > most:
        return None
    first = _scaled(spokes[0], 1.0 / lengths[0])
    second = _cross(normal, first)
    angles = [atan2(_dot(s, second), _dot(s, first)) for s in spokes]
    steps = [(b - a) % tau for a, b in zip(angles, angles[1:] + (angles[:1] if closed else []), strict=False)]
    whole = fsum(steps)
    if not _round(steps, radius, most, step) or abs(whole - tau) > 1e-6 if closed else whole > tau:
        return None
    if degrees(whole) < LEAST_SPAN:
        return None
    values = np.array([*_sum([middle, centre]), *_scaled(first, radius), *_scaled(second, radius)])
    return (ELLIPSE, 0.0, tau if closed else whole, values), radius * (1.0 - cos(0.5 * max(steps)))


def _round(steps: list[float], radius: float, most: float, step: float) -> bool:
    """Whether no vertex is a corner and no chord a flat. steps: radians between neighbouring vertices."""
    if max(steps) >= step * (1.0 - 1e-6):
        return False
    # The usual chord: half of the circle is made of longer ones.
    ordered = sorted(steps)
    half, total = 0.5 * fsum(ordered), 0.0
    usual = ordered[-1]
    for usual in ordered:
        total += usual
        if total >= half:
            break
    near = 2.0 * acos(max(1.0 - most / radius, 0.0))
    return max(steps) <= max(UNEVEN * usual, near)


def _centre(away: list[Point], normal: Point) -> Point | None:
    """The centre by least squares in the plane (I. Kasa, 1976), for points about the origin."""
    pole = min(range(3), key=lambda k: abs(normal[k]))
    axis = tuple(1.0 if k == pole else 0.0 for k in range(3))
    u = _cross(normal, (axis[0], axis[1], axis[2]))
    u = _scaled(u, 1.0 / sqrt(_dot(u, u)))
    v = _cross(normal, u)
    flat = [(_dot(p, u), _dot(p, v)) for p in away]
    # Coordinates about their mean separate the radius from the centre: two of the three equations remain.
    xx, xy, yy = (fsum(p[i] * p[j] for p in flat) for i, j in ((0, 0), (0, 1), (1, 1)))
    zx, zy = (fsum(p[i] * (p[0] * p[0] + p[1] * p[1]) for p in flat) for i in (0, 1))
    det = xx * yy - xy * xy
    if not det > 1e-12 * xx * yy:
        return None
    x, y = 0.5 * (zx * yy - zy * xy) / det, 0.5 * (zy * xx - zx * xy) / det
    return _sum([_scaled(u, x), _scaled(v, y)])


def _minus(a: Point, b: Point) -> Point:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def _scaled(a: Point | list[float], s: float) -> Point:
    return (a[0] * s, a[1] * s, a[2] * s)


def _dot(a: Point, b: Point) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Point, b: Point) -> Point:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _sum(points: list[Point]) -> Point:
    return (fsum(p[0] for p in points), fsum(p[1] for p in points), fsum(p[2] for p in points))
