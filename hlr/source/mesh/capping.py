"""The cut face of a closed body, made of the lines in which its triangles meet the plane, without a Boolean operation.

manifold3d moves what lies closer together than it can tell apart. Where a surface runs along itself, as of parts that
an exporter has joined to one surface, it may lose whole corners of the cut face.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from hlr.common.types import Floats, Ints
from hlr.source.mesh.clipping import split_at
from hlr.source.mesh.crossed_sides import crossings
from hlr.source.mesh.one_by_one import one_by_one
from hlr.source.stepped import Stepped

ALIKE = 1e-4
"""Of the length of all borders of cut faces, and of their area: what two ways to cut a body may differ by."""

MOST_SIDES = 20_000
"""Sides of a cut face beyond which nothing asks where they cross: each is compared with all others."""

PAIRS = 1_000_000
"""Corners times sides that are compared at a time."""

ROUNDING = 1e-9
"""Of the area of a cut face: what its triangles may overlap by."""


@dataclass(frozen=True, slots=True, eq=False)
class OpenBody:
    """A closed body, cut by a plane at z = 0 but not closed there.

    points (n, 3), triangles (m, 3); ends (k, 2): the sides of triangles at which it is open, in the sense of a cut face
    """

    points: Floats
    triangles: Ints
    ends: Ints

    def length(self) -> float:
        """Of the borders of all its faces at the plane."""
        level = self.triangles[_on_plane(self.points, self.triangles)]
        return _length(self.points, np.concatenate([self.ends, _open_sides(level, len(self.points))]))

    def area(self) -> float:
        """Of all its faces at the plane."""
        level = self.triangles[_on_plane(self.points, self.triangles)]
        return _area(self.points, self.ends) + float(_areas(self.points, level).sum())

    def faces(self) -> list[Ints] | None:
        """The triangles (m, 3) of each of its cut faces; None where the border of one crosses itself."""
        from manifold3d import triangulate

        made = []
        for loops in _faces(self.points, _loops(self.points, self.ends)):
            corners = np.concatenate(loops)
            found = corners[np.asarray(triangulate([self.points[loop, :2] for loop in loops]), np.int64)]
            whole = sum(_loop_area(self.points, loop) for loop in loops)
            if abs(np.abs(_areas(self.points, found)).sum() - whole) > ROUNDING * whole:
                return None
            made.append(found.astype(np.int32))
        return made

    def divided(self) -> OpenBody:
        """The same with a corner wherever two sides at which it is open pass through one another."""
        sides, at = crossings(self.points[self.ends, :2])
        if not len(sides):
            return self
        points = np.concatenate([self.points, np.column_stack([at, np.zeros(len(at))])])
        triangles = self.triangles.tolist()
        beside: dict[tuple[int, int], list[int]] = {}
        for row, corners in enumerate(triangles):
            for side in _sides(corners):
                beside.setdefault(side, []).append(row)
        for number in np.unique(sides).tolist():
            end, start = self.ends[number].tolist()
            new = len(self.points) + np.flatnonzero((sides == number).any(axis=1))
            new = new[np.argsort((points[new] - points[start]) @ (points[end] - points[start]))]
            # The triangle beside the side falls apart in a fan from its third corner.
            row = beside[start, end][-1]
            (apex,) = set(triangles[row]) - {start, end}
            for side in _sides(triangles[row]):
                beside[side].remove(row)
            fan = [[a, b, apex] for a, b in pairwise([start, *new.tolist(), end])]
            for part, corners in zip([row, *range(len(triangles), len(triangles) + len(new))], fan, strict=True):
                for side in _sides(corners):
                    beside.setdefault(side, []).append(part)
            triangles[row] = fan[0]
            triangles += fan[1:]
        made = np.array(triangles, np.int32)
        return OpenBody(points, made, _open_sides(made, len(points)))


def checked(
    points: Floats, triangles: Ints, number: npt.NDArray[np.int64], left: tuple[Floats, Ints], near: float
) -> tuple[Floats, Ints]:
    """What a cut at z = 0 has left of closed bodies if its cut faces are right; else they are cut here, if they can be.

    points (n, 3), triangles (m, 3): of the bodies; number (m,): of which of them each triangle is
    left: points (k, 3) and triangles (l, 3)
    near: what is no farther from z = 0 lies there
    """
    open_ones = _cut(points, triangles, number, near)
    if open_ones is None:
        return left
    length, area = sum(body.length() for body in open_ones), sum(body.area() for body in open_ones)
    faces = left[1][_on_plane(*left, near)]
    other = _length(left[0], _open_sides(faces, len(left[0])))
    if abs(length - other) <= ALIKE * length and abs(area - _areas(left[0], faces).sum()) <= ALIKE * abs(area):
        return left
    made = []
    for body in open_ones:
        divided, faces_of = body, body.faces()
        if faces_of is None and len(body.ends) <= MOST_SIDES:
            divided = body.divided()
            faces_of = divided.faces()
        if faces_of is None:
            return left
        made.append((divided.points, np.concatenate([divided.triangles, *faces_of])))
    return together(made)


def together(pieces: list[tuple[Floats, Ints]]) -> tuple[Floats, Ints]:
    """Points (n, 3) and triangles (m, 3) of several meshes as one."""
    first = np.cumsum([0, *(len(points) for points, _ in pieces)]).astype(np.int32)
    moved = [rows + k for (_, rows), k in zip(pieces, first, strict=False)]
    return np.concatenate([points for points, _ in pieces]), np.concatenate(moved)


def _cut(points: Floats, triangles: Ints, number: npt.NDArray[np.int64], near: float) -> list[OpenBody] | None:
    """What lies below z = 0 of each body; None where they are open elsewhere as well."""
    up, right = np.eye(3)[2], np.eye(3)[0]
    found = split_at(points, triangles, Stepped(up, right, np.zeros(1), np.zeros(0)), near)
    put = found.points.copy()
    put[np.abs(put[:, 2]) <= near, 2] = 0.0
    heights = put[found.triangles][..., 2]
    stays = np.where((heights == 0.0).all(axis=1), _areas(put, found.triangles) > 0.0, heights.sum(axis=1) < 0.0)
    a, b, c = found.triangles.T
    stays &= (a != b) & (b != c) & (c != a)
    open_ones = []
    for each in one_by_one(found.triangles[stays], number[found.of][stays]):
        # Only its own points: of many bodies each would go through those of all others.
        used, renumbered = np.unique(each, return_inverse=True)
        points, own = put[used], renumbered.reshape(-1, 3).astype(np.int32)
        ends = _open_sides(own, len(points))
        if points[ends][..., 2].any():
            return None
        open_ones.append(OpenBody(points, own, ends))
    return open_ones


def _sides(corners: list[int]) -> list[tuple[int, int]]:
    a, b, c = corners
    return [(a, b), (b, c), (c, a)]


def _open_sides(triangles: Ints, count: int) -> Ints:
    """(k, 2) the sides that a closed surface would have beside triangles (m, 3) of points, `count` in number."""
    start, end = triangles.ravel().astype(np.int64), np.roll(triangles, -1, axis=1).ravel().astype(np.int64)
    low, high = np.minimum(start, end), np.maximum(start, end)
    edge, number = np.unique(low * count + high, return_inverse=True)
    balance = np.bincount(number, np.where(start < end, 1, -1), len(edge)).astype(np.int64)
    ends = np.stack([edge // count, edge % count], axis=1).astype(np.int32)
    ends = np.where((balance > 0)[:, None], ends[:, ::-1], ends)
    return np.repeat(ends, np.abs(balance), axis=0)


def _on_plane(points: Floats, triangles: Ints, near: float = 0.0) -> npt.NDArray[np.bool_]:
    return np.asarray((np.abs(points[:, 2]) <= near)[triangles].all(axis=1))


def _length(points: Floats, ends: Ints) -> float:
    return float(np.linalg.norm(points[ends[:, 1]] - points[ends[:, 0]], axis=1).sum())


def _area(points: Floats, ends: Ints) -> float:
    """That sides (k, 2) go around, seen from above."""
    a, b = points[ends[:, 0]], points[ends[:, 1]]
    return float(0.5 * (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum())


def _areas(points: Floats, triangles: Ints) -> Floats:
    """(m,) of triangles (m, 3), seen from above."""
    a, b, c = points[triangles][..., :2].transpose(1, 2, 0)
    return np.asarray(0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])))


def _loop_area(points: Floats, loop: Ints) -> float:
    return _area(points, np.stack([loop, np.roll(loop, -1)], axis=1))


def _loops(points: Floats, ends: Ints) -> list[Ints]:
    """Sides (k, 2) as loops. Where several meet in a point, each turns as far to the left as it can."""
    onward: dict[int, list[int]] = {}
    for a, b in ends.tolist():
        onward.setdefault(a, []).append(b)
    loops = []
    while onward:
        way = [next(iter(onward))]
        seen = {way[0]: 0}
        while True:
            at = way[-1]
            then = _leftmost(points, way[-2] if len(way) > 1 else None, at, onward[at])
            onward[at].remove(then)
            if not onward[at]:
                del onward[at]
            if then in seen:
                loops.append(np.array(way[seen[then] :], np.int32))
                for point in way[seen[then] + 1 :]:
                    del seen[point]
                way = way[: seen[then] + 1]
                if len(way) == 1:
                    break
            else:
                seen[then] = len(way)
                way.append(then)
    return [loop for loop in loops if len(loop) > 2]


def _leftmost(points: Floats, before: int | None, at: int, following: list[int]) -> int:
    if before is None or len(following) == 1:
        return following[0]
    came = complex(*(points[at] - points[before])[:2])
    turns = [np.angle(complex(*(points[each] - points[at])[:2]) * came.conjugate()) for each in following]
    return following[int(np.argmax(turns))]


def _faces(points: Floats, loops: list[Ints]) -> list[list[Ints]]:
    """Loops by faces: each that runs anticlockwise, and the holes in it."""
    areas = np.array([_loop_area(points, loop) for loop in loops])
    outer = [k for k in np.argsort(areas).tolist() if areas[k] > 0.0]
    faces = {k: [loops[k]] for k in outer}
    for k in np.flatnonzero(areas < 0.0).tolist():
        around = (n for n in outer if areas[n] > -areas[k] and _is_inside(points, loops[k], loops[n]))
        if (holder := next(around, None)) is not None:
            faces[holder].append(loops[k])
    return list(faces.values())


def _is_inside(points: Floats, loop: Ints, around: Ints) -> bool:
    """Whether most corners of a loop lie inside of another one."""
    a, b = points[around][:, :2].T, points[np.roll(around, -1)][:, :2].T
    inside, few = 0, max(1, PAIRS // len(around))
    for first in range(0, len(loop), few):
        x, y = points[loop[first : first + few]][:, None, :2].transpose(2, 0, 1)
        crossed = (a[1] <= y) != (b[1] <= y)
        with np.errstate(divide="ignore", invalid="ignore"):
            right = a[0] + (y - a[1]) * (b[0] - a[0]) / (b[1] - a[1]) > x
        inside += int(np.count_nonzero((crossed & right).sum(axis=1) % 2))
    return 2 * inside > len(loop)
