"""The triangulation that a shape carries, as arrays: exactly what OpenCASCADE's polygonal algorithm works on."""

from __future__ import annotations

from typing import Any

import numpy as np

WELD = 1e-7
"""Nodes of neighbouring faces this near are one; OpenCASCADE copies them from the edge they share."""


class Triangulation:
    """Welded triangles.

    points         (n, 3) float64
    triangles      (m, 3) int32
    triangle_part  (m,)   int32, one part per solid
    drawn          sorted keys lo * n + hi of the mesh edges that lie on B-rep edges, seams excepted
    """

    def __init__(self, shape: Any) -> None:
        self._points: list[np.ndarray] = []
        self._triangles: list[np.ndarray] = []
        self._segments: list[np.ndarray] = []
        self._parts: list[np.ndarray] = []
        self._count = 0
        solids = list(_inside(shape, "SOLID")) or [shape]
        self.parts = len(solids)
        for part, solid in enumerate(solids):
            for face in _inside(solid, "FACE"):
                self._take(face, part)
        points = np.concatenate(self._points)
        _, first, number = np.unique(
            np.round(points / WELD).astype(np.int64), axis=0, return_index=True, return_inverse=True
        )
        self.points = points[first]
        triangles = number.ravel()[np.concatenate(self._triangles)]
        whole = (triangles != np.roll(triangles, 1, axis=1)).all(axis=1)
        self.triangles = np.ascontiguousarray(triangles[whole], dtype=np.int32)
        self.triangle_part = np.concatenate(self._parts)[whole]
        # Of shapes without edges, such as tori, none.
        ends = np.concatenate([np.zeros((0, 2), np.int64), *self._segments])
        segments = np.sort(number.ravel()[ends], axis=1).astype(np.int64)
        self.drawn = np.unique(segments[:, 0] * len(self.points) + segments[:, 1])

    def _take(self, face: Any, part: int) -> None:
        from OCP.BRep import BRep_Tool
        from OCP.TopAbs import TopAbs_REVERSED
        from OCP.TopLoc import TopLoc_Location
        from OCP.TopoDS import TopoDS

        face = TopoDS.Face_s(face)
        place = TopLoc_Location()
        mesh = BRep_Tool.Triangulation_s(face, place)
        if mesh is None:
            return
        move = place.Transformation()
        matrix = np.array([[move.Value(row, column) for column in range(1, 5)] for row in range(1, 4)])
        nodes = np.array([mesh.Node(i).Coord() for i in range(1, mesh.NbNodes() + 1)])
        corners = np.array([mesh.Triangle(i).Get() for i in range(1, mesh.NbTriangles() + 1)]) - 1
        if face.Orientation() == TopAbs_REVERSED:
            corners = corners[:, ::-1]
        self._points.append(nodes @ matrix[:, :3].T + matrix[:, 3])
        self._triangles.append(corners + self._count)
        self._parts.append(np.full(len(corners), part, dtype=np.int32))
        for each in _inside(face, "EDGE"):
            edge = TopoDS.Edge_s(each)
            if BRep_Tool.IsClosed_s(edge, face) or BRep_Tool.Degenerated_s(edge):
                continue
            line = BRep_Tool.PolygonOnTriangulation_s(edge, mesh, place)
            if line is not None:
                along = np.array([line.Node(i) for i in range(1, line.NbNodes() + 1)]) - 1 + self._count
                self._segments.append(np.stack([along[:-1], along[1:]], axis=1))
        self._count += len(nodes)


def _inside(shape: Any, kind: str) -> Any:
    from OCP import TopAbs
    from OCP.TopExp import TopExp_Explorer

    explorer = TopExp_Explorer(shape, getattr(TopAbs, f"TopAbs_{kind}"))
    while explorer.More():
        yield explorer.Current()
        explorer.Next()
