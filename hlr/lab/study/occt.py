"""OpenCASCADE's own hidden-line removal, polygonal and exact, as a contestant."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from hlr.common.types import Floats
from hlr.image.camera import Camera
from hlr.lab.study.ink import Ink, gathered
from hlr.lab.study.watch import Watch

CHORD = 0.001
"""Millimetres on paper: how finely the exact algorithm's curves are looked at; not timed."""


def poly(shape: Any, camera: Camera, per_model: float, deflection: float, angle: float, watch: Watch) -> Ink:
    """HLRBRep_PolyAlgo on OpenCASCADE's triangulation with this deflection (model units) and angle (radians)."""
    from OCP.BRep import BRep_Tool
    from OCP.BRepLib import BRepLib
    from OCP.BRepMesh import BRepMesh_IncrementalMesh
    from OCP.BRepTools import BRepTools
    from OCP.HLRBRep import HLRBRep_PolyAlgo, HLRBRep_PolyHLRToShape
    from OCP.TopExp import TopExp

    BRepTools.Clean_s(shape)
    watch("tessellate")
    BRepMesh_IncrementalMesh(shape, deflection, False, angle, True)
    watch("scene")
    # Files do not say which edges are tangent; without this all of them would be drawn.
    BRepLib.EncodeRegularity_s(shape)
    watch("visibility")
    algorithm = HLRBRep_PolyAlgo()
    algorithm.Load(shape)
    algorithm.Projector(_projector(camera))
    algorithm.Update()
    watch("linework")
    result = HLRBRep_PolyHLRToShape()
    result.Update(algorithm)
    found = (
        ("sharp", True, result.VCompound()),
        ("sharp", False, result.HCompound()),
        ("outline", True, result.OutLineVCompound()),
        ("outline", False, result.OutLineHCompound()),
    )
    watch.stop()
    lines = []
    for kind, visible, compound in found:
        for edge in _edges(compound):
            ends = [BRep_Tool.Pnt_s(vertex(edge)).Coord()[:2] for vertex in (TopExp.FirstVertex_s, TopExp.LastVertex_s)]
            lines.append((kind, visible, np.array(ends) * per_model))
    return gathered(lines)


def exact(shape: Any, camera: Camera, per_model: float, watch: Watch) -> Ink:
    """HLRBRep_Algo on the B-rep itself."""
    from OCP.BRepLib import BRepLib
    from OCP.HLRBRep import HLRBRep_Algo, HLRBRep_HLRToShape, HLRBRep_TypeOfResultingEdge

    watch("scene")
    BRepLib.EncodeRegularity_s(shape)
    watch("visibility")
    algorithm = HLRBRep_Algo()
    algorithm.Add(shape)
    algorithm.Projector(_projector(camera))
    algorithm.Update()
    algorithm.Hide()
    watch("linework")
    result = HLRBRep_HLRToShape(algorithm)
    selectors = {
        "sharp": HLRBRep_TypeOfResultingEdge.HLRBRep_Sharp,
        "outline": HLRBRep_TypeOfResultingEdge.HLRBRep_OutLine,
    }
    found = []
    for kind, selector in selectors.items():
        for visible in (True, False):
            compound = result.CompoundOfEdges(selector, visible, True)
            if compound is not None and not compound.IsNull():
                BRepLib.BuildCurves3d_s(compound)
                found.append((kind, visible, compound))
    watch.stop()
    axes = np.stack([camera.right, camera.up], axis=1) * per_model
    lines = []
    for kind, visible, compound in found:
        for edge in _edges(compound):
            points = _chords(edge, CHORD / per_model)
            if points is not None:
                lines.append((kind, visible, points @ axes))
    return gathered(lines)


def _projector(camera: Camera) -> Any:
    from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt
    from OCP.HLRAlgo import HLRAlgo_Projector

    return HLRAlgo_Projector(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(*camera.direction), gp_Dir(*camera.right)))


def _edges(compound: Any) -> Iterator[Any]:
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    if compound is None or compound.IsNull():
        return
    explorer = TopExp_Explorer(compound, Kind.TopAbs_EDGE)
    while explorer.More():
        yield TopoDS.Edge(explorer.Current())
        explorer.Next()


def _chords(edge: Any, deflection: float) -> Floats | None:
    from OCP.BRepAdaptor import BRepAdaptor_Curve
    from OCP.GCPnts import GCPnts_QuasiUniformDeflection

    points = GCPnts_QuasiUniformDeflection(BRepAdaptor_Curve(edge), deflection)
    if not points.IsDone() or points.NbPoints() < 2:
        return None
    return np.array([points.Value(i).Coord() for i in range(1, points.NbPoints() + 1)])
