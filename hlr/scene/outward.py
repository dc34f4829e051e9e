"""Closed surfaces that are turned inside out, turned the right way round: which way a file lists its corners is chance.

A contour, culling and shading ask where the outside is. A body that says it wrongly would show its far outline.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from hlr.distinct import distinct
from hlr.scene.scene import Groups, TrueSurfaces
from hlr.scene.topology import MeshFacts
from hlr.source.model import Ints

Bools = npt.NDArray[np.bool_]


def inside_out(groups: Groups, group_part: Ints) -> Bools:
    """(g,) bool: closed and turned inward, but no cavity, which lies within an outer surface of its part."""
    out = groups.inward.copy()
    for g in np.flatnonzero(out):
        around = groups.cull & (group_part == group_part[g])
        around &= ((groups.low < groups.low[g]) & (groups.high > groups.high[g])).all(axis=1)
        out[g] = not around.any()
    return out


def turned_outward(groups: Groups, which: Bools, triangles: Ints, mesh: MeshFacts, turned: Bools) -> Groups:
    """The groups after `which` (g,) were turned; `turned` (t,) are their triangles, turned in place with their normals.

    Edges, folds and the balance of closed surfaces stay what they were.
    """
    triangles[turned] = triangles[turned][:, [0, 2, 1]]
    mesh.normals[turned] *= -1.0
    return replace(groups, cull=groups.cull | which, inward=groups.inward & ~which)


def surfaces_turned(on: TrueSurfaces, turned: Bools, part_of: Ints, face: Ints) -> TrueSurfaces:
    """The same for what is known of the true surfaces under the triangles; part_of (t,), face (t,)."""
    corner, inward = on.corner.copy(), on.inward.copy()
    corner[turned] = corner[turned][:, [0, 2, 1]]
    faces = distinct(on.first[part_of[turned]] + face[turned])
    inward[faces] = ~inward[faces]
    return replace(on, corner=corner, inward=inward)
