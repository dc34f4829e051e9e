"""Which mesh edges a source edge runs along, and which edges of a bare mesh are creases."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.scene.scene import Chains
from hlr.source.model import EdgeClass, Floats, Ints, PartMesh

STRAIGHT_ON = 30.0
"""Degrees: where more than two creases meet, a line goes on along the straightest if it turns by no more than this, and
no other is nearly as straight. A rim of twelve chords still does; the edges of a box never."""

Keys = npt.NDArray[np.int64]


def keys(edges: Ints, n: int) -> Keys:
    """(e, 2) -> (e,) one sortable number per edge, lower vertex first."""
    return np.asarray(edges[:, 0], np.int64) * np.int64(n) + edges[:, 1]


def source_walks(parts: list[PartMesh], firsts: Ints, edges: Ints, n: int) -> tuple[Chains, Ints]:
    """Chains of all B-rep edges, and the mesh edges (m, 2) that no triangle has and that had to be added.

    firsts[i] is the number of part i's first vertex among all; `edges` are ascending. Steps between one and the same
    vertex vanish.
    """
    nodes: list[Ints] = []
    counts: list[Ints] = []
    part_of: list[Ints] = []
    for i, part in enumerate(parts):
        if len(part.edge_index) == 0:
            continue
        nodes.append(part.edge_nodes + firsts[i])
        counts.append(np.diff(part.edge_offsets).astype(np.int32))
        part_of.append(np.full(len(part.edge_index), i, np.int32))
    if not nodes:
        none = np.zeros(0, np.int32)
        no = none.astype(bool)
        empty = Chains(np.zeros(1, np.int32), none, no, none.astype(np.uint8), none, none, none, none, no)
        return empty, none.reshape(0, 2)
    node = np.concatenate(nodes)
    count = np.concatenate(counts)
    walk = np.repeat(np.arange(len(count), dtype=np.int32), count)
    step = (walk[1:] == walk[:-1]) & (node[1:] != node[:-1])
    a, b, owner = node[:-1][step], node[1:][step], walk[:-1][step]
    backward = a > b
    steps = np.stack([np.minimum(a, b), np.maximum(a, b)], axis=1).astype(np.int32)
    key, known = keys(steps, n), keys(edges, n)
    at = np.searchsorted(known, key)
    found = (at < len(known)) & (known[np.minimum(at, max(len(known) - 1, 0))] == key) if len(known) else at < 0
    loose, which = np.unique(key[~found], return_inverse=True)
    extra = np.stack([loose // n, loose % n], axis=1).astype(np.int32)
    edge = at.astype(np.int32)
    edge[~found] = len(edges) + which.ravel().astype(np.int32)
    offsets = np.zeros(len(count) + 1, np.int32)
    np.cumsum(np.bincount(owner, minlength=len(count)), out=offsets[1:])
    walks = Chains(
        offsets=offsets,
        edges=edge,
        reversed=backward,
        kind=np.concatenate([p.edge_class for p in parts]).astype(np.uint8),
        part=np.concatenate(part_of),
        index=np.concatenate([p.edge_index for p in parts]).astype(np.int32),
        other=np.full(len(count), -1, np.int32),
        face=np.full(len(count), -1, np.int32),
        straight=np.zeros(len(count), bool),
    )
    return walks, extra


@dataclass(frozen=True, slots=True)
class MeshFacts:
    """Edges of the whole scene's mesh, view-independent.

    edges (e, 2), offsets (e+1,), incident (k,); balance (e,) triangles along minus triangles against the edge;
    fold (e,) cosine of the fold, NaN where there are not two triangles with area; normals (t, 3), zero without area.
    flat (k,) the triangles without area; repeated: a triangle is there twice.
    """

    edges: Ints
    offsets: Ints
    incident: Ints
    balance: Ints
    fold: Floats
    normals: Floats
    flat: npt.NDArray[np.int64]
    repeated: bool

    def first(self) -> Ints:
        """(e,) of each edge its first triangle."""
        return np.asarray(self.incident[self.offsets[:-1]])


def mesh_facts(points: Floats, triangles: Ints) -> MeshFacts:
    """What can be said of a mesh before any part or edge has a meaning."""
    return MeshFacts(*_kernel.mesh_facts(points, triangles))


def folded_back(mesh: MeshFacts) -> npt.NDArray[np.bool_]:
    """(e,) bool: the two triangles lie on top of one another, folded by more than a right angle.

    No smooth surface does that between two chords: where edge curve and surface differ by the file's own tolerance, the
    tessellation laps over itself in slivers. Such an edge is a contour to be counted, but not an outline to be drawn.
    """
    return np.asarray((mesh.fold < 0.0) & (mesh.balance == 0))


def crease_walks(points: Floats, edges: Ints, kind: npt.NDArray[np.uint8], part: Ints) -> Chains:
    """Creases and borders of bare meshes, joined where exactly two of a kind meet, and where one goes straight on."""
    chosen = np.flatnonzero(kind != 255).astype(np.int32)
    key = part[chosen].astype(np.int32) * 8 + kind[chosen]
    offsets, order, backward = _kernel.chain(
        np.ascontiguousarray(edges[chosen]), np.ascontiguousarray(key), points, STRAIGHT_ON
    )
    member = chosen[order]
    head = member[offsets[:-1]]
    return Chains(
        offsets=offsets,
        edges=member,
        reversed=backward,
        kind=kind[head],
        part=part[head].astype(np.int32),
        index=np.full(len(head), -1, np.int32),
        other=np.full(len(head), -1, np.int32),
        face=np.full(len(head), -1, np.int32),
        straight=np.zeros(len(head), bool),
    )


def between_planes(
    walks: Chains, mesh: MeshFacts, kind: npt.NDArray[np.uint8], curved: npt.NDArray[np.bool_]
) -> Chains:
    """The walks of B-rep edges, those marked that run between two planar faces at an angle; curved (t,), kind (e,)."""
    if not (walks.index >= 0).any():
        return walks
    count = len(mesh.offsets) - 1
    flat = np.zeros(len(kind), bool)
    if count:
        flat[:count] = ~np.logical_or.reduceat(curved[mesh.incident], mesh.offsets[:-1])
    flat[:count] &= (np.diff(mesh.offsets) == 2) & (kind[:count] == EdgeClass.SHARP)
    steps = np.diff(walks.offsets)
    straight = (steps > 0) & (walks.index >= 0)
    straight[straight] = (
        np.logical_and.reduceat(flat[walks.edges], walks.offsets[:-1][straight]) if straight.any() else ()
    )
    return replace(walks, straight=straight)


def joined(a: Chains, b: Chains) -> Chains:
    """All walks, sorted by part; within a part in the order given."""
    count = np.concatenate([np.diff(a.offsets), np.diff(b.offsets)])
    part = np.concatenate([a.part, b.part])
    order = np.argsort(part, kind="stable")
    start = np.concatenate([a.offsets[:-1], b.offsets[:-1] + len(a.edges)])[order]
    offsets = np.zeros(len(count) + 1, np.int32)
    np.cumsum(count[order], out=offsets[1:])
    member = np.arange(offsets[-1], dtype=np.int64) + np.repeat(start - offsets[:-1], count[order])
    return Chains(
        offsets=offsets,
        edges=np.concatenate([a.edges, b.edges])[member],
        reversed=np.concatenate([a.reversed, b.reversed])[member],
        kind=np.concatenate([a.kind, b.kind])[order],
        part=part[order],
        index=np.concatenate([a.index, b.index])[order],
        other=np.concatenate([a.other, b.other])[order],
        face=np.concatenate([a.face, b.face])[order],
        straight=np.concatenate([a.straight, b.straight])[order],
    )
