"""The mesh that a shape carries, as arrays: the same triangles that OpenCASCADE's polygonal algorithm reads."""

from __future__ import annotations

from typing import Any

import numpy as np

from hlr.lab.rivals.opencascade import FaceMesh, face_meshes, subshapes

WELD = 1e-7
"""Nodes of neighbouring faces this near are one; OpenCASCADE copies them from the edge they share."""


class Triangulation:
    """Welded triangles.

    points         (n, 3) float64, in the order in which the faces have them
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
        from OCP.TopAbs import TopAbs_ShapeEnum as Kind

        solids = list(subshapes(shape, Kind.TopAbs_SOLID)) or [shape]
        self.parts = len(solids)
        for part, solid in enumerate(solids):
            for mesh in face_meshes(solid):
                self._take(mesh, part)
        points = np.concatenate(self._points)
        _, first, place = np.unique(
            np.round(points / WELD).astype(np.int64), axis=0, return_index=True, return_inverse=True
        )
        # In the order of the faces, as a mesh of hlr or of a file has them; `unique` would scatter those of one part.
        number = np.argsort(np.argsort(first))[place.ravel()]
        self.points = points[np.sort(first)]
        triangles = number[np.concatenate(self._triangles)]
        whole = (triangles != np.roll(triangles, 1, axis=1)).all(axis=1)
        self.triangles = np.ascontiguousarray(triangles[whole], dtype=np.int32)
        self.triangle_part = np.concatenate(self._parts)[whole]
        # Shapes without edges to draw, such as tori, have none.
        ends = np.concatenate([np.zeros((0, 2), np.int64), *self._segments])
        segments = np.sort(number[ends], axis=1).astype(np.int64)
        self.drawn = np.unique(segments[:, 0] * len(self.points) + segments[:, 1])

    def _take(self, mesh: FaceMesh, part: int) -> None:
        from OCP.BRep import BRep_Tool
        from OCP.TopAbs import TopAbs_ShapeEnum as Kind
        from OCP.TopoDS import TopoDS

        self._points.append(mesh.points)
        self._triangles.append(mesh.triangles + self._count)
        self._parts.append(np.full(len(mesh.triangles), part, dtype=np.int32))
        for each in subshapes(mesh.face, Kind.TopAbs_EDGE):
            edge = TopoDS.Edge(each)
            if BRep_Tool.IsClosed_s(edge, mesh.face) or BRep_Tool.Degenerated_s(edge):
                continue
            line = BRep_Tool.PolygonOnTriangulation_s(edge, mesh.triangulation, mesh.location)
            if line is not None:
                along = np.array([line.Node(i) for i in range(1, line.NbNodes() + 1)]) - 1 + self._count
                self._segments.append(np.stack([along[:-1], along[1:]], axis=1))
        self._count += len(mesh.nodes)
