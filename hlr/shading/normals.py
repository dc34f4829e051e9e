"""Normals at the corners of triangles: of the true surfaces where there are any, else averaged up to creases."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.types import Floats, Ints
from hlr.scene.scene import Geometry
from hlr.tables.line_classes import where

Normals = npt.NDArray[np.float32]

FLAT = np.int32(-1)
"""In place of a number: the triangle's own normal."""

LEVEL = 1e-3
"""Radians: a face whose triangles differ by no more is a plane, and is shaded as one."""


def corner_normals(scene: Geometry) -> tuple[Normals, Ints]:
    """Unit normals (k, 3), and (t, 3) the number of each corner's normal; FLAT where the triangle has its own."""
    true, of_true = _of_surfaces(scene)
    without_brep = scene.groups.without_brep[scene.triangle_group]
    if scene.facets is None or not without_brep.any():
        return true, of_true
    averaged, of_averaged = _up_to_creases(scene, scene.facets, without_brep)
    corner = np.where(without_brep[:, None], of_averaged + np.int32(len(true)), of_true).astype(np.int32)
    return np.concatenate([true, averaged]), np.ascontiguousarray(corner)


def _of_surfaces(scene: Geometry) -> tuple[Normals, Ints]:
    on = scene.true_surfaces
    none = np.full((len(scene.triangles), 3), FLAT, np.int32)
    if on is None:
        return np.zeros((0, 3), np.float32), none
    every = np.ones(len(on.number), bool)
    normals = _kernel.surface_normals(scene.mesh(), on.of(every, scene.all_faces()))
    found = np.asarray((normals != 0.0).any(axis=1))
    # Number -1 is the last one: it is never found.
    sound = np.asarray(np.append(found, False)[on.corner].all(axis=1))
    return normals, np.where(sound[:, None], on.corner, none)


def _up_to_creases(scene: Geometry, facets: Floats, without_brep: npt.NDArray[np.bool_]) -> tuple[Normals, Ints]:
    """Facets around a vertex that are connected without a crease share one normal.

    Where a vertex lies on a side of a larger facet, the needle between them counts for that facet. Each facet is
    weighted by its angle at the vertex (G. Thuermer, C. A. Wuethrich, "Computing vertex normals from polygonal facets",
    Journal of Graphics Tools 3, 1998), so that the triangulation of a fan makes no difference. A planar face of the
    file has one normal up to its border; rounds that run into it have that normal there, too.
    """
    triangles = scene.triangles
    count = np.diff(scene.offsets)
    smooth = where(lambda row: row.border and row.tangent, interior=True)[scene.edge_kind]
    inner = np.flatnonzero(smooth & (count == 2))
    first = scene.offsets[:-1][inner]
    one, two = scene.incident[first], scene.incident[first + 1]
    mine = without_brep[one] & without_brep[two]
    inner, one, two = inner[mine], one[mine], two[mine]
    pairs = []
    for k in (0, 1):
        vertex = scene.edges[inner, k][:, None]
        corner = [3 * t + np.argmax(triangles[t] == vertex, axis=1) for t in (one, two)]
        pairs.append(np.stack(corner, axis=1))
    # Each corner is also paired with itself: these last pairs tell the component of each corner.
    corners = np.arange(3 * len(triangles))
    joined = np.concatenate([*pairs, np.stack([corners, corners], axis=1)])
    component = _kernel.edge_components(np.ascontiguousarray(joined, np.int32), len(corners))[-len(corners) :]
    _, fan = np.unique(component, return_inverse=True)

    p = scene.points[triangles]
    face, level = _faces(scene, facets)
    plane = level[face]
    touched = np.zeros(int(fan.max(initial=-1)) + 1, bool)
    touched[fan.reshape(-1, 3)[plane]] = True
    sums = np.zeros((len(touched), 3))
    for k in range(3):
        a, b = _unit(p[:, (k + 1) % 3] - p[:, k]), _unit(p[:, (k + 2) % 3] - p[:, k])
        angle = np.arccos(np.clip((a * b).sum(axis=1), -1.0, 1.0))
        angle[touched[fan[k::3]] & ~plane] = 0.0
        for axis in range(3):
            sums[:, axis] += np.bincount(fan[k::3], weights=angle * facets[:, axis], minlength=len(sums))
    mean = _mean(face, facets)
    shared = np.where(plane[:, None], len(sums) + face[:, None], fan.reshape(-1, 3)).astype(np.int32)
    return np.concatenate([_unit(sums), mean]).astype(np.float32), shared


def _faces(scene: Geometry, facets: Floats) -> tuple[npt.NDArray[np.intp], npt.NDArray[np.bool_]]:
    """(t,) number of the file's face that a triangle belongs to, and (f,) bool: all its triangles have one normal."""
    _, face = np.unique((scene.triangle_part.astype(np.int64) << 32) + scene.triangle_face, return_inverse=True)
    off = np.abs(facets - _mean(face, facets)[face]).max(axis=1) > LEVEL
    off &= np.abs(facets).max(axis=1) > 0.0
    return face, np.asarray(np.bincount(face, off) == 0)


def _mean(face: npt.NDArray[np.intp], facets: Floats) -> Floats:
    return _unit(np.stack([np.bincount(face, facets[:, axis]).astype(np.float64) for axis in range(3)], axis=1))


def _unit(v: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    length = np.sqrt((v * v).sum(axis=1))
    return np.asarray(v / np.where(length > 0.0, length, 1.0)[:, None])
