"""Edges of free-form faces as OpenCASCADE knows them: what is compared along them, and nodes where that changes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Set
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from hlr.source.bindings import collection
from hlr.source.geometry import UNKNOWN, Record, curve_record
from hlr.source.parts import explored, matrix
from hlr.source.surfaces import FaceSurfaces
from hlr.source.tables import G1
from hlr.source.tangency import FreeEdge, Side, Tangency, tangencies

_SIMPLE = {
    "Geom_Plane",
    "Geom_CylindricalSurface",
    "Geom_ConicalSurface",
    "Geom_SphericalSurface",
    "Geom_ToroidalSurface",
}
"""Surfaces that cannot turn to and fro between the nodes of an edge."""


def is_free(face: Any) -> bool:
    """Whether the surface under a TopoDS_Face is none of the elementary ones."""
    from OCP.BRep import BRep_Tool
    from OCP.TopLoc import TopLoc_Location

    surface = BRep_Tool.Surface_s(face, TopLoc_Location())
    while type(surface).__name__ == "Geom_RectangularTrimmedSurface":
        surface = surface.BasisSurface()
    return surface is not None and type(surface).__name__ not in _SIMPLE


@dataclass(frozen=True, slots=True)
class FreeEdges:
    """How faces meet at the edges of free-form faces.

    found    by root and index in its TopExp edge map
    uneven   TopoDS_Edges at which that changes, and the parameters where
    """

    found: dict[tuple[int, int], Tangency]
    uneven: list[tuple[Any, list[float]]]

    @staticmethod
    def compared(
        roots: Sequence[Any], number: Mapping[Any, int], free: Sequence[bool], surfaces: FaceSurfaces
    ) -> FreeEdges:
        """number: of every underlying face; free: whether it is free-form, by that number."""
        keys: list[tuple[int, int]] = []
        shapes: list[Any] = []
        edges: list[FreeEdge] = []
        some = {face for face, n in number.items() if free[n]}
        for i, root in enumerate(roots if some else ()):
            for index, shape, edge in _edges(root, number, some):
                keys.append((i, index))
                shapes.append(shape)
                edges.append(edge)
        found = {}
        uneven = []
        for key, shape, tangency in zip(keys, shapes, tangencies(edges, surfaces), strict=True):
            if tangency is not None:
                found[key] = tangency
                if len(tangency.parameters):
                    uneven.append((shape, tangency.parameters.tolist()))
        return FreeEdges(found, uneven)


def _edges(root: Any, number: Mapping[Any, int], free: Set[Any]) -> Iterator[tuple[int, Any, FreeEdge]]:
    """Index in the root's TopExp edge map, and TopoDS_Edge, of those between two faces of which one is free-form."""
    from OCP.BRep import BRep_Tool
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopExp import TopExp
    from OCP.TopoDS import TopoDS

    if not any(face.TShape() in free for face in explored(root, Kind.TopAbs_FACE)):
        return
    around, order = collection("ancestor_map"), collection("shape_map")
    TopExp.MapShapesAndAncestors_s(root, Kind.TopAbs_EDGE, Kind.TopAbs_FACE, around)
    TopExp.MapShapes_s(root, Kind.TopAbs_EDGE, order)
    for i in range(1, around.Extent() + 1):
        beside = around.FindFromIndex(i)
        if beside.Extent() != 2:
            continue
        faces = [TopoDS.Face(face) for face in (beside.First(), beside.Last())]
        if faces[0].IsSame(faces[1]) or not any(face.TShape() in free for face in faces):
            continue
        edge = TopoDS.Edge(around.FindKey(i))
        if BRep_Tool.Degenerated_s(edge):
            continue
        one, other = (_side(edge, face, number[face.TShape()]) for face in faces)
        recorded = BRep_Tool.HasContinuity_s(edge) and int(BRep_Tool.MaxContinuity_s(edge)) >= G1
        yield order.FindIndex(edge) - 1, edge, FreeEdge((one, other), _range(edge), recorded)


def _range(edge: Any) -> tuple[float, float]:
    from OCP.BRepAdaptor import BRepAdaptor_Curve

    curve = BRepAdaptor_Curve(edge)
    return curve.FirstParameter(), curve.LastParameter()


def _side(edge: Any, face: Any, number: int) -> Side:
    from OCP.TopAbs import TopAbs_Orientation

    sign = -1.0 if face.Orientation() == TopAbs_Orientation.TopAbs_REVERSED else 1.0
    return Side(_in_parameters(edge, face), number, matrix(face.Location()), sign)


def _in_parameters(edge: Any, face: Any) -> Record:
    """The edge's curve in the face's (u, v), as one in space with z = 0."""
    from OCP.BRepAdaptor import BRepAdaptor_Curve2d
    from OCP.GeomLib import GeomLib
    from OCP.gp import gp_Ax2

    try:
        curve = BRepAdaptor_Curve2d(edge, face)
        return curve_record(GeomLib.To3d_s(gp_Ax2(), curve.Curve()), curve.FirstParameter(), curve.LastParameter())
    except Exception:  # OpenCASCADE's exceptions derive from Exception alone: such an edge is judged by its nodes
        return UNKNOWN


@contextmanager
def with_nodes(wanted: Sequence[tuple[Any, Sequence[float]]]) -> Iterator[None]:
    """The mesher puts nodes at these parameters of these edges, for as long as this lasts.

    It does where an edge has vertices inside, which are taken out again: the shapes may be a caller's.
    """
    from OCP.BRep import BRep_Builder
    from OCP.BRepAdaptor import BRepAdaptor_Curve
    from OCP.Precision import Precision
    from OCP.TopAbs import TopAbs_Orientation
    from OCP.TopLoc import TopLoc_Location
    from OCP.TopoDS import TopoDS, TopoDS_Vertex

    builder = BRep_Builder()
    added = []
    try:
        for edge, parameters in wanted:
            bare = TopoDS.Edge(edge.Located(TopLoc_Location(), False).Oriented(TopAbs_Orientation.TopAbs_FORWARD))
            curve, frozen = BRepAdaptor_Curve(bare), not bare.Free()
            bare.Free(True)
            for parameter in parameters:
                vertex = TopoDS_Vertex()
                builder.MakeVertex(vertex, curve.Value(parameter), Precision.Confusion_s())
                inner = TopoDS.Vertex(vertex.Oriented(TopAbs_Orientation.TopAbs_INTERNAL))
                builder.Add(bare, inner)
                builder.UpdateVertex(inner, parameter, bare, Precision.Confusion_s())
                added.append((bare, inner))
            bare.Free(not frozen)
        yield
    finally:
        for bare, inner in added:
            frozen = not bare.Free()
            bare.Free(True)
            builder.Remove(bare, inner)
            bare.Free(not frozen)
