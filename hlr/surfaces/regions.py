"""Triangles of one plane, joined: the polygons that a filled drawing paints."""

from __future__ import annotations

from collections import defaultdict

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.scene.scene import Scene
from hlr.source.model import Floats, Ints
from hlr.surfaces.polygons import Polygons

COPLANAR = 1e-9
"""1 - cosine: triangles of one face at whose edge it folds by less lie in one plane, up to what a file rounds."""


def joined(scene: Scene, chosen: npt.NDArray[np.bool_]) -> tuple[Polygons, Floats, Ints]:
    """Polygons of the chosen triangles (t,), their normals (p, 3), and the part of each (p,).

    Between joined triangles no edge is left, so that no gap can be seen there, in whatever program.
    """
    triangles = scene.triangles[chosen]
    corners = scene.points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normals, axis=1)
    region = _regions(scene, chosen, normals, length)
    count = int(region.max(initial=-1)) + 1
    total = np.zeros((count, 3))
    np.add.at(total, region, normals)
    part = np.zeros(count, np.int32)
    part[region] = scene.triangle_part[chosen]
    loops = _outlines(triangles, region, count)
    flat = [corner for polygon in loops for loop in polygon for corner in loop]
    lengths = [len(loop) for polygon in loops for loop in polygon]
    kept = np.array([k for k, polygon in enumerate(loops) if polygon], np.int64)
    polygons = Polygons(
        scene.points,
        np.array(flat, np.int32),
        np.cumsum([0, *lengths], dtype=np.int32),
        np.cumsum([0, *(len(loops[k]) for k in kept)], dtype=np.int32),
        np.zeros(len(kept), np.bool_),
    )
    size = np.linalg.norm(total[kept], axis=1, keepdims=True)
    return polygons, total[kept] / np.where(size > 0.0, size, 1.0), part[kept]


def _regions(scene: Scene, chosen: npt.NDArray[np.bool_], normals: Floats, length: Floats) -> Ints:
    """(t,) the number of each chosen triangle's region, in the order of first triangles."""
    number = np.cumsum(chosen) - 1
    pairs = np.flatnonzero(np.diff(scene.offsets) == 2)
    first, second = (scene.incident[scene.offsets[pairs] + k] for k in (0, 1))
    both = chosen[first] & chosen[second]
    first, second = first[both], second[both]
    same = (scene.triangle_part[first] == scene.triangle_part[second]) & (
        scene.triangle_face[first] == scene.triangle_face[second]
    )
    first, second = number[first[same]], number[second[same]]
    cosine = (normals[first] * normals[second]).sum(axis=1)
    flat = cosine >= (1.0 - COPLANAR) * length[first] * length[second]
    # A triangle without area has no plane; it joins nothing.
    flat &= (length[first] > 0.0) & (length[second] > 0.0)
    # A triangle is a pair with itself as well: the components of these are those of the triangles.
    own = np.arange(np.count_nonzero(chosen))
    pairs = np.concatenate([np.stack([own, own], axis=1), np.stack([first[flat], second[flat]], axis=1)])
    label = _kernel.edge_components(np.ascontiguousarray(pairs, np.int32), len(own))[: len(own)]
    _, start, inverse = np.unique(label, return_index=True, return_inverse=True)
    rank = np.empty(len(start), np.int32)
    rank[np.argsort(start, kind="stable")] = np.arange(len(start), dtype=np.int32)
    return np.asarray(rank[inverse.ravel()])


def _outlines(triangles: Ints, region: Ints, count: int) -> list[list[list[int]]]:
    """Per region its loops: the sides that no other of its triangles runs through the other way."""
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    owner = np.concatenate([region, region, region])
    n = int(triangles.max(initial=0)) + 1
    here = (owner.astype(np.int64) * n + sides[:, 0]) * n + sides[:, 1]
    there = (owner.astype(np.int64) * n + sides[:, 1]) * n + sides[:, 0]
    border = ~np.isin(here, there)
    follow: list[dict[int, list[int]]] = [defaultdict(list) for _ in range(count)]
    for k, a, b in zip(owner[border].tolist(), sides[border, 0].tolist(), sides[border, 1].tolist(), strict=True):
        follow[k][a].append(b)
    out: list[list[list[int]]] = []
    for ways in follow:
        loops = []
        for start in list(ways):
            while ways[start]:
                loop, at = [start], ways[start].pop()
                while at != start and ways.get(at):
                    loop.append(at)
                    at = ways[at].pop()
                if len(loop) > 2:
                    loops.append(loop)
        out.append(loops)
    return out
