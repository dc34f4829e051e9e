"""Meshes as arrays (points, triangles). Points keep the order given, so a test can name an edge by its corners."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr._kernel import MeshFacts
from hlr.source.model import PartMesh
from hlr.source.part_meshes import combine_parts

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int32]
Mesh = tuple[Floats, Ints]
Vector = Sequence[float]

BOX_QUADS = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
BOX_EDGES = [(i, i | bit) for bit in (1, 2, 4) for i in range(8) if not i & bit]


def split(quads: npt.ArrayLike) -> Ints:
    """Split quadrangles (n, 4), corners in order, into triangles (2 n, 3)."""
    q = np.asarray(quads, np.int32)
    return np.stack([q[:, [0, 1, 2]], q[:, [0, 2, 3]]], axis=1).reshape(-1, 3)


def box(low: Vector, high: Vector) -> Mesh:
    """A closed box with normals outward; corner 4 x + 2 y + z, each 0 for low and 1 for high; edges BOX_EDGES."""
    ends = np.array([low, high], float)
    points = [[ends[x][0], ends[y][1], ends[z][2]] for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    return np.array(points), split(BOX_QUADS)


def box_lines(low: Vector, high: Vector) -> list[tuple[Floats, Floats]]:
    """The twelve edges as pairs of points."""
    points = box(low, high)[0]
    return [(points[i], points[j]) for i, j in BOX_EDGES]


def face(*corners: Vector) -> Mesh:
    """A convex polygon as a fan."""
    n = len(corners)
    return np.array(corners, float), np.array([[0, i, i + 1] for i in range(1, n - 1)], np.int32)


def ring(corners: Sequence[Vector] | Floats) -> list[tuple[Floats, Floats]]:
    """The sides of a polygon as pairs of points."""
    p = [np.asarray(c, float) for c in corners]
    return list(pairwise([*p, p[0]]))


def merged(*meshes: Mesh) -> Mesh:
    """One mesh; points stay apart, and keep their order."""
    first = np.cumsum([0, *[len(points) for points, _ in meshes]])
    return (
        np.concatenate([points for points, _ in meshes]),
        np.concatenate([triangles + n for (_, triangles), n in zip(meshes, first, strict=False)]).astype(np.int32),
    )


def as_parts(*meshes: Mesh) -> Any:
    """The meshes as parts of a scene."""
    import trimesh

    from support.models import parts

    return parts(*(trimesh.Trimesh(p, t, process=False) for p, t in meshes))


def turned_over(mesh: Mesh) -> Mesh:
    """The mesh inside out."""
    return mesh[0], np.ascontiguousarray(mesh[1][:, ::-1])


def moved(mesh: Mesh, by: Callable[[Floats], Floats]) -> Mesh:
    """The same triangles with other points."""
    return by(mesh[0]), mesh[1]


def rotation(axis: Vector, angle: float) -> Floats:
    """The (3, 3) rotation by an angle in radians, by Rodrigues' formula; for points as rows: p @ rotation.T."""
    x, y, z = np.asarray(axis, float) / np.linalg.norm(axis)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.asarray(np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k)


def cells(number: npt.NDArray[np.integer]) -> Ints:
    """Triangles between points numbered in rows and columns (n, m); where a surface closes, numbers occur twice."""
    corners = [number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]]
    return split(np.stack(corners, axis=-1).reshape(-1, 4))


def grid(points: Floats, *, around: bool = False, along: bool = False) -> Mesh:
    """A surface through an array of points (n, m, 3); closed over the second index with `around`, the first `along`."""
    n, m = points.shape[:2]
    number = np.arange(n * m).reshape(n, m)
    if around:
        number = np.concatenate([number, number[:, :1]], axis=1)
    if along:
        number = np.concatenate([number, number[:1]], axis=0)
    return points.reshape(-1, 3), cells(number)


def torus(major: float, minor: float, n: int, m: int) -> Mesh:
    """A torus about z."""
    u, v = np.meshgrid(np.arange(n) * (2 * np.pi / n), np.arange(m) * (2 * np.pi / m), indexing="ij")
    r = major + minor * np.cos(v)
    return grid(np.stack([r * np.cos(u), r * np.sin(u), minor * np.sin(v)], axis=-1), around=True, along=True)


def sphere(radius: float, n: int, m: int, top: float = np.pi / 2) -> Mesh:
    """A sphere about z, from the south pole up to the latitude `top` (radians); open above if that is below pi / 2."""
    latitude = np.linspace(-np.pi / 2, top, m + 1)[1 : None if top < np.pi / 2 else -1]
    u, v = np.meshgrid(np.arange(n) * (2 * np.pi / n), latitude, indexing="xy")
    p = radius * np.stack([np.cos(v) * np.cos(u), np.cos(v) * np.sin(u), np.sin(v)], axis=-1)
    points, triangles = grid(p, around=True)
    triangles = triangles[:, ::-1]
    south, last = len(points), len(points) - n
    caps = [[south, (i + 1) % n, i] for i in range(n)]
    if top >= np.pi / 2:
        caps += [[south + 1, last + i, last + (i + 1) % n] for i in range(n)]
    poles = np.array([[0, 0, -radius], [0, 0, radius]])[: 1 if top < np.pi / 2 else 2]
    return np.concatenate([points, poles]), np.concatenate([triangles, np.array(caps, np.int32)]).astype(np.int32)


def circle(radius: float, n: int = 720, start: float = 0.0, end: float = 2 * np.pi) -> Floats:
    """(n + 1, 2) points of a circle, or of the arc from `start` to `end` (radians), counter-clockwise."""
    t = np.linspace(start, end, n + 1)
    return radius * np.stack([np.cos(t), np.sin(t)], axis=1)


def sharp_edges(mesh: Mesh, crease: float = 30.0) -> list[tuple[int, int]]:
    """Edges of one triangle, of more than two, or folded by more than `crease` degrees; no two points may coincide."""
    points, triangles = mesh
    p, q, r = (points[triangles[:, k]] for k in range(3))
    normal = np.cross(q - p, r - p)
    size = np.linalg.norm(normal, axis=1)
    found: dict[tuple[int, int], list[tuple[int, int]]] = {}
    for t, corners in enumerate(triangles.tolist()):
        for i, j in pairwise([*corners, corners[0]]):
            found.setdefault((min(i, j), max(i, j)), []).append((t, 1 if i < j else -1))
    limit = np.cos(np.radians(crease))

    def flat(uses: Iterable[tuple[int, int]]) -> bool:
        (s, a), (t, b) = uses
        return bool(normal[s] @ normal[t] * -a * b > limit * size[s] * size[t])

    return [edge for edge, uses in found.items() if len(uses) != 2 or not flat(uses)]


def mesh_facts(points: Floats, triangles: Ints) -> MeshFacts:
    """The edges of a mesh without B-rep; points (n, 3), triangles (t, 3)."""
    none = np.zeros(0, np.int32)
    part = PartMesh(
        name="part",
        color=None,
        transform=np.eye(4),
        points=points,
        triangles=triangles,
        triangle_face=np.zeros(len(triangles), np.int32),
        face_planar=np.zeros(1, bool),
        edge_nodes=none,
        edge_offsets=np.zeros(1, np.int32),
        edge_index=none,
        edge_class=none.astype(np.uint8),
        brep=False,
    )
    return combine_parts([part]).tables.facts()
