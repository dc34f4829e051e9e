"""Triangles of some parts are left out of the common arrays; the other parts are not touched one by one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

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
    return PartMeshes(whole.labels, t.with_triangles(kept, nodes), whole.surfaces)
