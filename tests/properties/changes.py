"""Changes to a model that leave its picture the same."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from properties.frozen import Frozen

from hlr.source.model import PartMesh, SurfaceParameters

Random = np.random.Generator


def moved(model: Frozen, matrix: np.ndarray, offset: Sequence[float] = (0.0, 0.0, 0.0)) -> Frozen:
    """points @ matrix.T + offset, element by element; a matrix that mirrors turns the triangles round."""
    flip = float(np.linalg.det(matrix)) < 0

    def each(part: PartMesh) -> PartMesh:
        x, y, z = part.points.T
        points = np.stack([x * row[0] + y * row[1] + z * row[2] for row in matrix], axis=1) + np.asarray(offset)
        turn = [0, 2, 1] if flip else [0, 1, 2]
        placed = np.eye(4)
        placed[:3, :3], placed[:3, 3] = matrix, offset
        return replace(
            part,
            points=points,
            triangles=np.ascontiguousarray(part.triangles[:, turn]),
            transform=placed @ part.transform,
            precision=part.precision * float(np.abs(matrix).max()),
            surface_parameters=_corners(part, lambda corner: corner[:, turn]),
        )

    return replace(model, parts=tuple(each(part) for part in model.parts))


def _corners(part: PartMesh, change: Callable[[np.ndarray], np.ndarray]) -> SurfaceParameters | None:
    """The surface parameters of the triangles' corners, changed with the triangles."""
    on = part.surface_parameters
    return replace(on, corner=np.ascontiguousarray(change(on.corner))) if on is not None else None


def reordered(model: Frozen, order: Sequence[int]) -> Frozen:
    """Parts in another order: order[i] is the old number of the new part i."""
    return replace(model, parts=tuple(model.parts[i] for i in order))


def shuffled_triangles(model: Frozen, rng: Random) -> Frozen:
    """Triangles of each part in any order, each beginning at any of its corners."""

    def each(part: PartMesh) -> PartMesh:
        order = rng.permutation(len(part.triangles))
        turn = (np.arange(3) + rng.integers(0, 3, len(order))[:, None]) % 3
        triangles = np.take_along_axis(part.triangles[order], turn, axis=1)
        return replace(
            part,
            triangles=np.ascontiguousarray(triangles),
            triangle_face=part.triangle_face[order],
            surface_parameters=_corners(part, lambda corner: np.take_along_axis(corner[order], turn, axis=1)),
        )

    return replace(model, parts=tuple(each(part) for part in model.parts))


def shuffled_faces(model: Frozen, rng: Random) -> tuple[Frozen, list[np.ndarray]]:
    """Faces renumbered within each part; and per part the old number of each new one."""
    parts, orders = [], []
    for part in model.parts:
        order = rng.permutation(len(part.face_planar))
        triangle_face = np.argsort(order)[part.triangle_face].astype(np.int32)
        on = part.surface_parameters
        if on is not None:
            on = replace(on, number=on.number[order], place=on.place[order], reversed=on.reversed[order])
        parts.append(
            replace(part, triangle_face=triangle_face, face_planar=part.face_planar[order], surface_parameters=on)
        )
        orders.append(order)
    return replace(model, parts=tuple(parts)), orders


def shuffled_edges(model: Frozen, rng: Random) -> Frozen:
    """Edges of each part listed in any order; their numbers stay with them."""

    def each(part: PartMesh) -> PartMesh:
        order = rng.permutation(len(part.edge_index))
        walks = np.split(part.edge_nodes, part.edge_offsets[1:-1])
        nodes = [walks[i] for i in order]
        return replace(
            part,
            edge_nodes=np.concatenate([part.edge_nodes[:0], *nodes]),
            edge_offsets=np.cumsum([0, *map(len, nodes)]).astype(np.int32),
            edge_index=part.edge_index[order],
            edge_class=part.edge_class[order],
        )

    return replace(model, parts=tuple(each(part) for part in model.parts))


def shuffled_points(model: Frozen, rng: Random) -> Frozen:
    """Points of each part in any order."""

    def each(part: PartMesh) -> PartMesh:
        order = rng.permutation(len(part.points))
        new = np.argsort(order).astype(np.int32)
        return replace(
            part,
            points=np.ascontiguousarray(part.points[order]),
            triangles=new[part.triangles],
            edge_nodes=new[part.edge_nodes],
        )

    return replace(model, parts=tuple(each(part) for part in model.parts))


def split(model: Frozen, rng: Random) -> Frozen:
    """Every triangle in four, its sides cut at 1/4, 1/2 or 3/4: on a lattice of multiples of four without rounding."""
    return replace(model, parts=tuple(_split(part, rng) for part in model.parts))


def _split(part: PartMesh, rng: Random) -> PartMesh:
    n = len(part.points)
    steps = np.stack([part.edge_nodes[:-1], part.edge_nodes[1:]], axis=1)
    sides = np.concatenate([part.triangles[:, [0, 1]], part.triangles[:, [1, 2]], part.triangles[:, [2, 0]]])
    key = np.sort(np.concatenate([sides, steps]), axis=1) @ np.array([n, 1], np.int64)
    # Skip steps from one edge's last node to the next edge's first, and steps from a node to itself.
    real = np.ones(len(steps), bool)
    real[part.edge_offsets[1:-1] - 1] = False
    real &= steps[:, 0] != steps[:, 1]
    wanted = np.concatenate([np.ones(len(sides), bool), real])
    known, which = np.unique(key[wanted], return_inverse=True)
    number = np.full(len(key), -1)
    number[wanted] = n + which.ravel()
    a, b = part.points[known // n], part.points[known % n]
    share = rng.integers(1, 4, len(known)) / 4.0
    middle = a + (b - a) * share[:, None]
    i, j, k = part.triangles.T
    ij, jk, ki = number[: len(sides)].reshape(3, -1)
    four = [np.stack(t, axis=1) for t in ((i, ij, ki), (ij, j, jk), (ki, jk, k), (ij, jk, ki))]
    between = number[len(sides) :]
    nodes = np.repeat(part.edge_nodes, 1 + np.append(between >= 0, False)) if len(part.edge_nodes) else part.edge_nodes
    at = np.cumsum(1 + np.append(between >= 0, False)) - 1 if len(part.edge_nodes) else np.zeros(0, int)
    nodes[at[:-1][between >= 0]] = between[between >= 0]
    counts = np.add.reduceat(1 + np.append(between >= 0, False), part.edge_offsets[:-1]) if len(nodes) else []
    return replace(
        part,
        points=np.concatenate([part.points, middle]),
        triangles=np.concatenate(four).astype(np.int32),
        triangle_face=np.tile(part.triangle_face, 4),
        surface_parameters=_split_surfaces(part, share[number[: len(sides)] - n]),
        edge_nodes=nodes.astype(np.int32),
        edge_offsets=np.cumsum([0, *counts]).astype(np.int32),
    )


def _split_surfaces(part: PartMesh, share: np.ndarray) -> SurfaceParameters | None:
    """The same in parameters; share (3 m,) of each side, from its node of the lower number."""
    on = part.surface_parameters
    if on is None:
        return None
    k, m = len(on.uv), len(part.triangles)
    ends = np.concatenate([on.corner[:, [0, 1]], on.corner[:, [1, 2]], on.corner[:, [2, 0]]])
    nodes = np.concatenate([part.triangles[:, [0, 1]], part.triangles[:, [1, 2]], part.triangles[:, [2, 0]]])
    ends = np.where((nodes[:, 0] > nodes[:, 1])[:, None], ends[:, ::-1], ends)
    _, first, which = np.unique(ends @ np.array([k, 1], np.int64), return_index=True, return_inverse=True)
    a, b = on.uv[ends[first, 0]], on.uv[ends[first, 1]]
    between = (k + which.ravel()).reshape(3, m)
    corners = np.concatenate([on.corner.T, between])
    four = [corners[list(t)].T for t in ((0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5))]
    uv = np.concatenate([on.uv, a + (b - a) * share[first][:, None]])
    return replace(on, corner=np.concatenate(four).astype(np.int32, order="C"), uv=uv)


def jiggled(model: Frozen, amount: float, rng: Random) -> Frozen:
    """Every point moved by at most so much along each axis."""

    def each(part: PartMesh) -> PartMesh:
        return replace(part, points=part.points + rng.uniform(-amount, amount, part.points.shape))

    return replace(model, parts=tuple(each(part) for part in model.parts))


def joined_by(model: Frozen, *more: Frozen) -> Frozen:
    """The model with the parts of other models after its own."""
    return replace(model, parts=(*model.parts, *(part for other in more for part in other.parts)))
