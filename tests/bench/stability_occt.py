"""OpenCASCADE's hidden-line removal on a disturbed model.

The polygonal algorithm is given the triangulation it reads with every node moved. The exact one has no nodes: it works
on surfaces and curves that have to agree, and a shape whose vertices were moved one by one is no shape any more. It is
disturbed by a small turn of the view instead.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from bench.scenes import compound
from bench.stability_hlr import Model, nodes, turn

from hlr.lab.rivals.opencascade import ExactAlgo, FaceMesh, PolyAlgo, face_meshes, mesh, subshapes
from support.ink import Stroke
from support.referee.reference import BREP, FINENESS, read_shape, shape_diagonal

Floats = npt.NDArray[np.float64]

ANGLE = 0.5
"""Radians: of the polygonal algorithm's mesh."""
WELD = 1e-9
"""Of the model's size: nodes of neighbouring faces this near are one, and move together."""


def shape_of(model: Model, path: Path, crease: float = 30.0) -> Any:
    """The file as OpenCASCADE reads it; a mesh becomes a polyhedron whose faces are its triangles."""
    if path.suffix.lower() in BREP:
        return read_shape(path)
    return compound([polyhedron(part.points, part.triangles, crease) for part in model.parts])


def polyhedron(points: Floats, triangles: npt.NDArray[np.int32], crease: float) -> Any:
    """A shell of planar triangles that share their edges, smooth ones where the fold is below `crease` (degrees)."""
    from OCP.BRep import BRep_Builder
    from OCP.BRepBuilderAPI import (
        BRepBuilderAPI_MakeEdge,
        BRepBuilderAPI_MakeFace,
        BRepBuilderAPI_MakeVertex,
        BRepBuilderAPI_MakeWire,
    )
    from OCP.GeomAbs import GeomAbs_C1
    from OCP.gp import gp_Pnt
    from OCP.TopoDS import TopoDS, TopoDS_Shell

    builder, shell = BRep_Builder(), TopoDS_Shell()
    builder.MakeShell(shell)
    vertices = [BRepBuilderAPI_MakeVertex(gp_Pnt(*map(float, p))).Vertex() for p in points]
    normals = np.cross(
        points[triangles[:, 1]] - points[triangles[:, 0]], points[triangles[:, 2]] - points[triangles[:, 0]]
    )
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    limit = np.cos(np.radians(crease))
    edges: dict[tuple[int, int], Any] = {}
    first: dict[tuple[int, int], tuple[int, Any]] = {}
    for number, corners in enumerate(triangles.tolist()):
        wire = BRepBuilderAPI_MakeWire()
        keys = []
        for a, b in zip(corners, corners[1:] + corners[:1], strict=True):
            key = (min(a, b), max(a, b))
            if key not in edges:
                edges[key] = BRepBuilderAPI_MakeEdge(vertices[key[0]], vertices[key[1]]).Edge()
            wire.Add(edges[key] if a < b else TopoDS.Edge_s(edges[key].Reversed()))
            keys.append(key)
        made = BRepBuilderAPI_MakeFace(wire.Wire(), True) if wire.IsDone() else None
        if made is None or not made.IsDone():
            continue
        face = made.Face()
        builder.Add(shell, face)
        for key in keys:
            other = first.setdefault(key, (number, face))
            if other[0] != number and float(normals[other[0]] @ normals[number]) > limit:
                builder.Continuity(edges[key], other[1], face, GeomAbs_C1)
    return shell


class Poly:
    """HLRBRep_PolyAlgo; each solid is a copy of its own, so that no two parts share a triangulation."""

    def __init__(self, model: Model, path: Path) -> None:
        from OCP.BRepBuilderAPI import BRepBuilderAPI_Copy

        self._model = model
        pieces = [BRepBuilderAPI_Copy(piece, True, False).Shape() for piece in _pieces(shape_of(model, path))]
        self._shape = compound(pieces)
        mesh(self._shape, model.deflection, ANGLE)
        self._faces: list[tuple[FaceMesh, npt.NDArray[np.int64]]] = []
        self._parts: list[Floats] = []
        for number, piece in enumerate(pieces):
            self._take(piece, number)

    def _take(self, piece: Any, number: int) -> None:
        """Nodes that coincide within one piece are one."""
        found = list(face_meshes(piece))
        if not found:
            self._parts.append(np.zeros((0, 3)))
            return
        places = np.concatenate([face.points for face in found])
        key = np.round(places / (WELD * self._model.size)).astype(np.int64)
        _, kept, label = np.unique(key, axis=0, return_index=True, return_inverse=True)
        self._parts.append(places[kept])
        label = label.ravel()
        start = 0
        for face in found:
            own = label[start : start + len(face.nodes)]
            start += len(face.nodes)
            self._faces.append((face, own + (number << 32)))

    def __call__(self, amount: float, seed: int) -> list[Stroke]:
        from OCP.gp import gp_Pnt

        moved = nodes(self._parts, amount * self._model.size, seed)
        for face, label in self._faces:
            part = label[0] >> 32
            which = label & 0xFFFFFFFF
            way = (moved[part] - self._parts[part])[which] @ face.placement[:, :3]
            for i, p in enumerate((face.nodes + way).tolist(), start=1):
                face.triangulation.SetNode(i, gp_Pnt(*p))
        return self._draw()

    def _draw(self) -> list[Stroke]:
        view = self._model.view
        found = PolyAlgo(self._shape, view.direction, view.right).drawn()
        return [(visible, points * self._model.per_model) for _, visible, points in found]


class Exact:
    """HLRBRep_Algo; the view is turned the other way round, and its lines are laid back before the first camera."""

    def __init__(self, model: Model, path: Path) -> None:
        self._model, self._shape = model, shape_of(model, path)
        self._chord = shape_diagonal(self._shape) / FINENESS

    def __call__(self, amount: float, seed: int) -> list[Stroke]:
        model = self._model
        rotation = turn(amount * model.size, model.size, seed)
        axes = model.view.direction, model.view.right
        turned = (np.array(axis) @ rotation if amount else np.array(axis) for axis in axes)
        found = ExactAlgo(self._shape, *turned).drawn(self._chord)
        flat = np.stack([model.view.right, model.view.up], axis=1) * model.per_model
        return [(visible, ((points - model.centre) @ rotation.T + model.centre) @ flat) for _, visible, points in found]


def _pieces(shape: Any) -> Iterator[Any]:
    """Solids, and together what is in none."""
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    yield from subshapes(shape, Kind.TopAbs_SOLID)
    yield from subshapes(shape, Kind.TopAbs_SHELL, Kind.TopAbs_SOLID)
    yield from subshapes(shape, Kind.TopAbs_FACE, Kind.TopAbs_SHELL)
