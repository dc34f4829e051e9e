"""Which triangles the visibility pass may treat as one surface, and what may be assumed of each such group."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.scene.scene import Groups
from hlr.scene.topology import MeshFacts
from hlr.source.model import Floats, Ints
from hlr.tolerance import MESH_CONTACT


def grouped(whole: npt.NDArray[np.bool_], triangles: Ints, part_of: Ints, n_points: int) -> tuple[Ints, Ints]:
    """Per triangle its group, per group its part: closed B-rep parts whole, everything else by connected piece.

    Faces of an IGES file that nobody sewed together touch like strangers do, and need the same tolerance.
    """
    if whole.all():
        return part_of.copy(), np.arange(len(whole), dtype=np.int32)
    piece = _kernel.components(triangles, n_points)
    if not whole.any():
        # Pieces are numbered in order of appearance.
        group_part = np.zeros(int(piece.max(initial=-1)) + 1, np.int32)
        group_part[piece[::-1]] = part_of[::-1]
        return piece, group_part
    # Whole parts first, numbered as they are; then the pieces of the others.
    label = np.where(whole[part_of], part_of, piece + len(whole)).astype(np.int64)
    used, group = np.unique(label, return_inverse=True)
    group = group.ravel().astype(np.int32)
    first = np.zeros(len(used), np.int64)
    first[group[::-1]] = np.arange(len(triangles))[::-1]
    return np.asarray(group, np.int32), part_of[first]


def checked(
    points: Floats,
    triangles: Ints,
    group_of: Ints,
    group_part: Ints,
    mesh: MeshFacts,
    brep: npt.NDArray[np.bool_],
    curved: npt.NDArray[np.bool_],
) -> Groups:
    """Per group what can be told from its triangles; brep per part, curved per triangle."""
    count = len(group_part)
    odd_edges = np.flatnonzero(mesh.balance)
    odd = np.bincount(group_of[mesh.incident[mesh.offsets[odd_edges]]], minlength=count)
    low, high, size, six_volumes, two_areas = _kernel.group_facts(points, triangles, group_of, count)
    used = size > 0
    closed = (odd == 0) & used
    extent = np.where(used, (high - low).min(axis=1), 0.0)
    # Of a plate, a tube or a housing 2 V / A is the thickness of the wall, however it is turned; of a ball or a cube a
    # third of the diameter. Half of the extent is allowed for contact: nearly twice the thickness still hides.
    with np.errstate(divide="ignore", invalid="ignore"):
        thickness = np.where(closed, 1.8 * 2.0 * np.abs(six_volumes / 6.0) / (two_areas / 2.0), np.inf)
    extent = np.fmin(extent, thickness)
    return Groups(
        closed=closed,
        cull=closed & (six_volumes > 0.0),
        inward=closed & (six_volumes < 0.0),
        sound=closed & brep[group_part],
        bare=~brep[group_part],
        tight=np.zeros(count, bool),
        planar=~used if curved.all() else np.bincount(group_of[curved], minlength=count) == 0,
        extent=extent,
        low=low,
        high=high,
    )


def welded(offsets: Ints, incident: Ints, group_of: Ints, groups: Groups) -> npt.NDArray[np.bool_]:
    """(g,) bool: pieces of a mesh with more than two triangles at an edge.

    Bodies that were welded there are one connected piece, and still touch one another as strangers do.
    """
    shared = group_of[incident[offsets[:-1][np.diff(offsets) > 2]]]
    return np.asarray(groups.bare & (np.bincount(shared, minlength=len(groups.bare)) > 0))


def with_wires(groups: Groups, points: Floats, wires: Ints, owner: Ints, tight: bool) -> tuple[Groups, Ints]:
    """Open groups more for mesh edges that have no triangles: one per distinct owner; and the group of each wire.

    wires (m, 2), owner (m,). tight: they lie exactly on triangles of other groups.
    """
    owners, which = np.unique(owner, return_inverse=True)
    n, m = len(groups.closed), len(owners)
    no = np.zeros(m, bool)
    ends = points[wires]
    low = np.full((m, 3), np.inf)
    high = np.full((m, 3), -np.inf)
    np.minimum.at(low, which.ravel(), ends.min(axis=1))
    np.maximum.at(high, which.ravel(), ends.max(axis=1))
    more = Groups(
        closed=np.concatenate([groups.closed, no]),
        cull=np.concatenate([groups.cull, no]),
        inward=np.concatenate([groups.inward, no]),
        sound=np.concatenate([groups.sound, ~no]),
        bare=np.concatenate([groups.bare, no]),
        tight=np.concatenate([groups.tight, np.full(m, tight)]),
        planar=np.concatenate([groups.planar, ~no]),
        extent=np.concatenate([groups.extent, np.zeros(m)]),
        low=np.concatenate([groups.low, low]),
        high=np.concatenate([groups.high, high]),
    )
    return more, (n + which.ravel()).astype(np.int32)


def touching(groups: Groups, curved: float, planar: float) -> Floats:
    """(g,) model units: nearer than this to another surface, a group touches it.

    curved, planar: for groups with a B-rep. A bare mesh does not tell what it was made with: a share of the model.
    """
    depth = np.where(groups.planar, planar, curved)
    used: npt.NDArray[np.bool_] = np.isfinite(groups.low[:, 0])
    if groups.bare.any():
        size = groups.high[used].max(axis=0) - groups.low[used].min(axis=0)
        diagonal = math.sqrt(sum(float(s) * float(s) for s in size))
        depth = np.where(groups.bare, np.maximum(depth, diagonal * MESH_CONTACT), depth)
    return np.asarray(depth, np.float64)
