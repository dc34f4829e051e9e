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
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr._kernel import MeshFacts
from hlr.distinct import distinct
from hlr.scene.groups import touching
from hlr.scene.scene import Chains, Groups
from hlr.scene.topology import STRAIGHT_ON, Keys
from hlr.source.model import EdgeClass, Floats, Ints
from hlr.tolerance import CONTACT

SLIGHT_ANGLE = 0.35
"""Sine: two tessellations of one curved surface never cross at more, turning by half a radian per chord at most."""

FLUSH = 0.25
"""In deflections, an eighth of the accuracy: a wall that reaches less far beyond a planar face stands on it, and has no
line there but its own edge. That has to be forgiven in view depth as well, which is more, the more obliquely one looks:
`hlr.tolerance` gives it ten times as much."""

PLANAR = 2.0
"""In deflections: what counts as touching where planar parts meet at a small angle."""

SELF = 0.1
"""Of the contact tolerance: one face of a solid does not touch another of the same solid, so less is forgiven. On sound
solids facets cross by a fifth of a deflection at most."""

BRIDGE = 4.0
"""In roots of the contact tolerance times the smaller part's size: surfaces of that radius that are tangent at a point
differ by less than the tolerance over 2.8 of these."""

DEEP_ENOUGH = 0.03
"""Of the contact tolerance: what was rounded goes less deep than that; facets that cross at a small angle go deeper."""

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
    tests: int = 0
    """Pairs of triangles that were looked at."""


def no_clashes(groups: int) -> Clashes:
    """What is found where there is nothing to find."""
    none = np.zeros((0, 2), np.int32)
    return Clashes(np.zeros((0, 3)), none, none, np.zeros(groups, bool))


def clashes(
    points: Floats,
    triangles: Ints,
    mesh: MeshFacts,
    group_of: Ints,
    groups: Groups,
    itself: npt.NDArray[np.bool_],
    curved: npt.NDArray[np.bool_],
    deflection: float,
) -> Clashes:
    """All real intersections of different groups, and of the groups chosen by `itself` (g,) with themselves.

    curved (t,) bool: triangles of faces that are not planar, or that may be anything.
    """
    found = _kernel.clashes(points, triangles, group_of, itself)
    if not len(found["triangles"]):
        return replace(no_clashes(len(itself)), tests=int(found["tests"]))
    group = np.asarray(group_of[found["triangles"]].reshape(-1, 2))
    touch = touching(groups, CONTACT * deflection, PLANAR * deflection)[group].max(axis=1, initial=0.0)
    touch = np.where((group[:, 0] == group[:, 1]) & ~groups.bare[group[:, 0]], SELF * touch, touch)
    reach, level = _reach(points, triangles, mesh, found["triangles"])
    # A planar face is where it is, and how far a wall goes beyond it is known; a facet is not.
    steep = found["sine"] >= SLIGHT_ANGLE
    known = steep[:, None] & ~curved[found["triangles"]]
    level = np.where(known, level * _lever(points, triangles, found["triangles"]), level)
    # Facets of a bare mesh may be the shape itself, and bend by any angle.
    true = ~groups.bare[group].any(axis=1)
    here = _here(points, triangles, mesh, found, np.where(true, touch, 0.0))
    here = np.where((steep & true)[:, None] & ~known & np.isfinite(here), here, np.minimum(level, here))
    level = np.where(true[:, None], here, level)
    spare = (level - np.where(known, np.minimum(FLUSH * deflection, touch[:, None]), touch[:, None])).min(axis=1)
    # Of several triangles that meet along one segment (an edge in a plane) one is enough.
    pair = _ranked(group[:, 0].astype(np.int64) * len(itself) + group[:, 1])
    ends = found["edges"].astype(np.int64)
    order = np.lexsort((ends[:, 1], ends[:, 0], pair))
    fresh = np.ones(len(order), bool)
    fresh[1:] = (pair[order][1:] != pair[order][:-1]) | (ends[order][1:] != ends[order][:-1]).any(axis=1)
    one, first = order[fresh], np.flatnonzero(fresh)
    beyond = np.maximum.reduceat(spare[order], first) if len(one) else np.zeros(0)
    sine = np.maximum.reduceat(found["sine"][order], first) if len(one) else np.zeros(0)
    reach = np.maximum.reduceat(reach[order], first) if len(one) else np.zeros(0)
    flush = (reach < FLUSH * deflection) & (sine >= SLIGHT_ANGLE)
    width = (groups.high - groups.low).max(axis=1)[group].min(axis=1, initial=np.inf)
    gap = BRIDGE * np.sqrt(touch * width)
    kept = one[_real(pair[one], ends[one], beyond, touch[one], sine, found["points"], gap[one]) & ~flush]
    through = np.zeros(len(itself), bool)
    through[group[kept, 0][group[kept, 0] == group[kept, 1]]] = True
    size = np.ptp(points[triangles[found["triangles"][kept]]], axis=2).max(axis=(1, 2), initial=0.0)
    alone = (group[kept, 0] == group[kept, 1]) & ~groups.bare[group[kept, 0]]
    kept = kept[~(alone & _small(pair[kept], ends[kept], found["points"], size))]
    # By place, not by the numbers of groups, which follow the order of triangles in the file.
    kept = kept[np.lexsort((ends[kept, 1], ends[kept, 0]))]
    used, edges = np.unique(ends[kept], return_inverse=True)
    return Clashes(
        points=found["points"][used],
        edges=np.ascontiguousarray(edges.reshape(-1, 2), np.int32),
        group=np.ascontiguousarray(group[kept], np.int32),
        through=through,
        tests=int(found["tests"]),
    )


def _reach(points: Floats, triangles: Ints, mesh: MeshFacts, pairs: Ints) -> tuple[Floats, Floats]:
    """(m,) how far each of two triangles (m, 2), with those beyond its edges, reaches beyond the other's plane on its
    shallower side; the lesser of both. Where that is nothing, one surface stands flush on the other.

    And (m, 2) how far the other triangle reaches beyond the plane of each, with no more than what goes on in its own
    plane beyond an edge along the crossing.

    ::

              |                         |
        ______|______ crosses     ______|______ stands on it: the triangle beyond the wall's lower edge is its
              |                    -----+       bottom, which goes no deeper
    """
    used, number = np.unique(pairs, return_inverse=True)
    number = number.reshape(-1, 2)
    # The three sides of each used triangle, and what lies beyond each: its own corner where there is nothing.
    edge_of = np.repeat(np.arange(len(mesh.edges), dtype=np.int64), np.diff(mesh.offsets))
    rank = np.full(len(triangles), -1, np.int64)
    rank[used] = np.arange(len(used))
    entry = np.flatnonzero(rank[mesh.incident] >= 0)
    entry = entry[np.argsort(rank[mesh.incident[entry]], kind="stable")]
    own = rank[mesh.incident[entry]]
    place = np.arange(len(entry)) - np.searchsorted(own, own)
    around = np.repeat(triangles[used][:, :1], 6, axis=1)
    around[:, :3] = triangles[used]
    edge = edge_of[entry]
    first = mesh.offsets[edge]
    other = np.where(mesh.incident[first] == mesh.incident[entry], first + 1, first)
    there = (other < mesh.offsets[edge + 1]) & (place < 3)
    beyond = mesh.incident[np.where(there, other, first)]
    apex = triangles[beyond].sum(axis=1, dtype=np.int64) - mesh.edges[edge].sum(axis=1, dtype=np.int64)
    around[own[there], 3 + place[there]] = apex[there]
    border = np.zeros((len(used), 6, 2), np.int64) - 1
    border[own[there], 3 + place[there]] = mesh.edges[edge[there]]
    bend = np.einsum("ukc,uc->uk", points[around] - points[around[:, :1]], mesh.normals[used])
    little = ROUNDING * np.ptp(points[around], axis=1).max(axis=1, initial=0.0)[:, None]
    goes_on = (np.abs(bend) <= little) & (border[:, :, 0] >= 0)
    every, level = np.full(len(pairs), np.inf), np.empty((len(pairs), 2))
    for s, t in ((0, 1), (1, 0)):
        plane = pairs[:, s]
        away = points[around[number[:, t]]] - points[triangles[plane, 0]][:, None]
        height = np.einsum("mkc,mc->mk", away, mesh.normals[plane])
        every = np.minimum(every, np.minimum(height.max(axis=1), -height.min(axis=1)))
        ends = points[border[number[:, t]]] - points[triangles[plane, 0]][:, None, None]
        off = np.abs(np.einsum("mkec,mc->mke", ends, mesh.normals[plane])).max(axis=2)
        taken = goes_on[number[:, t]] & (off <= little[number[:, t]])
        taken[:, :3] = True
        height = np.where(taken, height, height[:, :1])
        level[:, s] = np.minimum(height.max(axis=1), -height.min(axis=1))
    return every, level


def _here(points: Floats, triangles: Ints, mesh: MeshFacts, found: dict[str, Any], most: Floats) -> Floats:
    """(m, 2) how far the other surface goes beyond the plane of each triangle, near their common segment, up to `most`.

    ::

                   .v----------A      the shaft's facet crosses a triangle at v, a corner on the rim of its bore: that A
          bore   . ' ------           lies beyond the facet's plane, far away, says nothing about how deep the shaft
                /     ----B           goes into the block, for there the rim is near
    """
    middle = found["points"][found["edges"]].mean(axis=1)
    facts = mesh.edges, mesh.offsets, mesh.incident, mesh.normals
    return _kernel.reach(points, triangles, *facts, found["triangles"], middle, most)


def _lever(points: Floats, triangles: Ints, pairs: Ints) -> Floats:
    """(m, 2) at most 1: how much of what is measured from a triangle's plane is certain, so far out as the other goes.

    What is rounded at the corners of a sliver tilts its plane, the more, the less high it is.
    """
    corners = points[triangles[pairs]]
    sides = np.roll(corners, -1, axis=2) - corners
    longest = np.sqrt((sides**2).sum(axis=3).max(axis=2, initial=0.0))
    area = np.sqrt((np.cross(sides[:, :, 0], sides[:, :, 1]) ** 2).sum(axis=2))
    with np.errstate(divide="ignore", invalid="ignore"):
        lever = area / longest / longest[:, ::-1]
    return np.asarray(np.minimum(np.nan_to_num(lever, nan=0.0), 1.0))


def _real(
    pair: Keys, ends: Keys, beyond: Floats, touch: Floats, sine: Floats, points: Floats, gap: Floats
) -> npt.NDArray[np.bool_]:
    """(m,) bool: segments of real intersections.

    pair (m,): which two groups; ends (m, 2); beyond (m,): depth over the contact tolerance touch (m,); gap (m,): a
    length. What is neither deep nor steep is a contact, unless it closes a gap: where surfaces that cross are tangent
    at a point.
    """
    node = _nodes(pair, ends)
    clear = (beyond >= 0.0) | (sine >= SLIGHT_ANGLE)
    out = np.zeros(len(pair), bool)
    figure = _figures(node[clear])
    deepest = np.full(int(figure.max(initial=-1)) + 1, -1.0)
    np.maximum.at(deepest, figure, beyond[clear])
    out[clear] = deepest[figure] >= 0.0
    slight = np.flatnonzero(~clear)
    ends_real = np.zeros(int(node.max(initial=-1)) + 1, bool)
    ends_real[node[out]] = True
    held = ends_real[node[slight]]
    bridge = _figures(node[slight])
    nodes = np.int64(node.max(initial=0) + 1)
    held_nodes = distinct(np.repeat(bridge, 2)[held.ravel()] * nodes + node[slight].ravel()[held.ravel()])
    holds = np.bincount(held_nodes // nodes, minlength=int(bridge.max(initial=-1)) + 1)
    # Faces in one plane cross all over by what was rounded: that joins lines over any distance, and is nowhere deep.
    depth = np.zeros(len(holds))
    np.maximum.at(depth, bridge, beyond[slight] / touch[slight] + 1.0)
    closes = (holds > 1) & (depth >= DEEP_ENOUGH)
    out[slight] = closes[bridge] & (_extents(bridge, points[ends[slight]]) < gap[slight])
    return out


def _extents(figure: Ints, places: Floats) -> Floats:
    """(m,) the longest side of the box of each segment's figure. figure (m,), places (m, 2, 3)."""
    low, high = np.full((len(figure), 3), np.inf), np.full((len(figure), 3), -np.inf)
    for k in (0, 1):
        np.minimum.at(low, figure, places[:, k])
        np.maximum.at(high, figure, places[:, k])
    return np.asarray((high - low).max(axis=1, initial=0.0)[figure])


def _small(pair: Keys, ends: Keys, points: Floats, size: Floats) -> npt.NDArray[np.bool_]:
    """(m,) bool: figures hardly larger than the triangles they lie on (size (m,)).

    Where a curved face meets itself in a point, all triangles around it cross one another: what they have in common is
    the tessellation's, not the shape's.
    """
    figure = _figures(_nodes(pair, ends))
    largest = np.zeros(len(figure))
    np.maximum.at(largest, figure, size)
    return np.asarray(_extents(figure, points[ends]) < 2.0 * largest[figure])


def _nodes(pair: Keys, ends: Keys) -> Keys:
    """(m, 2) numbers of ends, told apart by pair of groups."""
    return _ranked(np.stack([pair * np.int64(ends.max(initial=0) + 1) + ends[:, k] for k in (0, 1)], axis=1))


def _ranked(keys: Keys) -> Keys:
    """Keys replaced by their ranks, same shape."""
    _, rank = np.unique(keys, return_inverse=True)
    return np.asarray(rank.reshape(keys.shape), np.int64)


def _figures(ends: Keys) -> Ints:
    """(m,) a number per connected figure of segments (m, 2)."""
    if not len(ends):
        return np.zeros(0, np.int32)
    return _kernel.edge_components(np.ascontiguousarray(ends, np.int32), int(ends.max()) + 1)


def intersection_walks(met: Clashes, part_of_group: Ints, first: int) -> Chains:
    """The segments chained per pair of groups, the scene's number of the first is `first`.

    Where two lines cross, as those of two cylinders of one radius do, each goes straight on.
    """
    group = met.group
    key = _ranked(group[:, 0].astype(np.int64) << 32 | group[:, 1])
    offsets, order, backward = _kernel.chain(met.edges, key.astype(np.int32), met.points, STRAIGHT_ON)
    parts = np.sort(part_of_group[group[order[offsets[:-1]]]], axis=1)
    return Chains(
        offsets=offsets,
        edges=order + np.int32(first),
        reversed=backward,
        kind=np.full(len(parts), EdgeClass.INTERSECTION, np.uint8),
        part=np.ascontiguousarray(parts[:, 0]),
        index=np.full(len(parts), -1, np.int32),
        other=np.ascontiguousarray(parts[:, 1]),
        face=np.full(len(parts), -1, np.int32),
        straight=np.zeros(len(parts), bool),
    )


def crossed_parts(met: Clashes, part_of_group: Ints) -> Ints:
    """Parts of which one surface passes through another, or through itself."""
    if not len(met.group) and not met.through.any():
        return np.zeros(0, np.int32)
    a, b = part_of_group[met.group[:, 0]], part_of_group[met.group[:, 1]]
    return np.asarray(distinct(np.concatenate([a[a == b], part_of_group[np.flatnonzero(met.through)]])), np.int32)


def distrusted(groups: Groups, which: npt.NDArray[np.bool_]) -> Groups:
    """Groups that pass through or touch themselves are looked at from both sides, and searched for where."""
    return replace(groups, sound=groups.sound & ~which, cull=groups.cull & ~which)
