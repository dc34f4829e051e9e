"""One call of OpenCASCADE's mesher."""

from __future__ import annotations

from typing import Any


def run_mesher(shape: Any, deflection: float, angle: float, delabella: bool = True) -> None:
    """Triangulate the faces of a shape that have no triangulation yet; edges keep the polygons they have.

    deflection: chord error, model units; angle: turning per chord, radians; delabella: else the older Watson algorithm.
    """
    from OCP.BRepMesh import BRepMesh_IncrementalMesh
    from OCP.IMeshTools import IMeshTools_MeshAlgoType, IMeshTools_Parameters

    parameters = IMeshTools_Parameters()
    kinds = IMeshTools_MeshAlgoType
    parameters.MeshAlgo = kinds.IMeshTools_MeshAlgoType_Delabella if delabella else kinds.IMeshTools_MeshAlgoType_Watson
    parameters.Deflection = deflection
    parameters.Angle = angle
    parameters.InParallel = True
    BRepMesh_IncrementalMesh(shape, parameters)
