"""Meshes cut by planes: what lies on one side of them is taken away. Closed bodies are closed there, by manifold3d."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr.common.types import Floats, Ints
from hlr.source.mesh.capping import checked, together
from hlr.source.mesh.clipping import clipped
from hlr.source.mesh.closed import of_closed_bodies
from hlr.source.mesh.mending import mended
from hlr.source.mesh.one_by_one import body_numbers, one_by_one
from hlr.source.model import PartMesh
from hlr.source.stepped import Stepped

BEYOND = np.array([[2.19, 3.37, 4.73], [2.83, 3.11, 5.27]])
"""How much farther than a body blocks reach, down and up each axis: no diagonal of their sides meets its corners."""


@dataclass(frozen=True, slots=True, eq=False)
class MeshPiece:
    """What a plane leaves of some bodies of a part.

    points (n, 3), triangles (m, 3); closed: they have an inside; cut: the plane goes through them, or between them
    """

    points: Floats
    triangles: Ints
    closed: bool
    cut: bool


def cut_mesh(part: PartMesh, planes: Stepped, near: float) -> list[MeshPiece]:
    """A part without what lies before planes: its closed bodies, and those that are open.

    near: what is no farther from a plane lies on it, model units
    """
    # Numbers near zero lose nothing where the plane is set against them.
    middle = 0.5 * (part.points.min(axis=0) + part.points.max(axis=0))
    points = part.points - middle
    place = np.eye(4)
    place[:3, 3] = middle
    planes = planes.before(place)
    body, triangles, closed = _bodies(points, part.triangles)
    pieces = []
    for rows, is_closed in ((closed, True), (~closed, False)):
        if not rows.any():
            continue
        low, high = planes.reach(points[triangles[rows]].reshape(-1, 3))
        if body is not None and is_closed:
            found = _without(body, points, triangles[closed], planes, near)
        else:
            found = clipped(points, triangles[rows], planes, near)
        if len(found[1]):
            pieces.append(MeshPiece(found[0] + middle, found[1], is_closed, low < -near < near < high))
    return pieces


def _bodies(points: Floats, triangles: Ints) -> tuple[Any | None, Ints, npt.NDArray[np.bool_]]:
    """The closed bodies of triangles (m, 3) as one; the triangles (k, 3), turned outward, and which are of the bodies.

    Triangles that close nothing are mended first. None, and the triangles as they are, where they close nothing then.
    """
    outward = _outward(points, triangles)
    body, _ = _body(points, outward)
    if body is not None:
        return body, outward, np.ones(len(outward), bool)
    outward = _outward(points, mended(points, triangles))
    body, joined = _body(points, outward)
    closed = np.ones(len(outward), bool)
    if body is None:
        closed = of_closed_bodies(joined, len(points))
        body = _body(points, outward[closed])[0] if closed.any() else None
    return (None, triangles, np.zeros(len(triangles), bool)) if body is None else (body, outward, closed)


def _outward(points: Floats, triangles: Ints) -> Ints:
    """Triangles (m, 3), turned over where they are inside out."""
    a, b, c = points[triangles].transpose(1, 0, 2)
    return np.ascontiguousarray(triangles[:, ::-1]) if float((np.cross(a, b) * c).sum()) < 0.0 else triangles


def _without(body: Any, points: Floats, triangles: Ints, planes: Stepped, near: float) -> tuple[Floats, Ints]:
    """A body, which points (n, 3) and triangles (m, 3) close, without what lies before planes.

    It is cut in a frame in which the planes are levels of z, the first of them zero, and what counts as on one is put
    on it. Numbers that are a little off, as in STL files, would leave a film before a face that lies on the plane.
    """
    from manifold3d import Manifold

    axes = np.stack([planes.along, np.cross(planes.normal, planes.along), planes.normal])
    origin = float(planes.levels[0]) * planes.normal
    own = (points - origin) @ axes.T
    put, far = own.copy(), float(np.abs(own).max())
    for column, ends in ((0, planes.steps), (2, planes.levels - planes.levels[0])):
        for end in ends.tolist():
            put[np.abs(own[:, column] - end) <= near, column] = end
    moved = _body(put, triangles)[0] if (put != own).any() else None
    body = moved or body.transform(np.column_stack([axes, -axes @ origin]))
    behind = Manifold()
    for begin, end, level in planes.blocks():
        low = np.maximum([begin, -np.inf, -np.inf], -far * BEYOND[0])
        high = np.minimum([end, np.inf, level - planes.levels[0]], far * BEYOND[1])
        if (high > low).all():
            behind += _block(low, high)
    # Unlike a difference, this keeps the border between a face that lay on a plane and the cut around it. Bodies of one
    # mesh may overlap: cut together, they would have one cut face, along the borders of neither.
    lowest, highest = float(planes.levels.min() - planes.levels[0]), float(planes.levels.max() - planes.levels[0])
    pieces = [(np.empty((0, 3)), np.empty((0, 3), np.int32))]
    number = body_numbers(put, triangles)
    for each in _bodies_of(body, put, one_by_one(triangles, number)):
        _, _, low, _, _, high = each.bounding_box()
        # Of a body that stands on a plane a film would be left.
        if low < highest - near:
            pieces.append(_of(each if high <= lowest else each ^ behind))
    left = together(pieces)
    if not len(planes.steps):
        left = checked(put, triangles, number, left, near)
    return left[0] @ axes + origin, left[1]


def _bodies_of(whole: Any, points: Floats, parts: list[Ints]) -> list[Any]:
    """The bodies that triangles (m, 3) of a whole one close, part by part; the whole where one of them closes none."""
    if len(parts) < 2:
        return [whole]
    found = []
    for rows in parts:
        used, own = np.unique(rows, return_inverse=True)
        found.append(_body(points[used], own.reshape(-1, 3).astype(np.int32))[0])
    return [whole] if any(each is None for each in found) else found


def _of(body: Any) -> tuple[Floats, Ints]:
    mesh = body.to_mesh64()
    return np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts).astype(np.int32)


def _block(low: Floats, high: Floats) -> Any:
    """The block between two corners (3,), whose sides are where they say to the last digit."""
    from manifold3d import Manifold, Mesh64

    cube = Manifold.cube([1.0, 1.0, 1.0]).to_mesh64()
    corners = np.where(np.asarray(cube.vert_properties)[:, :3] > 0.5, high, low)
    return Manifold(Mesh64(corners, np.asarray(cube.tri_verts).astype(np.uint64)))


def _body(points: Floats, triangles: Ints) -> tuple[Any | None, Ints]:
    """The body that triangles (m, 3) close; None where they do not, or are but the hollows of another one.

    And their corners, those in one place as one.
    """
    from manifold3d import Manifold, Mesh64

    mesh = Mesh64(points, triangles.astype(np.uint64))
    mesh.merge()
    body = Manifold(mesh)
    joined = np.arange(len(points), dtype=np.int32)
    joined[np.asarray(mesh.merge_from_vert, np.int64)] = np.asarray(mesh.merge_to_vert, np.int64)
    is_body = body.status().name == "NoError" and not body.is_empty() and body.volume() > 0.0
    return body if is_body else None, joined[triangles]
