"""Faces that the kernel cannot mesh are meshed by OpenCASCADE, on a copy with repaired pcurves.

Most of them have sound curves and surfaces, but their pcurves (curves of the edges in (u, v)) make no closed loop: one
is off by a whole period, or belongs to another edge. These repairs are tried in turn, the cheapest first:

1. none: the copy as it is;
2. the same pcurves, each moved by whole periods to the end of the one before it;
3. pcurves computed anew from the edges' 3-D curves;
4. OpenCASCADE's own repair of a face.

The kernel accepts the triangles only where they fill the face's loops and have its area. It then joins them to the
edges' polylines, which do not change, so neither do the neighbouring faces. The caller's shape is not touched.

OpenCASCADE's mesher cannot be interrupted, and its time grows faster than its triangles. So both its chord error and
its triangles have a smallest size, a share of the face's, with which a face takes it a few seconds at most.
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
"""A copied face, and the function from an edge of the original to its copy."""

SMALLEST_DEFLECTION = 1 / 20_000
"""Of the size of a face: a ball has some 60,000 triangles then."""

SMALLEST_SIDE = 1 / 500
"""Of the size of a face: of OpenCASCADE's triangles on splines. It comes into play where they have folds or spikes."""

Border = tuple[list[int], list[float]]
"""Nodes on an edge and their parameters, in the direction of the edge."""


def rescue(meshed: _kernel.BrepMesh, number: int, face: Any, deflection: float, angle: float) -> bool:
    """Replace the mesh of a face by triangles of OpenCASCADE's mesher; whether any were accepted.

    number: of the face in `meshed`; face: the TopoDS_Face; deflection: model units; angle: turning per chord, radians.
    """
    from OCP.TopAbs import TopAbs_Orientation
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopLoc import TopLoc_Location
    from OCP.TopoDS import TopoDS, TopoDS_Iterator

    if not any(True for _ in _children(face, Kind.TopAbs_WIRE, TopoDS_Iterator)):
        return False  # without loops nothing tells whether the triangles fill it
    unplaced = TopoDS.Face(face.Located(TopLoc_Location(), False).Oriented(TopAbs_Orientation.TopAbs_FORWARD))
    for repair in _repairs(unplaced):
        with suppress(Exception):  # OpenCASCADE's exceptions derive from Exception alone; the next repair is tried
            copy, counterpart = repair()
            run_mesher(copy, deflection, angle)
            points, uv, triangles = _triangles(copy)
            borders = _borders(unplaced, copy, counterpart, triangles)
            if meshed.replace(number, points, uv, triangles, borders):
                return True
    return False


def run_mesher(face: Any, deflection: float, angle: float) -> None:
    """Mesh a TopoDS_Face with OpenCASCADE's older algorithm: the newer one may crash, or never end.

    deflection: chord error, model units; angle: turning per chord, radians.
    """
    from OCP.BRepMesh import BRepMesh_IncrementalMesh
    from OCP.IMeshTools import IMeshTools_MeshAlgoType, IMeshTools_Parameters

    parameters = IMeshTools_Parameters()
    parameters.MeshAlgo = IMeshTools_MeshAlgoType.IMeshTools_MeshAlgoType_Watson
    parameters.Deflection = deflection
    parameters.Angle = angle
    parameters.MinSize = SMALLEST_SIDE * _size(face)
    BRepMesh_IncrementalMesh(face, parameters)


def smallest_deflection(face: Any) -> float:
    """The smallest chord error to ask OpenCASCADE's mesher for, model units. face: a TopoDS_Face."""
    return SMALLEST_DEFLECTION * _size(face)


def _size(face: Any) -> float:
    """The diagonal of a box around the edges of a face, model units: a box of its (u, v) may be as wrong as these."""
    from OCP.Bnd import Bnd_Box
    from OCP.BRepBndLib import BRepBndLib
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    box = Bnd_Box()
    for edge in sub_shapes(face, Kind.TopAbs_EDGE):
        BRepBndLib.Add_s(edge, box, False)
    return 0.0 if box.IsVoid() else float(box.SquareExtent()) ** 0.5


def _repairs(face: Any) -> Iterator[Callable[[], Copied]]:
    """The repairs, the cheapest first, each as a function that copies the face."""

    def unchanged() -> Copied:
        from OCP.BRepBuilderAPI import BRepBuilderAPI_Copy
        from OCP.TopoDS import TopoDS

        copier = BRepBuilderAPI_Copy(face, True, False)
        return TopoDS.Face(copier.Shape()), copier.ModifiedShape

    def shifted_pcurves() -> Copied:
        copy, counterpart = unchanged()
        close_loops(copy)
        return copy, counterpart

    def projected_pcurves() -> Copied:
        copy, counterpart = unchanged()
        project_pcurves(copy)
        close_loops(copy)
        return copy, counterpart

    def fixed_by_opencascade() -> Copied:
        from OCP.ShapeFix import ShapeFix_Face
        from OCP.TopoDS import TopoDS

        copy, counterpart = unchanged()
        fixer = ShapeFix_Face(copy)
        fixer.Perform()
        context = fixer.Context()
        return TopoDS.Face(fixer.Result()), lambda edge: context.Apply(counterpart(edge))

    yield unchanged
    yield shifted_pcurves
    yield projected_pcurves
    yield fixed_by_opencascade


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
            copied_edge, backward = counterpart(shape), shape.Orientation() == TopAbs_Orientation.TopAbs_REVERSED
            orientations = (TopAbs_Orientation.TopAbs_FORWARD, TopAbs_Orientation.TopAbs_REVERSED)
            polygons = [
                BRep_Tool.PolygonOnTriangulation_s(TopoDS.Edge(copied_edge.Oriented(w)), triangulation, place)
                for w in orientations
            ]
            # A seam edge has two polygons: take the one with triangles to its left.
            borders = [_border(polygon) for polygon in polygons if polygon is not None and polygon.HasParameters()]
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
    """Direct sub-shapes of a kind, in stored order."""
    at = iterator(shape)
    while at.More():
        if at.Value().ShapeType() == kind:
            yield at.Value()
        at.Next()


def faces_of(shapes: list[Any], numbers: set[int]) -> dict[int, Any]:
    """The underlying faces with these numbers, as TopoDS_Face, numbered in the order of an explorer of the shapes."""
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopoDS import TopoDS

    known: set[Any] = set()
    found = {}
    for prototype in shapes if numbers else ():
        for shape in sub_shapes(prototype, Kind.TopAbs_FACE):
            underlying = shape.TShape()
            if underlying not in known:
                if len(known) in numbers:
                    found[len(known)] = TopoDS.Face(shape)
                known.add(underlying)
    return found


def face_in_part(shape: Any, index: int) -> Any:
    """The face with this index in the TopExp face map of a shape, as a TopoDS_Face in the frame of the shape."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_Transform
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopExp import TopExp
    from OCP.TopLoc import TopLoc_Location
    from OCP.TopoDS import TopoDS

    from hlr.source.cad.occt_collections import new_collection

    faces = new_collection("shape_map")
    TopExp.MapShapes_s(shape, Kind.TopAbs_FACE, faces)
    face = faces.FindKey(index + 1)
    if not face.Location().IsIdentity():
        move = face.Location().Transformation()
        face = BRepBuilderAPI_Transform(face.Located(TopLoc_Location(), False), move, True).Shape()
    return TopoDS.Face(face)
