"""Faces that the kernel cannot mesh: OpenCASCADE's mesher tries them, on a copy with a mended outline.

Most of them have sound curves and surfaces, but the curves of their edges in (u, v) do not make a closed outline: one
lies a whole period beside the others, or is not the edge's at all. What is tried, the cheap first:

1. the copy as it is;
2. the same curves in (u, v), each moved by whole periods to where the one before it ends;
3. curves in (u, v) found anew, from the edges in space;
4. OpenCASCADE's own repair of a face.

A copy counts only where the kernel finds that its triangles fill the face's outline and have its area. They are then
joined to the edges' polylines, which stay as they are: so do the neighbours. Nothing of the caller's shape is touched.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import Any

import numpy as np

from hlr import _kernel
from hlr.common.types import Floats, Ints
from hlr.source.cad.pcurves import close_loops, project_pcurves
from hlr.source.cad.shapes import sub_shapes

Copied = tuple[Any, Callable[[Any], Any]]
"""A face, and which edge of it stands for an edge of the original."""

Border = tuple[list[int], list[float]]
"""Nodes on an edge and their parameters, in the sense of the edge."""


def rescue(meshed: _kernel.BrepMesh, number: int, face: Any, deflection: float, angle: float) -> bool:
    """Give the face with this number, a TopoDS_Face, triangles of OpenCASCADE's; whether any fit."""
    from OCP.TopAbs import TopAbs_Orientation
    from OCP.TopLoc import TopLoc_Location
    from OCP.TopoDS import TopoDS

    here = TopoDS.Face(face.Located(TopLoc_Location(), False).Oriented(TopAbs_Orientation.TopAbs_FORWARD))
    for copied in _copies(here):
        with suppress(Exception):  # OpenCASCADE's exceptions derive from Exception alone; the next way is tried
            copy, counterpart = copied()
            run_mesher(copy, deflection, angle)
            points, uv, triangles = _triangles(copy)
            borders = _borders(here, copy, counterpart, triangles)
            if meshed.replace(number, points, uv, triangles, borders):
                return True
    return False


def run_mesher(face: Any, deflection: float, angle: float) -> None:
    """OpenCASCADE's mesher, by its older algorithm: the newer one may crash, or run on for ever.

    deflection: chord error, model units; angle: turning per chord, radians.
    """
    from OCP.BRepMesh import BRepMesh_IncrementalMesh
    from OCP.IMeshTools import IMeshTools_MeshAlgoType, IMeshTools_Parameters

    parameters = IMeshTools_Parameters()
    parameters.MeshAlgo = IMeshTools_MeshAlgoType.IMeshTools_MeshAlgoType_Watson
    parameters.Deflection = deflection
    parameters.Angle = angle
    BRepMesh_IncrementalMesh(face, parameters)


def _copies(face: Any) -> Iterator[Callable[[], Copied]]:
    def as_it_is() -> Copied:
        from OCP.BRepBuilderAPI import BRepBuilderAPI_Copy
        from OCP.TopoDS import TopoDS

        copier = BRepBuilderAPI_Copy(face, True, False)
        return TopoDS.Face(copier.Shape()), copier.ModifiedShape

    def same_curves() -> Copied:
        copy, counterpart = as_it_is()
        close_loops(copy)
        return copy, counterpart

    def new_curves() -> Copied:
        copy, counterpart = as_it_is()
        project_pcurves(copy)
        close_loops(copy)
        return copy, counterpart

    def repaired() -> Copied:
        from OCP.ShapeFix import ShapeFix_Face
        from OCP.TopoDS import TopoDS

        copy, counterpart = as_it_is()
        fixer = ShapeFix_Face(copy)
        fixer.Perform()
        context = fixer.Context()
        return TopoDS.Face(fixer.Result()), lambda edge: context.Apply(counterpart(edge))

    yield as_it_is
    yield same_curves
    yield new_curves
    yield repaired


def _triangles(face: Any) -> tuple[Floats, Floats, Ints]:
    """Points, parameters and triangles of a meshed TopoDS_Face."""
    from OCP.BRep import BRep_Tool
    from OCP.TopLoc import TopLoc_Location

    triangulation = BRep_Tool.Triangulation_s(face, TopLoc_Location())
    numbers = range(1, triangulation.NbNodes() + 1)
    points = np.array([triangulation.Node(i).Coord() for i in numbers])
    uv = np.array([triangulation.UVNode(i).Coord() for i in numbers])
    triangles = [triangulation.Triangle(i).Get() for i in range(1, triangulation.NbTriangles() + 1)]
    return points, uv, np.array(triangles, np.int32) - np.int32(1)


def _borders(face: Any, copy: Any, counterpart: Callable[[Any], Any], triangles: Ints) -> list[Border]:
    """The polygon of each edge in each wire of the face on the copy's triangles.

    Raises:
        ValueError: an edge has none.
    """
    from OCP.BRep import BRep_Tool
    from OCP.TopAbs import TopAbs_Orientation
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopLoc import TopLoc_Location
    from OCP.TopoDS import TopoDS, TopoDS_Iterator

    place = TopLoc_Location()
    triangulation = BRep_Tool.Triangulation_s(copy, place)
    sides = {(t[k], t[k - 2]) for t in triangles.tolist() for k in range(3)}
    found: list[Border] = []
    for wire in _children(face, Kind.TopAbs_WIRE, TopoDS_Iterator):
        for shape in _children(wire, Kind.TopAbs_EDGE, TopoDS_Iterator):
            twin, backward = counterpart(shape), shape.Orientation() == TopAbs_Orientation.TopAbs_REVERSED
            ways = (TopAbs_Orientation.TopAbs_FORWARD, TopAbs_Orientation.TopAbs_REVERSED)
            both = [
                BRep_Tool.PolygonOnTriangulation_s(TopoDS.Edge(twin.Oriented(w)), triangulation, place) for w in ways
            ]
            # A seam has two; the one with triangles to its left is meant.
            borders = [_border(polygon) for polygon in both if polygon is not None and polygon.HasParameters()]
            if not borders:
                raise ValueError("an edge without a polygon")
            fits = [b for b in borders if (b[0][1], b[0][0]) in sides] if backward else []
            fits = fits or [b for b in borders if not backward and (b[0][0], b[0][1]) in sides]
            found.append((fits or borders)[0])
    return found


def _border(polygon: Any) -> Border:
    numbers = range(1, polygon.NbNodes() + 1)
    return [polygon.Node(i) - 1 for i in numbers], [polygon.Parameter(i) for i in numbers]


def _children(shape: Any, kind: Any, iterator: Any) -> Iterator[Any]:
    """Sub-shapes of a kind in the order in which they are kept."""
    at = iterator(shape)
    while at.More():
        if at.Value().ShapeType() == kind:
            yield at.Value()
        at.Next()


def faces_of(roots: list[Any], numbers: set[int]) -> dict[int, Any]:
    """The underlying faces with these numbers, as TopoDS_Face: counted as an explorer of the roots meets them."""
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopoDS import TopoDS

    known: set[Any] = set()
    found = {}
    for root in roots if numbers else ():
        for shape in sub_shapes(root, Kind.TopAbs_FACE):
            underlying = shape.TShape()
            if underlying not in known:
                if len(known) in numbers:
                    found[len(known)] = TopoDS.Face(shape)
                known.add(underlying)
    return found
