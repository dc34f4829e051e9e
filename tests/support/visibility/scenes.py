"""Random scenes on tiny integer grids, so that nearly all have many coincident points and lines."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from support.visibility.oracle import Point, Segment, Triangle

Face = tuple[int, int, int]
Edge = tuple[int, int]
BOX_QUADS = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))


@dataclass(frozen=True)
class Scene:
    """Points, triangles, and wires: lines that belong to no triangle. The triangles' edges and the wires are drawn.

    parts    per triangle the number of its part; empty: all triangles are one part
    closed   every part is a closed solid with a volume above zero, wound outward
    """

    points: tuple[Point, ...]
    faces: tuple[Face, ...]
    wires: tuple[Edge, ...] = ()
    parts: tuple[int, ...] = ()
    closed: bool = False

    def arrays(self) -> tuple[np.ndarray, np.ndarray]:
        return (
            np.array(self.points, dtype=np.float64).reshape(-1, 3),
            np.array(self.faces, dtype=np.int32).reshape(-1, 3),
        )

    def triangles(self) -> list[Triangle]:
        return [(self.points[i], self.points[j], self.points[k]) for i, j, k in self.faces]

    def edges(self) -> list[Edge]:
        sides = {(min(i, j), max(i, j)) for f in self.faces for i, j in ((f[0], f[1]), (f[1], f[2]), (f[2], f[0]))}
        return sorted(edge for edge in sides | set(self.wires) if edge[0] != edge[1])

    def segment(self, edge: Edge) -> Segment:
        return self.points[edge[0]], self.points[edge[1]]

    def part_of(self, edge: Edge) -> int:
        """The part of the edge's first triangle; -1 for a wire."""
        inside = (number for number, face in enumerate(self.faces) if edge[0] in face and edge[1] in face)
        first = next(inside, None)
        return -1 if first is None else self.parts[first] if self.parts else 0

    def apart(self) -> Scene:
        """The same scene with no point shared between parts or with wires, as the kernel requires of parts."""
        numbers: dict[tuple[int, int], int] = {}

        def own(part: int, point: int) -> int:
            return numbers.setdefault((part, point), len(numbers))

        faces = [(own(p, i), own(p, j), own(p, k)) for p, (i, j, k) in zip(self.parts, self.faces, strict=True)]
        wires = [(own(-1, i), own(-1, j)) for i, j in self.wires]
        wires = sorted((min(i, j), max(i, j)) for i, j in wires)
        return replace(self, points=tuple(self.points[i] for _, i in numbers), faces=tuple(faces), wires=tuple(wires))

    def without_face(self, number: int) -> Scene:
        """Drop a triangle but go on drawing its edges, so that shrinking keeps the segment that fails."""
        f = self.faces[number]
        sides = {(min(i, j), max(i, j)) for i, j in ((f[0], f[1]), (f[1], f[2]), (f[2], f[0])) if i != j}
        faces = self.faces[:number] + self.faces[number + 1 :]
        parts = self.parts[:number] + self.parts[number + 1 :]
        return Scene(self.points, faces, tuple(sorted(set(self.wires) | sides)), parts)

    def without_part(self, number: int) -> Scene:
        """Drop a whole part: the rest stay closed."""
        keep = [index for index, part in enumerate(self.parts) if part != number]
        return replace(self, faces=tuple(self.faces[i] for i in keep), parts=tuple(self.parts[i] for i in keep))


class Builder:
    """Collects solids; `weld` decides whether equal points become one."""

    def __init__(self, weld: bool) -> None:
        self._weld = weld
        self._known: dict[Point, int] = {}
        self.points: list[Point] = []
        self.faces: list[Face] = []
        self.wires: list[Edge] = []
        self.parts: list[int] = []

    def point(self, point: Point) -> int:
        if self._weld and point in self._known:
            return self._known[point]
        self._known[point] = len(self.points)
        self.points.append(point)
        return len(self.points) - 1

    def solid(self, corners: Sequence[Point], faces: Sequence[Face]) -> None:
        numbers = [self.point(corner) for corner in corners]
        self.faces += [(numbers[i], numbers[j], numbers[k]) for i, j, k in faces]
        self.parts += [self.parts[-1] + 1 if self.parts else 0] * len(faces)

    def scene(self, *, closed: bool = False) -> Scene:
        wires = {(min(i, j), max(i, j)) for i, j in self.wires if i != j}
        return Scene(tuple(self.points), tuple(self.faces), tuple(sorted(wires)), tuple(self.parts), closed)


def _point(rng: random.Random, size: int) -> Point:
    return rng.randint(0, size), rng.randint(0, size), rng.randint(0, size)


def _add(a: Point, b: Point) -> Point:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def _box_faces(rng: random.Random) -> list[Face]:
    faces: list[Face] = []
    for i, j, k, m in BOX_QUADS:
        faces += [(i, j, k), (i, k, m)] if rng.random() < 0.5 else [(i, j, m), (j, k, m)]
    return faces


def _sheared_box(rng: random.Random, builder: Builder, corner: Point, size: int) -> None:
    axes = [_point(rng, size) for _ in range(3)]
    if rng.random() < 0.5:  # upright: faces parallel to the view, edges along it
        axes = [(rng.randint(1, size), 0, 0), (0, rng.randint(1, size), 0), (0, 0, rng.randint(1, size))]
    builder.solid(_parallelepiped(corner, axes), _box_faces(rng))


def soup(rng: random.Random, size: int) -> Scene:
    """Triangles that pass through one another; some degenerate, some repeated."""
    builder = Builder(weld=rng.random() < 0.5)
    for _ in range(rng.randint(2, 7)):
        corners = [_point(rng, size) for _ in range(3)]
        builder.solid(corners, [(0, 1, 2)])
        if rng.random() < 0.15:
            builder.solid(corners, [rng.choice([(0, 1, 2), (0, 2, 1)])])
    return builder.scene()


def tetrahedra(rng: random.Random, size: int) -> Scene:
    """Closed, interpenetrating, often flat or sharing corners; wound at random."""
    builder = Builder(weld=rng.random() < 0.5)
    for _ in range(rng.randint(1, 4)):
        faces: list[Face] = [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)]
        if rng.random() < 0.5:
            faces = [(i, k, j) for i, j, k in faces]
        builder.solid([_point(rng, size) for _ in range(4)], faces)
    return builder.scene()


def boxes(rng: random.Random, size: int) -> Scene:
    """Upright and sheared boxes, which may pass through one another."""
    builder = Builder(weld=rng.random() < 0.5)
    for _ in range(rng.randint(1, 3)):
        _sheared_box(rng, builder, _point(rng, size), max(1, size // 2))
    return builder.scene()


def glued_boxes(rng: random.Random, size: int) -> Scene:
    """Cells of one sheared grid: faces in contact, shared or doubled, and an oblique view of them all."""
    builder = Builder(weld=rng.random() < 0.5)
    axes = [(rng.randint(-2, 2), rng.randint(-2, 2), rng.randint(-2, 2)) for _ in range(3)]
    for _ in range(rng.randint(2, 4)):
        cell = [rng.randint(0, 1) for _ in range(3)]
        corner = (0, 0, 0)
        for axis, step in zip(axes, cell, strict=True):
            corner = _add(corner, axis) if step else corner
        builder.solid(_parallelepiped(corner, axes), _box_faces(rng))
    del size
    return builder.scene()


def coplanar(rng: random.Random, size: int) -> Scene:
    """Triangles of one or two planes, overlapping and touching, and lines within the planes."""
    builder = Builder(weld=rng.random() < 0.5)
    for _ in range(rng.randint(1, 2)):
        slope_x, slope_y, height = rng.randint(-1, 1), rng.randint(-1, 1), rng.randint(0, size)

        def lifted(a: int = slope_x, b: int = slope_y, c: int = height) -> Point:
            x, y = rng.randint(0, size), rng.randint(0, size)
            return x, y, a * x + b * y + c

        for _ in range(rng.randint(1, 4)):
            builder.solid([lifted() for _ in range(3)], [(0, 1, 2)])
        builder.wires.append((builder.point(lifted()), builder.point(lifted())))
    return builder.scene()


def collinear(rng: random.Random, size: int) -> Scene:
    """All corners lie over a few image points: lines over lines, contours over contours, edge-on faces."""
    builder = Builder(weld=rng.random() < 0.5)
    places = [(rng.randint(0, size), rng.randint(0, size)) for _ in range(rng.randint(3, 5))]
    for _ in range(rng.randint(2, 6)):
        corners = [(*rng.choice(places), rng.randint(0, size)) for _ in range(3)]
        builder.solid(corners, [(0, 1, 2)])
    for _ in range(2):
        ends = [(*rng.choice(places), rng.randint(0, size)) for _ in range(2)]
        builder.wires.append((builder.point(ends[0]), builder.point(ends[1])))
    return builder.scene()


def wires(rng: random.Random, size: int) -> Scene:
    """A solid and free lines: through it, on its faces, on its edges, at its corners."""
    builder = Builder(weld=rng.random() < 0.5)
    _sheared_box(rng, builder, _point(rng, size), max(1, size // 2))
    for _ in range(rng.randint(1, 4)):
        ends = [
            builder.point(rng.choice(builder.points) if rng.random() < 0.4 else _point(rng, size)) for _ in range(2)
        ]
        builder.wires.append((ends[0], ends[1]))
    return builder.scene()


def solids(rng: random.Random, size: int) -> Scene:
    """Sound parts (closed, wound outward, with a volume above zero), and free lines among them."""
    builder = Builder(weld=False)
    while len(builder.parts) < 4 or rng.random() < 0.4:
        corner = _point(rng, size)
        axes = [(rng.randint(-size, size), rng.randint(-size, size), rng.randint(-size, size)) for _ in range(3)]
        if rng.random() < 0.4:
            axes = [(rng.randint(1, size), 0, 0), (0, rng.randint(1, size), 0), (0, 0, rng.randint(1, size))]
        volume = _volume(*axes)
        if volume == 0:
            continue
        if volume > 0:  # x right, y up and z away are left-handed
            axes[0], axes[1] = axes[1], axes[0]
        if rng.random() < 0.3:
            corners = [corner, *(_add(corner, axis) for axis in axes)]
            builder.solid(corners, [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])
        else:
            builder.solid(_parallelepiped(corner, axes), _box_faces(rng))
    for _ in range(rng.randint(0, 2)):
        ends = [rng.choice(builder.points) if rng.random() < 0.3 else _point(rng, size) for _ in range(2)]
        builder.wires.append((builder.point(ends[0]), builder.point(ends[1])))
    return builder.scene(closed=True)


def _volume(a: Point, b: Point, c: Point) -> int:
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])


def _parallelepiped(corner: Point, axes: Sequence[Point]) -> list[Point]:
    corners = []
    for number in range(8):
        place = corner
        for bit in range(3):
            if number >> bit & 1:
                place = _add(place, axes[bit])
        corners.append(place)
    return corners


KINDS: tuple[Callable[[random.Random, int], Scene], ...] = (
    soup,
    tetrahedra,
    boxes,
    glued_boxes,
    coplanar,
    collinear,
    wires,
    solids,
)
SIZES = (2, 3, 4, 6, 12, 100)


def scene(seed: int) -> Scene:
    """The scene of a seed; seeds take the kinds in turn, mostly on very small grids."""
    rng = random.Random(seed)
    size = SIZES[min(int(rng.expovariate(0.6)), len(SIZES) - 1)]
    return KINDS[seed % len(KINDS)](rng, size)


def kind(seed: int) -> str:
    return KINDS[seed % len(KINDS)].__name__
