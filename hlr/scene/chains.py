"""Chains: mesh edges joined end to end into the lines of a source edge, a crease or a border."""

from __future__ import annotations

from dataclasses import fields

import numpy as np
import numpy.typing as npt

from hlr import _kernel
from hlr.common.types import Floats, Ints
from hlr.scene.scene import Chains

STRAIGHT_ON = 30.0
"""Degrees: where more than two creases meet, a chain continues along the straightest one if it turns by no more than
this, and no other is nearly as straight. A rim of twelve chords continues; the edges of a box never do."""

Keys = npt.NDArray[np.int64]


def edge_keys(edges: Ints, n: int) -> Keys:
    """(e, 2) -> (e,) one sortable number per edge, lower vertex first."""
    return np.asarray(edges[:, 0], np.int64) * np.int64(n) + edges[:, 1]


def crease_chains(points: Floats, edges: Ints, kind: npt.NDArray[np.uint8], part: Ints) -> Chains:
    """Chains of creases and borders of meshes, joined where exactly two of a kind meet, or one goes straight on.

    points (n, 3); edges (e, 2); kind (e,): EdgeClass or 255 for none; part (e,).
    """
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
        curve=np.full(len(head), -1, np.int32),
    )


def merge_chains(a: Chains, b: Chains) -> Chains:
    """All chains, sorted by part; within a part those of `a` first."""
    if not len(a.part) or not len(b.part) or a.part[-1] <= b.part[0]:
        return _one_after_another(a, b)
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
        curve=np.concatenate([a.curve, b.curve])[order],
    )


def _one_after_another(a: Chains, b: Chains) -> Chains:
    """The chains of `a`, then those of `b`."""
    columns = {each.name: (getattr(a, each.name), getattr(b, each.name)) for each in fields(Chains)}
    columns["offsets"] = a.offsets, b.offsets[1:] + a.offsets[-1]
    return Chains(**{name: np.concatenate(both) for name, both in columns.items()})
