"""Read a meshed B-rep item by item through the bindings: slow, and independent of any file layout.

It delivers the same tables as `hlr.source.dump`, which is used instead wherever the dump's layout is the known one;
each is the other's test.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from hlr.source.locations import Chain, Locations
from hlr.source.model import Floats
from hlr.source.parts import explored, matrix
from hlr.source.tables import EDGE, FACE, Tables, starts


def walk(compound: Any) -> Tables:
    """Tables of a meshed TopoDS_Compound: normal carriers first, then the roots."""
    walker = _Walker()
    walker.visit(compound)
    return walker.tables()


class _Walker:
    """Numbers underlying shapes, triangulations and locations as it meets them."""

    def __init__(self) -> None:
        self.numbers: dict[Any, int] = {}
        self.shapes: list[Any] = []
        self.subs: list[list[tuple[int, int, int]]] = []
        self.tris: dict[Any, int] = {}
        self.face_tri: dict[int, int] = {}
        self.polygons: list[list[int]] = []
        self.reps: dict[tuple[int, int, int], tuple[int, int]] = {}
        self.lines: list[list[tuple[float, float, float]]] = []
        self.free: list[tuple[int, int, int]] = []
        self.datums: dict[Any, int] = {}
        self.chains: dict[Chain, int] = {(): 0}

    def visit(self, shape: Any) -> int:
        """Number a shape and all it consists of, children first."""
        from OCP.TopLoc import TopLoc_Location
        from OCP.TopoDS import TopoDS_Iterator

        key = shape.TShape()
        known = self.numbers.get(key)
        if known is not None:
            return known
        bare = shape.Located(TopLoc_Location(), False)
        children = []
        iterator = TopoDS_Iterator(bare, False, False)
        while iterator.More():
            child = iterator.Value()
            children.append((child, int(child.Orientation()), self.location(child.Location())))
            iterator.Next()
        subs = [(self.visit(child), orient, loc) for child, orient, loc in children]
        number = self.numbers[key] = len(self.shapes)
        self.shapes.append(bare)
        self.subs.append(subs)
        kind = int(bare.ShapeType())
        if kind == FACE:
            self.face(bare, number)
        elif kind == EDGE:
            self.edge(bare, number)
        return number

    def location(self, location: Any) -> int:
        chain: list[tuple[int, int]] = []
        while not location.IsIdentity():
            datum = location.FirstDatum()
            chain.insert(0, (self.datums.setdefault(datum, len(self.datums)), location.FirstPower()))
            location = location.NextLocation()
        return self.chains.setdefault(tuple(chain), len(self.chains))

    def face(self, face: Any, number: int) -> None:
        """Its triangulation, and the polygons of its edges on it."""
        from OCP.BRep import BRep_Tool
        from OCP.TopAbs import TopAbs_Orientation, TopAbs_ShapeEnum
        from OCP.TopLoc import TopLoc_Location
        from OCP.TopoDS import TopoDS

        place = TopLoc_Location()
        triangulation = BRep_Tool.Triangulation_s(TopoDS.Face(face), place)
        if triangulation is None:
            return
        tri = self.face_tri[number] = self.tris.setdefault(triangulation, len(self.tris))
        for shape in explored(face, TopAbs_ShapeEnum.TopAbs_EDGE):
            found = []
            for orientation in (TopAbs_Orientation.TopAbs_FORWARD, TopAbs_Orientation.TopAbs_REVERSED):
                edge = TopoDS.Edge(shape.Oriented(orientation))
                polygon = BRep_Tool.PolygonOnTriangulation_s(edge, triangulation, place)
                if polygon is not None:
                    found.append([polygon.Node(i) - 1 for i in range(1, polygon.NbNodes() + 1)])
            if found:
                key = (self.visit(shape), tri, self.location(shape.Location().Inverted()))
                if key not in self.reps:
                    closed = BRep_Tool.IsClosed_s(TopoDS.Edge(shape), triangulation, place)
                    first = self._polygon(found[0])
                    self.reps[key] = (first, self._polygon(found[-1]) if closed else -1)

    def _polygon(self, nodes: list[int]) -> int:
        self.polygons.append(nodes)
        return len(self.polygons) - 1

    def edge(self, edge: Any, number: int) -> None:
        """Its polygon in space, if it has one."""
        from OCP.BRep import BRep_Tool
        from OCP.TopLoc import TopLoc_Location
        from OCP.TopoDS import TopoDS

        place = TopLoc_Location()
        polygon = BRep_Tool.Polygon3D_s(TopoDS.Edge(edge), place)
        if polygon is None:
            return
        nodes = polygon.Nodes()
        points = [nodes.Value(i) for i in range(nodes.Lower(), nodes.Upper() + 1)]
        self.free.append((number, self.location(place), len(self.lines)))
        self.lines.append([(point.X(), point.Y(), point.Z()) for point in points])

    def tables(self) -> Tables:
        from OCP.BRep import BRep_Tool
        from OCP.TopoDS import TopoDS

        kind = np.array([int(shape.ShapeType()) for shape in self.shapes], dtype=np.uint8)
        degenerated = np.zeros(len(kind), dtype=bool)
        smooth = np.full(len(kind), -1, dtype=np.int32)
        for number in np.flatnonzero(kind == EDGE).tolist():
            edge = TopoDS.Edge(self.shapes[number])
            degenerated[number] = BRep_Tool.Degenerated_s(edge)
            if BRep_Tool.HasContinuity_s(edge):
                smooth[number] = int(BRep_Tool.MaxContinuity_s(edge))
        face_tri = np.full(len(kind), -1, dtype=np.int32)
        for number, tri in self.face_tri.items():
            face_tri[number] = tri
        subs = np.array([sub for group in self.subs for sub in group], dtype=np.int32).reshape(-1, 3)
        reps = np.array([(*key, *value) for key, value in self.reps.items()], dtype=np.int32).reshape(-1, 5)
        free = np.array(self.free, dtype=np.int32).reshape(-1, 3)
        datums: list[Floats] = [matrix_of(datum) for datum in self.datums]
        tris = list(self.tris)
        nodes = [
            (point.X(), point.Y(), point.Z()) for tri in tris for point in map(tri.Node, range(1, tri.NbNodes() + 1))
        ]
        return Tables(
            kind=kind,
            degenerated=degenerated,
            face_tri=face_tri,
            smooth=smooth,
            sub_start=starts([len(group) for group in self.subs]),
            sub_shape=subs[:, 0].copy(),
            sub_orient=subs[:, 1].astype(np.uint8),
            sub_loc=subs[:, 2].copy(),
            rep_edge=reps[:, 0],
            rep_tri=reps[:, 1],
            rep_loc=reps[:, 2],
            rep_poly=reps[:, 3],
            rep_poly2=reps[:, 4],
            free_edge=free[:, 0],
            free_loc=free[:, 1],
            free_poly=free[:, 2],
            poly_start=starts([len(nodes) for nodes in self.polygons]),
            poly_nodes=np.array([node for polygon in self.polygons for node in polygon], dtype=np.int32),
            line_start=starts([len(line) for line in self.lines]),
            line_points=np.array([point for line in self.lines for point in line], dtype=np.float64).reshape(-1, 3),
            node_start=starts([tri.NbNodes() for tri in tris]),
            nodes=np.array(nodes, dtype=np.float64).reshape(-1, 3),
            uv=np.array([place for tri in tris for place in _parameters(tri)], dtype=np.float64).reshape(-1, 2),
            normals=np.array([normal for tri in tris for normal in _normals(tri)], dtype=np.float32).reshape(-1, 3),
            tri_start=starts([tri.NbTriangles() for tri in tris]),
            triangles=np.array(
                [tri.Triangle(i).Get() for tri in tris for i in range(1, tri.NbTriangles() + 1)], dtype=np.int32
            ).reshape(-1, 3)
            - np.int32(1),
            locations=Locations(list(self.chains), datums),
        )


def matrix_of(datum: Any) -> Floats:
    """(3, 4) matrix of an elementary move."""
    from OCP.TopLoc import TopLoc_Location

    return matrix(TopLoc_Location(datum.Trsf()))


def _parameters(tri: Any) -> list[tuple[float, float]]:
    if not tri.HasUVNodes():
        return [(np.nan, np.nan)] * tri.NbNodes()
    return [(place.X(), place.Y()) for place in map(tri.UVNode, range(1, tri.NbNodes() + 1))]


def _normals(tri: Any) -> list[tuple[float, float, float]]:
    if not tri.HasNormals():
        return [(0.0, 0.0, 0.0)] * tri.NbNodes()
    normals = [tri.Normal(i) for i in range(1, tri.NbNodes() + 1)]
    return [(normal.X(), normal.Y(), normal.Z()) for normal in normals]
