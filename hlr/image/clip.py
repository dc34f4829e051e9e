"""Cut an image by planes before a perspective view: the near plane, and the frame where the eye is given.

An image is cut only where something crosses a plane. A body that one looks into through the cut is open, so culling is
switched off for it: its faces are seen from behind (`hlr.image.plane`).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np

from hlr import _kernel
from hlr.common.types import Floats, Ints
from hlr.image.camera import NEAR, Camera
from hlr.image.image import Image, Silhouettes
from hlr.image.plane import Plane, Window
from hlr.request.effect import Facts, Planner
from hlr.request.options import Vector
from hlr.scene.walks import edge_keys
from hlr.tables.line_classes import INTERIOR


def planes(camera: Camera, aspect: float) -> list[Plane]:
    """The planes that bound what a perspective camera may see; none for parallel views."""
    near, sides = _volume(camera, aspect)
    return [*near, *sides]


def _volume(camera: Camera, aspect: float) -> tuple[list[Plane], list[Plane]]:
    """The near plane, and the sides of the frame. There is no far plane: nothing is too far to be drawn."""
    if camera.eye is None or camera.distance is None or camera.fov is None:
        return [], []
    eye = camera.eye
    d = camera.direction

    def at_eye(normal: Vector) -> float:
        return sum(n * e for n, e in zip(normal, eye, strict=True))

    near, ahead, sides, window = camera.distance * NEAR, (-d[0], -d[1], -d[2]), [], None
    if camera.framed:
        tangent = math.tan(math.radians(camera.fov) * 0.5)
        x, y, z = (e + near * a for e, a in zip(eye, ahead, strict=True))
        window = Window((x, y, z), camera.right, camera.up, (near * tangent * aspect, near * tangent))
        for axis, reach in ((camera.right, tangent * aspect), (camera.up, tangent)):
            for sign in (1.0, -1.0):
                x, y, z = (sign * a - reach * c for a, c in zip(axis, d, strict=True))
                sides.append(Plane((x, y, z), at_eye((x, y, z)), side=True))
    return [Plane(ahead, at_eye(ahead) + near, window=window)], sides


def clipped(image: Image, planner: Planner) -> Image:
    """The image cut at the near plane and at the frame, where something crosses them.

    A plane that nothing crosses leaves the image as it is. Forced clipping applies such planes as well.
    """
    camera, names = image.camera, ("near clipping", "side clipping")
    if camera.eye is None and not planner.forced:
        # A parallel view has no plane that anything could cross.
        planner.state(Facts(), *names)
        return image
    for name, cuts in zip(names, _volume(camera, image.placement.aspect), strict=True):
        if not cuts and not planner.forced:
            planner.state(Facts(perspective=camera.eye is not None), name)
            continue
        with planner.deciding():
            facts = Facts(perspective=camera.eye is not None, crossed=sum(_crossed(image, p) for p in cuts))
        begin = perf_counter()
        used = 0
        if planner.on(name, facts):
            image, used = clip(image, cuts or _around(image, name), every=facts.crossed == 0)
        planner.spent(name, perf_counter() - begin, **{name.replace(" clipping", "_cuts"): used})
    return image


def _around(image: Image, name: str) -> list[Plane]:
    """A near plane, or four side planes, that keep all of the image."""
    reach = 2.0 * float(np.abs(image.points).max(initial=0.0)) + 1.0
    camera = image.camera
    d = camera.direction
    near = [(-d[0], -d[1], -d[2])]
    sides = [(s * a[0], s * a[1], s * a[2]) for a in (camera.right, camera.up) for s in (1.0, -1.0)]
    return [Plane(normal, -2.0 * reach) for normal in (near if name == "near clipping" else sides)]


def _crossed(image: Image, plane: Plane) -> bool:
    """Whether anything lies beyond the plane. Only points of edges count: earlier cuts leave unused points behind."""
    beyond = plane.height(image.points) < 0.0
    return bool(beyond.any()) and bool(beyond[image.edges].any())


def clip(image: Image, cuts: list[Plane], every: bool = False) -> tuple[Image, int]:
    """The part of the image that all planes keep, and how many planes cut anything.

    every: planes that nothing crosses are applied as well.
    """
    used = 0
    for plane in cuts:
        crossed = _crossed(image, plane)
        used += crossed
        if crossed or every:
            image = _cut(image, plane)
    return (_compact(image) if used else image), used


def _compact(image: Image) -> Image:
    """The image without its unused points: behind the eye they have no place on paper."""
    used = np.zeros(len(image.points), bool)
    used[image.edges.ravel()] = True
    used[image.triangles.ravel()] = True
    number = (np.cumsum(used) - 1).astype(np.int32)
    true, met = image.true_points(), image.intersections
    return replace(
        image,
        points=image.points[used],
        intersections=replace(met, points=true[used]) if met is not None and true is not None else None,
        silhouettes=replace(image.silhouettes, lift=image.silhouettes.lift[used]) if image.silhouettes else None,
        triangles=np.ascontiguousarray(number[image.triangles]),
        edges=np.ascontiguousarray(number[image.edges]),
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Went:
    """Where the edges of an image went when it was cut: kept whole, shortened to a new vertex, or gone.

    target   (e,) the number that each has now; -1: gone
    swapped  (e,) whether its two ends have changed places: edges run from the lower vertex to the higher
    loose    (k, 2) those without triangles, such as free wires; they are numbered after all others
    """

    target: Ints
    swapped: np.ndarray
    loose: Ints


def _went(image: Image, inside: np.ndarray, new_vertex: Ints, edges: Ints, points: int) -> _Went:
    """Where the edges of an image go.

    inside (n,): points that are kept; new_vertex (e,): of an edge that is cut; edges (f, 2): of the triangles that are
    left; points: how many there are now
    """
    a, b = image.edges[:, 0], image.edges[:, 1]
    keep = inside[a] | inside[b]
    ends = image.edges.copy()
    for column, end, other in ((0, a, b), (1, b, a)):
        cut = ~inside[end] & inside[other]
        ends[cut, column] = new_vertex[cut]
    low_first = np.stack([ends.min(axis=1), ends.max(axis=1)], axis=1).astype(np.int32)
    key, known = edge_keys(low_first, points), edge_keys(edges, points)
    at = np.searchsorted(known, key)
    there = keep & (at < len(known))
    there[there] = known[at[there]] == key[there]
    loose = keep & ~there
    target = np.full(len(image.edges), -1, np.int32)
    target[there] = at[there]
    target[loose] = len(edges) + np.arange(np.count_nonzero(loose), dtype=np.int32)
    return _Went(target, ends[:, 0] > ends[:, 1], low_first[loose])


def _cut(image: Image, plane: Plane) -> Image:
    """The part of the image that a plane keeps."""
    height = plane.height(image.points)
    inside = height >= 0.0
    a, b = image.edges[:, 0], image.edges[:, 1]
    crossing = inside[a] != inside[b]
    n = len(image.points)
    new_vertex = np.full(len(image.edges), -1, np.int32)
    new_vertex[crossing] = n + np.arange(np.count_nonzero(crossing), dtype=np.int32)
    # Always from the lower to the higher vertex: both triangles at an edge get the same point.
    t = (height[a[crossing]] / (height[a[crossing]] - height[b[crossing]]))[:, None]
    pa, pb = image.points[a[crossing]], image.points[b[crossing]]
    points = np.concatenate([image.points, pa + (pb - pa) * t])

    triangles, parent = _cut_triangles(image, inside, new_vertex, n)
    edges, offsets, incident = _kernel.edge_table(triangles, len(points))
    went = _went(image, inside, new_vertex, edges, len(points))
    edges = np.concatenate([edges, went.loose])
    offsets = np.concatenate([offsets, np.full(len(went.loose), offsets[-1], np.int32)])
    kept = went.target >= 0

    def moved(old: np.ndarray, fill: int) -> np.ndarray:
        """A column of the old edges as one of the new edges; fill: of those that are new."""
        out = np.full(len(edges), fill, old.dtype)
        out[went.target[kept]] = old[kept]
        return out

    tied = np.diff(offsets) > 0
    first = incident[offsets[:-1][tied]]
    edge_part, edge_group = moved(image.edge_part, 0), moved(image.edge_group, 0)
    edge_part[tied] = image.triangle_part[parent][first]
    triangle_group = image.triangle_group[parent]
    edge_group[tied] = triangle_group[first]
    along = (triangles[:, 1] >= n) & (triangles[:, 2] >= n)
    starts, ends = points[triangles[along, 1]], points[triangles[along, 2]]
    open_now = plane.looked_into(starts, ends, triangle_group[along], len(image.groups))
    return replace(
        image,
        points=points,
        true_surfaces=None,
        crossed=None,
        convex=image.convex and not crossing.any(),
        silhouettes=_cut_silhouettes(image, crossing, t, went.target, moved),
        triangles=triangles,
        triangle_part=image.triangle_part[parent],
        triangle_group=triangle_group,
        triangle_face=image.triangle_face[parent],
        triangle_origin=image.triangle_origin[parent],
        turned=image.turned[parent],
        edges=np.ascontiguousarray(edges),
        offsets=offsets,
        incident=incident,
        edge_part=edge_part,
        edge_group=edge_group,
        edge_kind=moved(image.edge_kind, INTERIOR),
        edge_curved=moved(image.edge_curved, 0),
        groups=image.groups.opened(open_now),
        walks=image.walks.moved(went.target, went.swapped),
    )


def _cut_silhouettes(
    image: Image, crossing: np.ndarray, t: Floats, target: Ints, moved: Callable[[np.ndarray, int], np.ndarray]
) -> Silhouettes | None:
    """The silhouettes with new points at parameters t (k, 1) of the crossing edges.

    A shortened edge loses its own faces: it is compared with all faces alike.
    """
    old = image.silhouettes
    if old is None:
        return None
    a, b = old.lift[image.edges[crossing, 0]], old.lift[image.edges[crossing, 1]]
    return Silhouettes(
        lift=np.concatenate([old.lift, a + (b - a) * t]),
        hidden=moved(old.hidden, 0),
        number=moved(old.number, -1),
        curves=old.curves,
        source=old.source,
        own=old.own.renumbered(np.where(crossing, np.int32(-1), target)),
        first=old.first,
    )


def _cut_triangles(
    image: Image,
    inside: np.ndarray,
    new_vertex: Ints,
    n: int,
) -> tuple[Ints, Ints]:
    """Triangles on the kept side, and the triangle that each came from.

    ::

            2 inside            1 inside
          p-------q               p
           \\  / |              / \\
          .r-------- plane --- x---y --
    """
    tri = image.triangles
    side = inside[tri]
    count = side.sum(axis=1)
    whole = np.flatnonzero(count == 3).astype(np.int32)
    known = edge_keys(image.edges[: np.count_nonzero(np.diff(image.offsets) > 0)], n)

    def between(u: Ints, v: Ints) -> Ints:
        key = np.minimum(u, v).astype(np.int64) * n + np.maximum(u, v)
        return new_vertex[np.searchsorted(known, key)]

    one = np.flatnonzero(count == 1).astype(np.int32)
    k = np.argmax(side[one], axis=1)
    p, q, r = (tri[one, (k + i) % 3] for i in range(3))
    tips = np.stack([p, between(p, q), between(p, r)], axis=1)
    two = np.flatnonzero(count == 2).astype(np.int32)
    k = np.argmin(side[two], axis=1)
    r, p, q = (tri[two, (k + i) % 3] for i in range(3))
    x, y = between(q, r), between(p, r)
    first, second = np.stack([p, q, x], axis=1), np.stack([p, x, y], axis=1)
    triangles = np.ascontiguousarray(np.concatenate([tri[whole], tips, first, second]), np.int32)
    return triangles, np.concatenate([whole, one, two, two])
