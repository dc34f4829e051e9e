"""The one place that knows how the kernel is called."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
from visibility.scenes import Edge, Scene

from hlr import _kernel

Piece = tuple[float, float, bool]
"""t0, t1, hidden."""
DRAWN = 1


@dataclass(frozen=True)
class Found:
    """The kernel's answer: pieces per edge in order, and its counters."""

    pieces: dict[Edge, list[Piece]]
    counters: dict[str, int]


def edge_table(scene: Scene) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    points, triangles = scene.arrays()
    edges, offsets, incident = _kernel.edge_table(triangles, len(points))
    return edges, offsets, incident


def visibility(scene: Scene, threads: int = 1, *, solids: bool = False) -> Found:
    """Every edge and wire of the scene, drawn.

    solids   False: all is one part of which nothing is assumed.
             True: every solid is a part, closed, oriented and sound; wires are a part of their own.
    """
    points, triangles = scene.arrays()
    edges, offsets, incident = edge_table(scene)
    known = {(int(lo), int(hi)) for lo, hi in edges}
    extra = [edge for edge in scene.edges() if edge not in known]
    if extra:
        edges = np.concatenate([edges, np.array(extra, dtype=np.int32)])
        offsets = np.concatenate([offsets, np.full(len(extra), offsets[-1], dtype=np.int32)])
    triangle_part = np.zeros(len(triangles), dtype=np.int32)
    edge_part = np.zeros(len(edges), dtype=np.int32)
    parts = 1
    if solids:
        triangle_part = np.array(scene.solids, dtype=np.int32)
        parts = int(triangle_part.max(initial=-1)) + 2
        edge_part = np.array(
            [
                triangle_part[incident[start]] if start < end else parts - 1
                for start, end in itertools.pairwise(offsets)
            ],
            dtype=np.int32,
        )
    found = _kernel.visibility(
        points,
        triangles,
        triangle_part,
        np.ascontiguousarray(edges),
        np.ascontiguousarray(offsets),
        incident,
        edge_part,
        role=np.full(len(edges), DRAWN, dtype=np.uint8),
        cull=np.full(parts, solids),
        sound=np.full(parts, solids),
        delta=np.zeros(parts),
        threads=threads,
    )
    pieces: dict[Edge, list[Piece]] = {}
    for number, t0, t1, state in zip(found["edge"], found["t0"], found["t1"], found["state"], strict=True):
        edge = (int(edges[number][0]), int(edges[number][1]))
        if state not in (0, 1):
            raise AssertionError(f"edge {edge}: state {state} without a depth bias")
        pieces.setdefault(edge, []).append((float(t0), float(t1), bool(state)))
    return Found(pieces, {name: int(value) for name, value in found["counters"].items()})
