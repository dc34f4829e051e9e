"""From meshed parts to the scene: one set of arrays, checked part by part."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.errors import SourceError
from hlr.scene.repair import without_duplicates
from hlr.scene.scene import INTERIOR, Groups, Scene, ScenePart
from hlr.scene.topology import crease_walks, creases, folded_back, joined, mesh_facts, source_walks
from hlr.source.model import Floats, Ints, Meshed, PartMesh

MOST_TRIANGLES = 2**31 // 3 - 1
"""Indices are 32 bits wide; three sides a triangle."""


def build(meshed: Meshed, crease: float) -> Scene:
    """The scene of all parts. crease: degrees, for parts without B-rep.

    Raises SourceError where nothing is left to draw.
    """
    parts: list[PartMesh] = []
    doubled: list[int] = []
    for part in meshed.parts:
        kept, count = without_duplicates(part)
        parts.append(kept)
        doubled.append(count)
    if sum(len(p.triangles) for p in parts) > MOST_TRIANGLES:
        raise SourceError("the model has more than 700 million triangles: give a coarser accuracy")
    firsts = _firsts([len(p.points) for p in parts])
    points: Floats = np.concatenate([np.zeros((0, 3)), *[p.points for p in parts]])
    if not np.isfinite(points).all():
        raise SourceError("the tessellation holds coordinates that are not finite: repair the model")
    triangles = np.concatenate([np.zeros((0, 3), np.int32), *[p.triangles + firsts[i] for i, p in enumerate(parts)]])
    face = np.concatenate([np.zeros(0, np.int32), *[p.triangle_face for p in parts]])
    part_of = np.repeat(np.arange(len(parts), dtype=np.int32), [len(p.triangles) for p in parts])
    mesh = mesh_facts(points, triangles)
    edges, offsets, incident, balance = mesh.edges, mesh.offsets, mesh.incident, mesh.balance

    brep = np.array([p.brep for p in parts], bool)
    curved = _curved(parts, part_of, face)
    edge_part = part_of[incident[offsets[:-1]]]
    bare = ~brep[edge_part]
    walks, loose = source_walks(parts, firsts, edges, len(points))
    kind = np.full(len(edges) + len(loose), INTERIOR, np.uint8)
    if bare.any():
        kind[: len(edges)] = creases(mesh, bare, crease, len(points))
        walks = joined(walks, crease_walks(edges, kind[: len(edges)], edge_part, bare))
    # Backwards, so that of several source edges along one mesh edge the first gives its class.
    kind[walks.edges[::-1]] = np.repeat(walks.kind, np.diff(walks.offsets))[::-1]

    whole = brep & (np.bincount(edge_part[balance != 0], minlength=len(parts)) == 0)
    group_of, group_part = _groups(whole, triangles, part_of, len(points))
    groups = _checked(points, triangles, group_of, group_part, edges, offsets, incident, balance, brep, curved)
    if len(loose):
        # Wires of no face: edges without triangles, in a group of their own part.
        vertex_part = np.repeat(np.arange(len(parts), dtype=np.int32), [len(p.points) for p in parts])
        loose_part = vertex_part[loose[:, 0]]
        edges = np.concatenate([edges, loose])
        offsets = np.concatenate([offsets, np.full(len(loose), offsets[-1], np.int32)])
        edge_part = np.concatenate([edge_part, loose_part])
    edge_group = np.zeros(len(edges), np.int32)
    tied = np.diff(offsets) > 0
    edge_group[tied] = group_of[incident[offsets[:-1][tied]]]
    if len(loose):
        groups, edge_group[~tied] = _with_loose(groups, points, loose, loose_part)
    edge_curved = np.zeros(len(edges), bool)
    edge_curved[tied] = np.logical_or.reduceat(curved[incident], offsets[:-1][tied])
    edge_curved[: len(balance)] &= ~folded_back(mesh)
    if len(points) == 0 or len(edges) == 0:
        raise SourceError("nothing to draw: no part has a face or an edge")
    reports = _reports(parts, doubled, groups, group_part, part_of, edge_part, balance, offsets, kind)
    return Scene(
        points=points,
        triangles=triangles,
        triangle_part=part_of,
        triangle_group=group_of,
        triangle_face=face,
        edges=np.ascontiguousarray(edges),
        offsets=offsets,
        incident=incident,
        edge_part=edge_part,
        edge_group=edge_group,
        edge_kind=kind,
        edge_curved=edge_curved,
        groups=groups,
        chains=walks,
        parts=reports,
        notes=tuple(meshed.notes),
    )


def _firsts(counts: list[int]) -> Ints:
    out = np.zeros(len(counts), np.int32)
    np.cumsum(counts[:-1], out=out[1:])
    return out


def _curved(parts: list[PartMesh], part_of: Ints, face: Ints) -> npt.NDArray[np.bool_]:
    """(t,) bool: the triangle lies on a face that may show an outline."""
    firsts = _firsts([len(p.face_planar) for p in parts])
    planar = np.concatenate([np.zeros(0, bool), *[p.face_planar for p in parts]])
    return np.asarray(~planar[firsts[part_of] + face])


def _groups(whole: npt.NDArray[np.bool_], triangles: Ints, part_of: Ints, n_points: int) -> tuple[Ints, Ints]:
    """Per triangle its group, per group its part: closed B-rep parts whole, everything else by connected piece.

    Faces of an IGES file that nobody sewed together touch like strangers do, and need the same tolerance.
    """
    if whole.all():
        return part_of.copy(), np.arange(len(whole), dtype=np.int32)
    piece = _kernel.components(triangles, n_points)
    # Whole parts first, numbered as they are; then the pieces of the others.
    label = np.where(whole[part_of], part_of, piece + len(whole)).astype(np.int64)
    used, group = np.unique(label, return_inverse=True)
    group = group.ravel().astype(np.int32)
    first = np.zeros(len(used), np.int64)
    first[group[::-1]] = np.arange(len(triangles))[::-1]
    return np.asarray(group, np.int32), part_of[first]


def _checked(
    points: Floats,
    triangles: Ints,
    group_of: Ints,
    group_part: Ints,
    edges: Ints,
    offsets: Ints,
    incident: Ints,
    balance: Ints,
    brep: npt.NDArray[np.bool_],
    curved: npt.NDArray[np.bool_],
) -> Groups:
    count = len(group_part)
    edge_group = group_of[incident[offsets[:-1]]]
    odd = np.bincount(edge_group[balance != 0], minlength=count)
    used = np.bincount(group_of, minlength=count) > 0
    closed = (odd == 0) & used
    low = np.full((count, 3), np.inf)
    high = np.full((count, 3), -np.inf)
    order = np.argsort(group_of, kind="stable")
    starts = np.flatnonzero(np.diff(group_of[order], prepend=-1))
    corner = points[triangles[order]]
    if len(order):
        which = group_of[order][starts]
        low[which] = np.minimum.reduceat(corner.min(axis=1), starts, axis=0)
        high[which] = np.maximum.reduceat(corner.max(axis=1), starts, axis=0)
    # Signed volume about the group's own corner: small numbers, so that a far-away part keeps its sign.
    origin = np.where(np.isfinite(low), low, 0.0)[group_of]
    p, q, r = (points[triangles[:, k]] - origin for k in range(3))
    six = (
        p[:, 0] * (q[:, 1] * r[:, 2] - q[:, 2] * r[:, 1])
        + p[:, 1] * (q[:, 2] * r[:, 0] - q[:, 0] * r[:, 2])
        + p[:, 2] * (q[:, 0] * r[:, 1] - q[:, 1] * r[:, 0])
    )
    volume = np.bincount(group_of, weights=six, minlength=count)
    extent = np.where(used, (high - low).min(axis=1), 0.0)
    return Groups(
        closed=closed,
        cull=closed & (volume > 0.0),
        sound=closed & brep[group_part],
        bare=~brep[group_part],
        planar=np.bincount(group_of[curved], minlength=count) == 0,
        extent=extent,
        low=low,
        high=high,
    )


def _with_loose(groups: Groups, points: Floats, loose: Ints, loose_part: Ints) -> tuple[Groups, Ints]:
    """One open group more per part that has wires of no face."""
    owners, which = np.unique(loose_part, return_inverse=True)
    n, m = len(groups.closed), len(owners)
    no = np.zeros(m, bool)
    ends = points[loose]
    low = np.full((m, 3), np.inf)
    high = np.full((m, 3), -np.inf)
    np.minimum.at(low, which.ravel(), ends.min(axis=1))
    np.maximum.at(high, which.ravel(), ends.max(axis=1))
    more = Groups(
        closed=np.concatenate([groups.closed, no]),
        cull=np.concatenate([groups.cull, no]),
        sound=np.concatenate([groups.sound, ~no]),
        bare=np.concatenate([groups.bare, no]),
        planar=np.concatenate([groups.planar, ~no]),
        extent=np.concatenate([groups.extent, np.zeros(m)]),
        low=np.concatenate([groups.low, low]),
        high=np.concatenate([groups.high, high]),
    )
    return more, (n + which.ravel()).astype(np.int32)


def _reports(
    parts: list[PartMesh],
    doubled: list[int],
    groups: Groups,
    group_part: Ints,
    part_of: Ints,
    edge_part: Ints,
    balance: Ints,
    offsets: Ints,
    kind: npt.NDArray[np.uint8],
) -> tuple[ScenePart, ...]:
    n = len(parts)
    uses = np.diff(offsets)[: len(balance)]
    own = edge_part[: len(balance)]
    border = np.bincount(own[uses == 1], minlength=n)
    crowded = np.bincount(own[uses > 2], minlength=n)
    turned = np.bincount(own[(uses == 2) & (balance != 0)], minlength=n)
    unclosed = np.bincount(group_part, weights=~groups.closed[: len(group_part)], minlength=n) > 0
    outside_in = np.bincount(group_part, weights=(groups.closed & ~groups.cull)[: len(group_part)], minlength=n)
    triangles = np.bincount(part_of, minlength=n)
    drawn = np.bincount(edge_part[kind != INTERIOR], minlength=n)
    out = []
    for i, part in enumerate(parts):
        defects = []
        if doubled[i]:
            defects.append(f"{doubled[i]} duplicated triangles")
        if border[i]:
            defects.append(f"open: {border[i]} border edges")
        if crowded[i]:
            defects.append(f"{crowded[i]} non-manifold edges")
        if turned[i]:
            defects.append(f"{turned[i]} edges between faces of opposite orientation")
        if outside_in[i]:
            pieces = f"{int(outside_in[i])} closed pieces turned inside out or hollow"
            defects.append("the solid is turned inside out" if part.brep else pieces)
        out.append(
            ScenePart(
                name=part.name,
                color=part.color,
                transform=part.transform,
                faces=len(part.face_planar) if part.brep else 0,
                edges=len(part.edge_index) if part.brep else int(drawn[i]),
                triangles=int(triangles[i]),
                closed=bool(triangles[i] > 0 and not border[i] and not unclosed[i]),
                oriented=bool(turned[i] == 0),
                defects=tuple(defects),
            )
        )
    return tuple(out)
