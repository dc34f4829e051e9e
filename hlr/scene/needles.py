"""Needles: triangles so low that their normals, and the folds at their edges, are rounding noise.

Exporters make them at T-junctions, where a vertex of a neighbour lies on an edge; but for rounding, the third corner
lies on the longest side:

    ::

              A                     the needle p q r, hardly higher than the coordinates are exact,
       p ----------- q              goes with A: it has A's normal, no fold against A,
         `--.. r ..--'              and against B and C the folds of A
            B  |  C

So an edge between two surfaces keeps its fold, and there is none where the surroundings are flat or smooth.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr._kernel import MeshFacts
from hlr.common.distinct import distinct
from hlr.common.types import Floats, Ints
from hlr.scene.walks import edge_keys
from hlr.source.mesh.cleaning import NEEDLE_HEIGHT

Indices = npt.NDArray[np.intp]

MAX_STEPS = 32
"""Needles in a row, each with its longest side on the next, that are followed; beyond that the normal is unknown."""


@dataclass(frozen=True, slots=True)
class ReliableNormals:
    """normals (t, 3), zero where unknown; fold (e,): cosines of fold angles, NaN where unknown."""

    normals: Floats
    fold: Floats


def reliable_normals(
    mesh: MeshFacts, points: Floats, triangles: Ints, part_of: Ints, precision: Floats
) -> ReliableNormals:
    """Normals and folds, those of needles taken from their neighbours; a triangle without area is a needle as well.

    part_of (t,): part of each triangle; precision (p,): rounding error of each part's coordinates, model units, or 0
    """
    low, longest = _kernel.needles(points, triangles, mesh.normals, part_of, NEEDLE_HEIGHT * precision)
    if not len(low):
        return ReliableNormals(mesh.normals, mesh.fold)
    # Follow needle to needle until the neighbour is none.
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
    """The neighbour of each needle at its longest side, itself at a border; and -1 where it is reversed, else 1."""
    n = int(triangles.max(initial=-1)) + 1
    ends = np.stack([triangles[low, longest], triangles[low, (longest + 1) % 3]], axis=1)
    edge = np.searchsorted(edge_keys(mesh.edges, n), edge_keys(np.sort(ends, axis=1), n))
    first = mesh.offsets[edge]
    two = mesh.offsets[edge + 1] - first == 2
    one, other = mesh.incident[first], mesh.incident[np.where(two, first + 1, first)]
    beyond = np.where(two, np.where(one == low, other, one), low)
    return beyond, np.where(two & (mesh.balance[edge] != 0), -1.0, 1.0)


def _folds(mesh: MeshFacts, normals: Floats, changed: npt.NDArray[np.bool_]) -> Floats:
    """Cosines of all folds, computed again at the changed triangles."""
    at_changed = np.flatnonzero(changed[mesh.incident])
    edge = np.searchsorted(mesh.offsets, at_changed, side="right") - 1
    two = distinct(edge[mesh.offsets[edge + 1] - mesh.offsets[edge] == 2])
    one, other = mesh.incident[mesh.offsets[two]], mesh.incident[mesh.offsets[two] + 1]
    known = normals[one].any(axis=1) & normals[other].any(axis=1)
    cosine = (normals[one] * normals[other]).sum(axis=1) * np.where(mesh.balance[two] == 0, 1.0, -1.0)
    fold = mesh.fold.copy()
    fold[two] = np.where(known, cosine, np.nan)
    return fold
