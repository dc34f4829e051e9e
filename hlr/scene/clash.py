"""Where surfaces pass through one another: intersection lines, and solids that pass through themselves.

Two surfaces that only touch cross as well, here and there, by what tessellation and files round. What counts is how
deep they go: a figure of connected segments is real where at least one of its triangles reaches beyond the other's
plane, on both sides, by more than the contact tolerance.

::

        \\   /            ___________      a shaft in a bore of the same radius: the facets cross,
         \\ /  real       ‾‾‾\\_/‾‾‾\\_/‾     by less than the deflection, at small angles
          X
         / \\
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.scene.groups import touching
from hlr.scene.scene import Chains, Groups
from hlr.scene.topology import MeshFacts
from hlr.source.model import EdgeClass, Floats, Ints
from hlr.tolerance import CONTACT, CONTACT_PLANAR

SLIGHT_ANGLE = 0.35
"""Sine: two tessellations of one curved surface never cross at more, turning by half a radian per chord at most."""

ROUNDING = 1e-9
"""Of a group's size: planar faces are flat within this share of it."""


@dataclass(frozen=True, slots=True)
class Clashes:
    """Segments of intersection lines.

    points (n, 3); edges (m, 2) into them; group (m, 2) per edge, the lower first; through (g,) bool: the group passes
    through itself.
    """

    points: Floats
    edges: Ints
    group: Ints
    through: npt.NDArray[np.bool_]


def clashes(
    points: Floats, triangles: Ints, group_of: Ints, groups: Groups, itself: npt.NDArray[np.bool_], deflection: float
) -> Clashes:
    """All real intersections of different groups, and of the groups chosen by `itself` (g,) with themselves."""
    found = _kernel.clashes(points, triangles, group_of, itself)
    depth, sine = found["depth"], found["sine"]
    pair = np.asarray(group_of[found["triangles"]].reshape(-1, 2))
    touch = touching(groups, CONTACT * deflection, CONTACT_PLANAR * deflection)[pair].max(axis=1, initial=0.0)
    kept = np.flatnonzero((depth >= touch) | (sine >= SLIGHT_ANGLE))
    # Of several triangles that meet along one segment (an edge in a plane) one is enough.
    row = np.concatenate([pair[kept], found["edges"][kept]], axis=1)
    row, first = np.unique(row, axis=0, return_inverse=True)
    deepest = np.full(len(row), -1.0)
    np.maximum.at(deepest, first.ravel(), (depth - touch)[kept])
    real = _figures(row)
    most = np.full(int(real.max(initial=-1)) + 1, -1.0)
    np.maximum.at(most, real, deepest)
    row = row[most[real] >= 0.0]
    through = np.zeros(len(itself), bool)
    through[row[row[:, 0] == row[:, 1], 0]] = True
    used, edges = np.unique(row[:, 2:], return_inverse=True)
    return Clashes(
        points=found["points"][used],
        edges=np.ascontiguousarray(edges.reshape(-1, 2), np.int32),
        group=np.ascontiguousarray(row[:, :2], np.int32),
        through=through,
    )


def _figures(row: Ints) -> Ints:
    """(m,) a number per connected figure of segments of one pair of groups; row (m, 4): groups and ends."""
    if not len(row):
        return np.zeros(0, np.int32)
    ends = np.concatenate([row[:, [0, 1, 2]], row[:, [0, 1, 3]]])
    _, number = np.unique(ends, axis=0, return_inverse=True)
    edges = np.ascontiguousarray(number.reshape(2, -1).T, np.int32)
    return _kernel.edge_components(edges, int(edges.max()) + 1)


def intersection_walks(edges: Ints, group: Ints, part_of_group: Ints, first: int) -> Chains:
    """The segments chained per pair of groups. edges (m, 2), the scene's number of the first is `first`."""
    _, key = np.unique(group, axis=0, return_inverse=True)
    offsets, order, backward = _kernel.chain(edges, np.ascontiguousarray(key.ravel(), np.int32))
    parts = np.sort(part_of_group[group[order[offsets[:-1]]]], axis=1)
    return Chains(
        offsets=offsets,
        edges=order + np.int32(first),
        reversed=backward,
        kind=np.full(len(parts), EdgeClass.INTERSECTION, np.uint8),
        part=np.ascontiguousarray(parts[:, 0]),
        index=np.full(len(parts), -1, np.int32),
        other=np.ascontiguousarray(parts[:, 1]),
    )


def distrusted(groups: Groups, through: npt.NDArray[np.bool_]) -> Groups:
    """Groups that pass through themselves are looked at from both sides, and searched for where."""
    return replace(groups, sound=groups.sound & ~through, cull=groups.cull & ~through)


def may_fold_into_itself(
    points: Floats, triangles: Ints, mesh: MeshFacts, group_of: Ints, groups: Groups
) -> npt.NDArray[np.bool_]:
    """(g,) bool: not one convex body, so that it is worth a look."""
    count = len(groups.closed)
    incident, offsets = mesh.incident, mesh.offsets
    first = offsets[:-1]
    edge_group = group_of[incident[first]]
    two = np.diff(offsets) == 2
    bent = np.bincount(edge_group[~two], minlength=count) > 0
    s, t = incident[first[two]], incident[first[two] + 1]
    ends = mesh.edges[two]
    apex = triangles[t].sum(axis=1, dtype=np.int64) - ends.sum(axis=1, dtype=np.int64)
    away = points[apex] - points[ends[:, 0]]
    height = np.einsum("ij,ij->i", mesh.normals[s], away)
    size = np.where(np.isfinite(groups.low[:, 0]), (groups.high - groups.low).max(axis=1), 0.0)
    hollow = height > ROUNDING * size[edge_group[two]]
    bent |= np.bincount(edge_group[two][hollow], minlength=count) > 0
    piece = _kernel.components(triangles, len(points))
    pieces = np.bincount(np.unique(group_of.astype(np.int64) << 32 | piece) >> 32, minlength=count)
    return np.asarray(bent | ~groups.cull | (pieces != 1))
