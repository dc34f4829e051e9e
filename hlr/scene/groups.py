"""Properties of groups: triangles that the visibility pass treats as one surface."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from hlr._kernel import MeshScene
from hlr.common.types import Floats, Ints
from hlr.request.accuracy import MESH_CONTACT
from hlr.scene.scene import Groups


def groups_of(found: MeshScene, brep: npt.NDArray[np.bool_]) -> Groups:
    """Properties of each group. brep (p,) bool: the part has a B-rep."""
    solid = brep[found.group_part]
    return Groups(
        closed=found.closed,
        cull=found.cull,
        inward=found.inward,
        sound=found.closed & solid,
        bare=~solid,
        tight=np.zeros(len(solid), bool),
        planar=found.planar,
        extent=found.extent,
        low=found.low,
        high=found.high,
    )


def add_wires(groups: Groups, points: Floats, wires: Ints, owner: Ints, tight: bool) -> tuple[Groups, Ints]:
    """Add an open group per distinct owner of edges without triangles; returns the groups, and that of each edge (m,).

    wires (m, 2) into points; owner (m,) any key; tight: the edges lie exactly on triangles of other groups.
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


def contact_depths(groups: Groups, curved: float, planar: float) -> Floats:
    """(g,) contact depth of each group, model units: a surface nearer than this touches it.

    curved, planar: depths for groups with a B-rep. For a mesh without B-rep it is a share of the model.
    """
    depth = np.where(groups.planar, planar, curved)
    used: npt.NDArray[np.bool_] = np.isfinite(groups.low[:, 0])
    if groups.bare.any():
        size = groups.high[used].max(axis=0) - groups.low[used].min(axis=0)
        diagonal = math.sqrt(sum(float(s) * float(s) for s in size))
        depth = np.where(groups.bare, np.maximum(depth, diagonal * MESH_CONTACT), depth)
    return np.asarray(depth, np.float64)
