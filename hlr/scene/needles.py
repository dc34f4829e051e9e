"""Triangles too low for their coordinates: the normal of a needle is rounding noise, and so are the folds at its edges.

Exporters put needles where vertices of a neighbour lie on an edge; the third corner lies on the longest side but for
what the file rounds:

    ::

              A                     the needle p q r, hardly higher than the coordinates are exact,
       p ----------- q              goes with A: it has A's normal, no fold against A,
         `--.. r ..--'              and against B and C the folds of A
            B  |  C

So an edge between two surfaces keeps its fold, and where all around is flat or smooth there is none.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr._kernel import MeshFacts
from hlr.common.distinct import distinct
from hlr.common.types import Floats, Ints
from hlr.scene.chains import edge_keys
from hlr.source.mesh.cleaning import NEEDLE_HEIGHT

Indices = npt.NDArray[np.intp]

MAX_STEPS = 32
"""Needles side by side, of each the longest side on the next one, before what lies beyond is taken as not known."""


@dataclass(frozen=True, slots=True)
class ReliableNormals:
    """normals (t, 3), zero where there is none; fold (e,): cosines, NaN where there is none."""

    normals: Floats
    fold: Floats


def reliable_normals(
    mesh: MeshFacts, points: Floats, triangles: Ints, part_of: Ints, precision: Floats
) -> ReliableNormals:
    """The normals and folds that the coordinates of a mesh support; a triangle without area is a needle, too.

    part_of (t,); precision (p,): how far coordinates of each part may be off, in model units; 0 where they are exact
    """
    low, longest = _kernel.needles(points, triangles, mesh.normals, part_of, NEEDLE_HEIGHT * precision)
    if not len(low):
        return ReliableNormals(mesh.normals, mesh.fold)
    # Chains from needle to needle, in terms of needles; what is none ends them.
    beyond, sense = _across(mesh, triangles, low, longest)
    place = np.minimum(np.searchsorted(low, beyond), len(low) - 1)
    follows = low[place] == beyond
    target, turn, going = beyond.copy(), sense.copy(), follows
    for _ in range(MAX_STEPS - 1):
        at = np.searchsorted(low, target[going])
        turn[going] = turn[going] * sense[at]
        target[going] = beyond[at]
        going = going.copy()
        going[going] = follows[at]
        if not going.any():
            break
    is_low = np.zeros(len(triangles), bool)
    is_low[low] = True
    normals = mesh.normals.copy()
    normals[low] = np.where(is_low[target], 0.0, turn)[:, None] * mesh.normals[target]
    return ReliableNormals(normals, _folds(mesh, normals, is_low))


def _across(mesh: MeshFacts, triangles: Ints, low: Indices, longest: Indices) -> tuple[Indices, Floats]:
    """The triangles beyond the longest sides, and -1 where they run the other way round; themselves at a border."""
    n = int(triangles.max(initial=-1)) + 1
    ends = np.stack([triangles[low, longest], triangles[low, (longest + 1) % 3]], axis=1)
    edge = np.searchsorted(edge_keys(mesh.edges, n), edge_keys(np.sort(ends, axis=1), n))
    first = mesh.offsets[edge]
    two = mesh.offsets[edge + 1] - first == 2
    one, other = mesh.incident[first], mesh.incident[np.where(two, first + 1, first)]
    beyond = np.where(two, np.where(one == low, other, one), low)
    return beyond, np.where(two & (mesh.balance[edge] != 0), -1.0, 1.0)


def _folds(mesh: MeshFacts, normals: Floats, changed: npt.NDArray[np.bool_]) -> Floats:
    """Cosines of all folds, those at the changed triangles anew."""
    at_changed = np.flatnonzero(changed[mesh.incident])
    edge = np.searchsorted(mesh.offsets, at_changed, side="right") - 1
    two = distinct(edge[mesh.offsets[edge + 1] - mesh.offsets[edge] == 2])
    one, other = mesh.incident[mesh.offsets[two]], mesh.incident[mesh.offsets[two] + 1]
    known = normals[one].any(axis=1) & normals[other].any(axis=1)
    cosine = (normals[one] * normals[other]).sum(axis=1) * np.where(mesh.balance[two] == 0, 1.0, -1.0)
    fold = mesh.fold.copy()
    fold[two] = np.where(known, cosine, np.nan)
    return fold
