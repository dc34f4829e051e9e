"""The tree of every part, expanded into faces, edges and their uses, for all parts at once.

The order is that of TopExp::MapShapes, so that an index in our records is an index in a part's face or edge map.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hlr.source import tables as t
from hlr.source.model import Ints
from hlr.source.tables import Bools, Bytes, Tables, ranges


@dataclass(slots=True)
class Topology:
    """Faces and edges of all parts; `face_part` and `edge_part` ascend, so each part is one slice.

    use_edge, use_face: which edge (record) stands in a wire of which face (record), each use once per wire entry.
    """

    face_part: Ints
    face_shape: Ints
    face_loc: Ints
    face_reversed: Bools
    edge_part: Ints
    edge_shape: Ints
    edge_loc: Ints
    use_edge: Ints
    use_face: Ints
    use_orient: Bytes


@dataclass(slots=True)
class Items:
    """A list of sub-shapes in the order a TopExp_Explorer meets them."""

    part: Ints
    shape: Ints
    loc: Ints
    orient: Bytes
    face: Ints

    def only(self, keep: Bools) -> Items:
        """The items where `keep` is true."""
        return Items(self.part[keep], self.shape[keep], self.loc[keep], self.orient[keep], self.face[keep])


def roots(tables: Tables) -> Items:
    """The parts: children of the root compound after the first, which only carries normals."""
    first, last = tables.sub_start[-2] + 1, tables.sub_start[-1]
    count = int(last - first)
    return Items(
        part=np.arange(count, dtype=np.int32),
        shape=tables.sub_shape[first:last].copy(),
        loc=tables.sub_loc[first:last].copy(),
        orient=tables.sub_orient[first:last].copy(),
        face=np.full(count, -1, dtype=np.int32),
    )


def _expand(tables: Tables, items: Items, expandable: Bools) -> Items:
    """Replace the expandable items by their children, in place, until none is left."""
    while True:
        open_ = expandable[tables.kind[items.shape]]
        if not open_.any():
            return items
        begin = tables.sub_start[items.shape]
        counts = np.where(open_, tables.sub_start[items.shape + 1] - begin, 1)
        parent = np.repeat(np.arange(len(counts)), counts)
        child = ranges(np.where(open_, begin, 0), counts)
        inside = open_[parent]
        kid = child[inside]
        up = parent[inside]
        result = Items(
            items.part[parent], items.shape[parent], items.loc[parent], items.orient[parent], items.face[parent]
        )
        result.shape[inside] = tables.sub_shape[kid]
        result.loc[inside] = tables.locations.products(items.loc[up], tables.sub_loc[kid])
        result.orient[inside] = _composed(items.orient[up], tables.sub_orient[kid])
        items = result


def _composed(outer: Bytes, inner: Bytes) -> Bytes:
    """TopAbs::Compose: an internal or external shape stays so, a reversed parent turns the child round."""
    return np.where(outer >= t.INTERNAL, outer, np.where(inner >= t.INTERNAL, inner, inner ^ outer)).astype(np.uint8)


def first_of(part: Ints, shape: Ints, loc: Ints) -> tuple[Ints, Ints]:
    """(indices of first occurrences, in order; for each item the rank of its first occurrence)."""
    order = np.lexsort((np.arange(len(part)), loc, shape, part))
    same = np.zeros(len(part), dtype=bool)
    a, b = order[1:], order[:-1]
    same[1:] = (part[a] == part[b]) & (shape[a] == shape[b]) & (loc[a] == loc[b])
    group = np.cumsum(~same) - 1
    leader = order[~same]
    rank_of_leader = np.empty(len(leader), dtype=np.int32)
    by_position = np.argsort(leader, kind="stable")
    rank_of_leader[by_position] = np.arange(len(leader), dtype=np.int32)
    rank = np.empty(len(part), dtype=np.int32)
    rank[order] = rank_of_leader[group]
    return leader[by_position].astype(np.int32), rank


def explore(tables: Tables) -> Topology:
    """Step 1."""
    kinds = np.arange(8)
    items = _expand(tables, roots(tables), (kinds < t.FACE) | (kinds == t.WIRE))
    items = items.only(tables.kind[items.shape] != t.VERTEX)
    is_face = tables.kind[items.shape] == t.FACE
    faces = items.only(is_face)
    first, rank = first_of(faces.part, faces.shape, faces.loc)
    items.face[is_face] = rank
    uses = _expand(tables, items, (kinds == t.FACE) | (kinds == t.WIRE))
    uses = uses.only(tables.kind[uses.shape] == t.EDGE)
    edge_first, edge_rank = first_of(uses.part, uses.shape, uses.loc)
    in_face = uses.face >= 0
    return Topology(
        face_part=faces.part[first],
        face_shape=faces.shape[first],
        face_loc=faces.loc[first],
        face_reversed=faces.orient[first] == t.REVERSED,
        edge_part=uses.part[edge_first],
        edge_shape=uses.shape[edge_first],
        edge_loc=uses.loc[edge_first],
        use_edge=edge_rank[in_face],
        use_face=uses.face[in_face],
        use_orient=uses.orient[in_face],
    )
