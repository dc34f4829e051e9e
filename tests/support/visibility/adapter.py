"""Calls the kernel's visibility pass; no other module of these tests does."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hlr import _kernel
from hlr.common.threads import at_most
from support.visibility.scenes import Edge, Scene

Piece = tuple[float, float, int]
"""t0, t1, state."""
VISIBLE, HIDDEN, WITHIN = 0, 1, 2
DRAWN = 1


@dataclass(frozen=True)
class Way:
    """How a scene is given to the kernel.

    parts     every part is a group, and the wires are one more; else all is one group
    trusted   the parts are closed, oriented and sound: faces turned away may be culled
    bias      contact tolerance: an edge behind a face by no more than this is WITHIN, neither visible nor hidden;
              behind a face of its own trusted part it is hidden
    """

    parts: bool = False
    trusted: bool = False
    bias: int = 0


ONE = Way()
PARTS = Way(parts=True)
TRUSTED = Way(parts=True, trusted=True)


@dataclass(frozen=True)
class Found:
    """The kernel's answer: pieces per edge in order, and its counters."""

    pieces: dict[Edge, list[Piece]]
    counters: dict[str, int]


def edge_table(scene: Scene) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    points, triangles = scene.arrays()
    edges, offsets, incident = _kernel.edge_table(triangles, len(points))
    return edges, offsets, incident


def visibility(scene: Scene, way: Way, threads: int = 1, arithmetic: str = "exact") -> Found:
    """Every edge and wire of the scene, drawn."""
    points, triangles = scene.arrays()
    edges, offsets, incident = edge_table(scene)
    if way.bias:  # the kernel caps the tolerance at a fraction of the depth of all points; these two make room
        points = np.concatenate([points, [[0.0, 0.0, -64.0 * way.bias], [0.0, 0.0, 64.0 * way.bias]]])
    known = {(int(lo), int(hi)) for lo, hi in edges}
    extra = [edge for edge in scene.edges() if edge not in known]
    if extra:
        edges = np.concatenate([edges, np.array(extra, dtype=np.int32)])
        offsets = np.concatenate([offsets, np.full(len(extra), offsets[-1], dtype=np.int32)])
    triangle_part = np.zeros(len(triangles), dtype=np.int32)
    edge_part = np.zeros(len(edges), dtype=np.int32)
    parts = 1
    if way.parts:
        triangle_part = np.array(scene.parts, dtype=np.int32)
        parts = max(scene.parts, default=-1) + 2
        edge_part = np.array([scene.part_of((int(i), int(j))) % parts for i, j in edges], dtype=np.int32)
    mesh = _kernel.Mesh(points, triangles, np.ascontiguousarray(edges), np.ascontiguousarray(offsets), incident)
    given = _kernel.VisibilityInput.of(
        triangle_part,
        edge_part,
        np.full(len(edges), DRAWN, dtype=np.uint8),
        cull=np.full(parts, way.trusted),
        sound=np.full(parts, way.trusted),
        delta=np.full(parts, float(way.bias)),
        cap=np.full(parts, float(way.bias)),
        tight=np.zeros(parts, bool),
        drawn=[],
    )
    with at_most(threads):
        found = _kernel.visibility(mesh, points, given, arithmetic=arithmetic)
    pieces: dict[Edge, list[Piece]] = {}
    # State 3, an edge that dives into a face, counts as within the tolerance.
    for number, t0, t1, state in zip(found.edge, found.t0, found.t1, found.state, strict=True):
        edge = (int(edges[number][0]), int(edges[number][1]))
        pieces.setdefault(edge, []).append((float(t0), float(t1), min(int(state), WITHIN)))
    return Found(pieces, {name: int(value) for name, value in found.counters.items()})
