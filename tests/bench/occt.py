"""OpenCASCADE's own hidden-line removal and CadQuery's export, timed as a user would meet them."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

DIRECTION = (1.0, -1.0, 1.0)
KINDS = (
    "VCompound",
    "Rg1LineVCompound",
    "RgNLineVCompound",
    "OutLineVCompound",
    "HCompound",
    "Rg1LineHCompound",
    "RgNLineHCompound",
    "OutLineHCompound",
)


def mesh(shape: Any, deflection: float, angle: float) -> float:
    """Triangulate with OpenCASCADE's defaults, in parallel. Seconds."""
    from OCP.BRepMesh import BRepMesh_IncrementalMesh

    start = time.perf_counter()
    BRepMesh_IncrementalMesh(shape, deflection, False, angle, True)
    return time.perf_counter() - start


def triangle_count(shape: Any) -> int:
    from OCP.BRep import BRep_Tool
    from OCP.TopAbs import TopAbs_FACE
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopLoc import TopLoc_Location
    from OCP.TopoDS import TopoDS

    count = 0
    explorer = TopExp_Explorer(shape, TopAbs_FACE)
    while explorer.More():
        triangles = BRep_Tool.Triangulation_s(TopoDS.Face_s(explorer.Current()), TopLoc_Location())
        count += triangles.NbTriangles() if triangles is not None else 0
        explorer.Next()
    return count


def _projector() -> Any:
    from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt
    from OCP.HLRAlgo import HLRAlgo_Projector

    return HLRAlgo_Projector(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(*DIRECTION)))


def poly(shape: Any) -> float:
    """HLRBRep_PolyAlgo on the triangulation the shape carries, results extracted. Seconds."""
    from OCP.HLRBRep import HLRBRep_PolyAlgo, HLRBRep_PolyHLRToShape

    start = time.perf_counter()
    algorithm = HLRBRep_PolyAlgo()
    algorithm.Load(shape)
    algorithm.Projector(_projector())
    algorithm.Update()
    result = HLRBRep_PolyHLRToShape()
    result.Update(algorithm)
    for kind in KINDS:
        getattr(result, kind)()
    return time.perf_counter() - start


def exact(shape: Any) -> float:
    """HLRBRep_Algo on the B-rep, results extracted with their 3-D curves. Seconds."""
    from OCP.BRepLib import BRepLib
    from OCP.HLRBRep import HLRBRep_Algo, HLRBRep_HLRToShape

    start = time.perf_counter()
    algorithm = HLRBRep_Algo()
    algorithm.Add(shape)
    algorithm.Projector(_projector())
    algorithm.Update()
    algorithm.Hide()
    result = HLRBRep_HLRToShape(algorithm)
    for kind in KINDS:
        compound = getattr(result, kind)()
        if compound is not None and not compound.IsNull():
            BRepLib.BuildCurves3d_s(compound)
    return time.perf_counter() - start


def build123d_svg(shape: Any, path: Path) -> float:
    """build123d's `project_to_viewport` and its `ExportSVG`, without their import. Seconds."""
    import build123d as bd

    whole = bd.Compound(shape)
    whole.center()
    start = time.perf_counter()
    write_build123d(*whole.project_to_viewport(tuple(1000 * c for c in DIRECTION)), path)
    return time.perf_counter() - start


def write_build123d(visible: Any, hidden: Any, path: Path) -> None:
    """Two layers, as build123d's documentation does it."""
    import build123d as bd

    exporter = bd.ExportSVG()
    exporter.add_layer("visible")
    exporter.add_layer("hidden", line_type=bd.LineType.ISO_DOT)
    exporter.add_shape(visible, layer="visible")
    exporter.add_shape(hidden, layer="hidden")
    exporter.write(str(path))


def cadquery_svg(shape: Any, path: Path) -> float:
    """`cadquery.exporters.export(..., "SVG")` with hidden lines, without its import. Seconds."""
    import cadquery as cq
    from cadquery.occ_impl.exporters.svg import getSVG

    start = time.perf_counter()
    path.write_text(getSVG(cq.Shape.cast(shape), {"projectionDir": DIRECTION, "showHidden": True}))
    return time.perf_counter() - start
