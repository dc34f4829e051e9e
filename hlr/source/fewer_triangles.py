"""Triangles of some parts are left out of the common arrays; the other parts are not touched one by one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.types import Ints
from hlr.source.part_meshes import PartMeshes


@dataclass(frozen=True, slots=True)
class Fewer:
    """What stays of a part: numbers (n,) of triangles, ascending, and the nodes of its edges, among its points."""

    triangles: npt.NDArray[np.intp]
    edge_nodes: Ints


def with_fewer_triangles(whole: PartMeshes, fewer: Mapping[int, Fewer]) -> PartMeshes:
    """The meshes with what stays of these parts. Points and faces that no triangle uses any more are kept."""
    t = whole.tables
    kept = np.ones(len(t.triangles), bool)
    nodes = t.edge_nodes.copy()
    for i, part in fewer.items():
        first, last = t.triangle_start[i : i + 2].tolist()
        kept[first:last] = False
        kept[first + part.triangles] = True
        own = slice(*t.edge_offsets[t.edge_start[i : i + 2]].tolist())
        nodes[own] = part.edge_nodes + t.point_start[i]
    staying = np.concatenate([[0], np.cumsum(kept)]).astype(np.int32)
    tables = _kernel.PartTables(
        point_start=t.point_start,
        points=t.points,
        triangle_start=staying[t.triangle_start],
        triangles=t.triangles[kept],
        triangle_face=t.triangle_face[kept],
        origin=t.origin[kept],
        face_start=t.face_start,
        face_planar=t.face_planar,
        edge_start=t.edge_start,
        edge_offsets=t.edge_offsets,
        edge_nodes=nodes,
        edge_index=t.edge_index,
        edge_class=t.edge_class,
        brep=t.brep,
        joined=t.joined,
        transform=t.transform,
        precision=t.precision,
        node_start=t.node_start,
        corner=t.corner[kept] if len(t.corner) else t.corner,
        uv=t.uv,
        face_shape=t.face_shape,
        face_place=t.face_place,
        face_reversed=t.face_reversed,
    )
    return PartMeshes(whole.labels, tables, whole.surfaces)
