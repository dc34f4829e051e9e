"""OpenCASCADE's mesher and its two hidden-line algorithms, as rivals; only this module of the project calls them.

`PolyAlgo` and `ExactAlgo` have the same three steps, so that each can be timed by itself:

>>> rival = PolyAlgo(shape, direction, right)
>>> rival.hide()                       # what is visible is decided
>>> rival.extract()                    # the result becomes shapes
>>> rival.lines(rival.compounds())     # the shapes become points; this step is not timed
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr.common.types import Floats

Line = tuple[str, bool, Floats]
"""Class ("sharp" or "outline"), whether it is visible, and points in model units."""

FLAT_RESULTS = (
    "VCompound",
    "Rg1LineVCompound",
    "RgNLineVCompound",
    "OutLineVCompound",
    "HCompound",
    "Rg1LineHCompound",
    "RgNLineHCompound",
    "OutLineHCompound",
)
"""Both algorithms' results by the names of their methods: every class of line, visible and hidden."""


class HiddenLines(ABC):
    """One parallel view of one shape.

    direction: (3,) from the shape toward the viewer. right: (3,) to the right on paper; OpenCASCADE's choice if None.
    result: OpenCASCADE's own object, once it is extracted.
    """

    def __init__(self, shape: Any, direction: Sequence[float] | Floats, right: Sequence[float] | Floats | None = None):
        self._shape = shape
        self._axes = direction, right
        self._algorithm: Any = None
        self.result: Any = None

    def hide(self) -> None:
        """Run the algorithm."""
        self._algorithm = self._run(self._projector())

    def extract(self) -> None:
        """Make shapes of the visible and hidden edges."""
        self.result = self._extracted()

    def compounds(self) -> list[tuple[str, bool, Any]]:
        """(class, visible, compound of edges) for sharp edges and outlines; `lines` reads them."""
        return self._sharp_and_outlines()

    def flat_compounds(self) -> list[Any]:
        """The compounds of `FLAT_RESULTS`, as exporters of drawings take them; None for an empty one."""
        found = [getattr(self.result, name)() for name in FLAT_RESULTS]
        return [None if compound is None or compound.IsNull() else self._with_curves(compound) for compound in found]

    def lines(self, compounds: Sequence[tuple[str, bool, Any]], chord: float = 0.0) -> list[Line]:
        """The edges of `compounds` as points.

        PolyAlgo: straight pieces (2, 2) on the plane of the view. ExactAlgo: polylines (n, 3) in space, with a chord
        error of at most `chord` (model units).
        """
        found = []
        for name, visible, compound in compounds:
            for edge in edges(compound):
                points = self._points(edge, chord)
                if points is not None:
                    found.append((name, visible, points))
        return found

    def drawn(self, chord: float = 0.0) -> list[Line]:
        """The lines, by all three steps."""
        self.hide()
        self.extract()
        return self.lines(self.compounds(), chord)

    @abstractmethod
    def _run(self, projector: Any) -> Any: ...

    @abstractmethod
    def _extracted(self) -> Any: ...

    @abstractmethod
    def _sharp_and_outlines(self) -> list[tuple[str, bool, Any]]: ...

    @abstractmethod
    def _points(self, edge: Any, chord: float) -> Floats | None:
        """Points along one edge of a result; None where it has no curve."""

    def _with_curves(self, compound: Any) -> Any:
        return compound

    def _projector(self) -> Any:
        from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt
        from OCP.HLRAlgo import HLRAlgo_Projector

        directions = (gp_Dir(*map(float, axis)) for axis in self._axes if axis is not None)
        return HLRAlgo_Projector(gp_Ax2(gp_Pnt(0, 0, 0), *directions))


class PolyAlgo(HiddenLines):
    """HLRBRep_PolyAlgo, on the triangles that the shape carries."""

    def _run(self, projector: Any) -> Any:
        from OCP.HLRBRep import HLRBRep_PolyAlgo

        algorithm = HLRBRep_PolyAlgo()
        algorithm.Load(self._shape)
        algorithm.Projector(projector)
        algorithm.Update()
        return algorithm

    def _extracted(self) -> Any:
        from OCP.HLRBRep import HLRBRep_PolyHLRToShape

        result = HLRBRep_PolyHLRToShape()
        result.Update(self._algorithm)
        return result

    def _sharp_and_outlines(self) -> list[tuple[str, bool, Any]]:
        result = self.result
        return [
            ("sharp", True, result.VCompound()),
            ("sharp", False, result.HCompound()),
            ("outline", True, result.OutLineVCompound()),
            ("outline", False, result.OutLineHCompound()),
        ]

    def _points(self, edge: Any, chord: float) -> Floats:
        from OCP.BRep import BRep_Tool
        from OCP.TopExp import TopExp

        return np.array([BRep_Tool.Pnt_s(end(edge)).Coord()[:2] for end in (TopExp.FirstVertex_s, TopExp.LastVertex_s)])


class ExactAlgo(HiddenLines):
    """HLRBRep_Algo, on curves and surfaces. It may never end, or crash: give it a process of its own."""

    def _run(self, projector: Any) -> Any:
        from OCP.HLRBRep import HLRBRep_Algo

        algorithm = HLRBRep_Algo()
        algorithm.Add(self._shape)
        algorithm.Projector(projector)
        algorithm.Update()
        algorithm.Hide()
        return algorithm

    def _extracted(self) -> Any:
        from OCP.HLRBRep import HLRBRep_HLRToShape

        return HLRBRep_HLRToShape(self._algorithm)

    def _sharp_and_outlines(self) -> list[tuple[str, bool, Any]]:
        from OCP.HLRBRep import HLRBRep_TypeOfResultingEdge as Type

        found = []
        for name, kind in (("sharp", Type.HLRBRep_Sharp), ("outline", Type.HLRBRep_OutLine)):
            for visible in (True, False):
                compound = self.result.CompoundOfEdges(kind, visible, True)
                if compound is not None and not compound.IsNull():
                    found.append((name, visible, self._with_curves(compound)))
        return found

    def _with_curves(self, compound: Any) -> Any:
        from OCP.BRepLib import BRepLib

        BRepLib.BuildCurves3d_s(compound)
        return compound

    def _points(self, edge: Any, chord: float) -> Floats | None:
        from OCP.BRepAdaptor import BRepAdaptor_Curve
        from OCP.GCPnts import GCPnts_QuasiUniformDeflection

        points = GCPnts_QuasiUniformDeflection(BRepAdaptor_Curve(edge), chord)
        if not points.IsDone() or points.NbPoints() < 2:
            return None
        return np.array([points.Value(i).Coord() for i in range(1, points.NbPoints() + 1)])


def mark_tangent_edges(shape: Any) -> None:
    """Mark edges along which two faces are tangent. Files do not mark them, and unmarked ones are drawn as sharp."""
    from OCP.BRepLib import BRepLib

    BRepLib.EncodeRegularity_s(shape)


def mesh(shape: Any, deflection: float, angle: float) -> None:
    """Triangulate the faces that have no triangles, on all cores. deflection: model units; angle: radians."""
    from OCP.BRepMesh import BRepMesh_IncrementalMesh

    BRepMesh_IncrementalMesh(shape, deflection, False, angle, True)


def forget_mesh(shape: Any) -> None:
    """Remove the triangles from a shape, so that the next program has to mesh it."""
    from OCP.BRepTools import BRepTools

    BRepTools.Clean_s(shape)


@dataclass(frozen=True)
class FaceMesh:
    """The triangles that one face carries.

    face, triangulation, location   OpenCASCADE's own
    nodes      (n, 3) in the face's own frame
    triangles  (m, 3) indices of nodes, oriented as the face
    placement  (3, 4) from the face's own frame to the model
    """

    face: Any
    triangulation: Any
    location: Any
    nodes: Floats
    triangles: npt.NDArray[np.int64]
    placement: Floats

    @property
    def points(self) -> Floats:
        """(n, 3) the nodes in the model."""
        return np.asarray(self.nodes @ self.placement[:, :3].T + self.placement[:, 3])


def face_meshes(shape: Any) -> Iterator[FaceMesh]:
    """The triangles of each face of a shape, in the shape's order; faces without triangles are left out."""
    from OCP.BRep import BRep_Tool
    from OCP.TopAbs import TopAbs_Orientation, TopAbs_ShapeEnum
    from OCP.TopLoc import TopLoc_Location
    from OCP.TopoDS import TopoDS

    for each in subshapes(shape, TopAbs_ShapeEnum.TopAbs_FACE):
        face, location = TopoDS.Face(each), TopLoc_Location()
        triangulation = BRep_Tool.Triangulation_s(face, location)
        if triangulation is None:
            continue
        move = location.Transformation()
        placement = np.array([[move.Value(row, column) for column in range(1, 5)] for row in range(1, 4)])
        nodes = np.array([triangulation.Node(i).Coord() for i in range(1, triangulation.NbNodes() + 1)])
        corners = np.array([triangulation.Triangle(i).Get() for i in range(1, triangulation.NbTriangles() + 1)]) - 1
        if face.Orientation() == TopAbs_Orientation.TopAbs_REVERSED:
            corners = corners[:, ::-1]
        yield FaceMesh(face, triangulation, location, nodes, corners, placement)


def triangle_count(shape: Any) -> int:
    """The number of triangles of all faces; a face that occurs twice counts twice."""
    from OCP.BRep import BRep_Tool
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopLoc import TopLoc_Location
    from OCP.TopoDS import TopoDS

    faces = (TopoDS.Face(each) for each in subshapes(shape, TopAbs_ShapeEnum.TopAbs_FACE))
    found = (BRep_Tool.Triangulation_s(face, TopLoc_Location()) for face in faces)
    return sum(triangulation.NbTriangles() for triangulation in found if triangulation is not None)


def edges(compound: Any) -> Iterator[Any]:
    """The edges of a compound, each as often as it occurs; no edges for None."""
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopoDS import TopoDS

    if compound is not None and not compound.IsNull():
        for each in subshapes(compound, TopAbs_ShapeEnum.TopAbs_EDGE):
            yield TopoDS.Edge(each)


def subshapes(shape: Any, kind: Any, outside: Any = None) -> Iterator[Any]:
    """Sub-shapes of a kind in the shape's order, each as often as it occurs, except those within the kind `outside`."""
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer

    explorer = TopExp_Explorer(shape, kind, TopAbs_ShapeEnum.TopAbs_SHAPE if outside is None else outside)
    while explorer.More():
        yield explorer.Current()
        explorer.Next()
