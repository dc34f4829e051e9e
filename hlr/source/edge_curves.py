"""The curves of a B-rep source's edges, read when they are asked for and kept."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from hlr.source.geometry import UNKNOWN, Record, edge_record, packed
from hlr.source.model import EdgeCurves, Floats, Ints


class EdgeCurveReader:
    """Records of the edges of roots (shapes without placement), each read once."""

    def __init__(self, roots: Sequence[Any]) -> None:
        self._roots = roots
        self._edges: dict[int, list[Any]] = {}
        self._records: dict[tuple[int, int], Record] = {}

    def read(self, roots: Ints, edges: Ints, place: Ints, places: Floats) -> EdgeCurves:
        """Curves of edges (m,) in the TopExp edge maps of roots (m,), moved by places (p, 3, 4) numbered place (m,)."""
        keys = np.stack([roots, edges], axis=1)
        distinct, which = np.unique(keys, axis=0, return_inverse=True)
        records = [self._record(root, edge) for root, edge in distinct.tolist()]
        return EdgeCurves(packed(records), which.ravel().astype(np.int32), place, places)

    def _record(self, root: int, edge: int) -> Record:
        known = self._records.get((root, edge))
        if known is None:
            known = self._records[root, edge] = self._read(root, edge)
        return known

    def _read(self, root: int, edge: int) -> Record:
        from OCP.TopAbs import TopAbs_ShapeEnum
        from OCP.TopoDS import TopoDS

        from hlr.source.parts import explored

        edges = self._edges.get(root)
        if edges is None:
            edges = self._edges[root] = explored(self._roots[root], TopAbs_ShapeEnum.TopAbs_EDGE)
        if edge >= len(edges):
            return UNKNOWN
        return edge_record(TopoDS.Edge(edges[edge]))
