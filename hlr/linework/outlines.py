"""Outlines of curved faces: the contour of their mesh, cleaned of noise and chained face by face."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.distinct import distinct
from hlr.plan.plan import DRAWN, OUTLINE, Plan
from hlr.scene.scene import Scene
from hlr.source.model import EdgeClass, Ints
from hlr.visibility.segments import Segments

NOISE_EDGES = 6
"""A contour of fewer mesh edges that hangs on no other line is the mesh's roughness, not the shape's: a closed curve of
so few chords is coarser than any tessellation that turns by half a radian."""


@dataclass(frozen=True, slots=True)
class LineChains:
    """Walks over mesh edges that become lines.

    offsets (c+1,), edges (k,), reversed (k,) bool; kind (c,) EdgeClass, part (c,), edge (c,) and face (c,) in the
    part's TopExp maps, other (c,) the second part of an intersection line; -1 where there is none. noisy (c,): the
    contour of a mesh, which may turn to and fro by an edge. straight (c,): known to be, so that no curve is looked for.
    """

    offsets: Ints
    edges: Ints
    reversed: npt.NDArray[np.bool_]
    kind: npt.NDArray[np.uint8]
    part: Ints
    edge: Ints
    face: Ints
    other: Ints
    noisy: npt.NDArray[np.bool_]
    straight: npt.NDArray[np.bool_]


def outlines(scene: Scene, plan: Plan, segments: Segments) -> LineChains:
    """Chains of the contour edges among the segments' edges."""
    found = distinct(segments.edge).astype(np.int32)
    found = found[scene.offsets[found + 1] > scene.offsets[found]]
    owner, folds = _facing(scene, segments.facing, found)
    role = plan.role[found]
    # What the kernel drew only as a contour is one; edges drawn anyway are one where the surface folds there.
    contour = ((role & DRAWN) == 0) | folds
    keep = contour & ((role & OUTLINE) != 0) & ~_noise(scene, found)
    return _chained(scene, found[keep], owner[keep])


def _facing(scene: Scene, facing: npt.NDArray[np.int8], edges: Ints) -> tuple[Ints, npt.NDArray[np.bool_]]:
    """Per edge the incident triangle that faces the viewer most, and whether another one faces away."""
    first, last = scene.offsets[edges], scene.offsets[edges + 1]
    owner = scene.incident[first]
    farthest = facing[owner]
    for k in range(1, int((last - first).max(initial=0))):
        other = scene.incident[np.minimum(first + k, last - 1)]
        owner = np.where(facing[other] > facing[owner], other, owner)
        farthest = np.minimum(farthest, facing[other])
    return owner, (facing[owner] > 0) & (farthest <= 0)


def _noise(scene: Scene, found: Ints) -> npt.NDArray[np.bool_]:
    """(k,) bool: the edge belongs to a figure of a few edges, apart from all other lines of its surface."""
    if len(found) == 0:
        return np.zeros(0, bool)
    figure = _kernel.edge_components(np.ascontiguousarray(scene.edges[found]), len(scene.points))
    size = np.bincount(figure)
    group = np.zeros(len(size), np.int32)
    group[figure] = scene.edge_group[found]
    largest = np.zeros(len(scene.groups.closed), np.int64)
    np.maximum.at(largest, group, size)
    return np.asarray(((size < NOISE_EDGES) & (size < largest[group]))[figure])


def _chained(scene: Scene, contour: Ints, owner: Ints) -> LineChains:
    """The face toward the viewer owns the outline; it is chained within that face, of a mesh within the part."""
    has_faces = np.array([p.faces > 0 for p in scene.parts], bool)
    part = scene.triangle_part[owner]
    face = np.where(has_faces[part], scene.triangle_face[owner], -1)
    _, key = np.unique((part.astype(np.int64) << 32) + face, return_inverse=True)
    offsets, order, backward = _kernel.chain(
        np.ascontiguousarray(scene.edges[contour]), np.ascontiguousarray(key.ravel().astype(np.int32))
    )
    head = order[offsets[:-1]]
    return LineChains(
        offsets=offsets,
        edges=contour[order],
        reversed=backward,
        kind=np.full(len(head), EdgeClass.OUTLINE, np.uint8),
        part=part[head].astype(np.int32),
        edge=np.full(len(head), -1, np.int32),
        face=face[head].astype(np.int32),
        other=np.full(len(head), -1, np.int32),
        noisy=np.ones(len(head), bool),
        straight=np.zeros(len(head), bool),
    )
