"""The referee's own mesh of a model, made by OpenCASCADE or trimesh alone, without `hlr.source`."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int32]

BREP = {".step", ".stp", ".iges", ".igs", ".brep", ".brp"}
MESH = {".stl", ".obj", ".ply", ".off", ".3mf", ".glb", ".gltf"}
SUFFIXES = BREP | MESH
FINENESS = 20000
"""The mesh deviates from the model by at most the diagonal divided by this; quick tests ask for less."""


@dataclass(frozen=True)
class Reference:
    """Triangles in model coordinates.

    diagonal   of the bounding box, model units
    unit       millimetres per model unit
    unmeshed   faces OpenCASCADE could not triangulate: nothing hides behind them here
    fineness   the deflection asked for is diagonal / fineness
    """

    points: Floats
    triangles: Ints
    diagonal: float
    unit: float = 1.0
    unmeshed: int = 0
    fineness: float = FINENESS

    @property
    def accuracy(self) -> float:
        """The accuracy to request of a drawing at scale 1, in millimetres."""
        return self.diagonal * self.unit / self.fineness


def from_arrays(points: npt.ArrayLike, triangles: npt.ArrayLike, unit: float = 1.0) -> Reference:
    points = np.asarray(points, dtype=np.float64).reshape(-1, 3)
    triangles = np.asarray(triangles, dtype=np.int32).reshape(-1, 3)
    used = points[triangles.ravel()]
    if not len(used):
        raise ValueError("no triangles")
    diagonal = float(np.linalg.norm(used.max(axis=0) - used.min(axis=0)))
    return Reference(points, triangles, diagonal, unit)


def load(path: str | Path, fineness: float = FINENESS, cache: Path | None = None) -> Reference:
    """Mesh a file, or take the mesh of the same file from `cache`: meshing can take minutes."""
    path = Path(path)
    if path.suffix.lower() not in BREP:
        return replace(from_mesh_file(path), fineness=fineness)
    if cache is None:
        return from_shape(read_shape(path), fineness)
    name = hashlib.sha256(path.read_bytes() + f"{fineness}".encode()).hexdigest()[:24]
    kept = cache / f"{path.stem}-{name}.npz"
    if kept.exists():
        with np.load(kept) as arrays:
            model = from_arrays(arrays["points"], arrays["triangles"])
            return replace(model, unmeshed=int(arrays["unmeshed"]), fineness=fineness)
    model = from_shape(read_shape(path), fineness)
    cache.mkdir(parents=True, exist_ok=True)
    np.savez(kept, points=model.points, triangles=model.triangles, unmeshed=model.unmeshed)
    return model


def read_shape(path: str | Path) -> Any:
    """The file as one TopoDS_Shape in millimetres, assemblies placed."""
    path = Path(path)
    suffix = path.suffix.lower()
    if suffix in {".brep", ".brp"}:
        from OCP.BRep import BRep_Builder
        from OCP.BRepTools import BRepTools
        from OCP.TopoDS import TopoDS_Shape

        shape = TopoDS_Shape()
        if not BRepTools.Read_s(shape, str(path), BRep_Builder()):
            raise ValueError(f"{path.name}: not a readable BREP file")
        return shape
    from OCP.IFSelect import IFSelect_RetDone

    if suffix in {".iges", ".igs"}:
        from OCP.IGESControl import IGESControl_Reader

        reader = IGESControl_Reader()
    else:
        from OCP.STEPControl import STEPControl_Reader

        reader = STEPControl_Reader()
    if reader.ReadFile(str(path)) != IFSelect_RetDone:
        raise ValueError(f"{path.name}: not readable")
    reader.TransferRoots()
    shape = reader.OneShape()
    if shape.IsNull():
        raise ValueError(f"{path.name}: no shape in it")
    return shape


def shape_diagonal(shape: Any) -> float:
    """Diagonal of the tight bounding box of the geometry (a stored triangulation would be too coarse)."""
    from OCP.Bnd import Bnd_Box
    from OCP.BRepBndLib import BRepBndLib

    box = Bnd_Box()
    BRepBndLib.AddOptimal_s(shape, box, False, False)
    if box.IsVoid():  # only triangles without surfaces
        BRepBndLib.Add_s(shape, box, True)
    if box.IsVoid():
        raise ValueError("the shape is empty")
    return float(np.sqrt(box.SquareExtent()))


def from_shape(shape: Any, fineness: float = FINENESS, angle: float = 0.5) -> Reference:
    """Mesh a shape afresh with OpenCASCADE's default triangulator."""
    from OCP.BRep import BRep_Tool
    from OCP.BRepMesh import BRepMesh_IncrementalMesh
    from OCP.BRepTools import BRepTools
    from OCP.Precision import Precision
    from OCP.ShapeFix import ShapeFix_ShapeTolerance
    from OCP.TopAbs import TopAbs_FACE, TopAbs_REVERSED
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopLoc import TopLoc_Location
    from OCP.TopoDS import TopoDS

    BRepTools.Clean_s(shape)
    # The mesher does not refine below the tolerance of a face's vertices, which is large in some files. Without this
    # step the reference may be dozens of deflections off the surface.
    ShapeFix_ShapeTolerance().SetTolerance(shape, Precision.Confusion_s())
    BRepMesh_IncrementalMesh(shape, shape_diagonal(shape) / fineness, False, angle, True)
    points: list[Floats] = []
    triangles: list[Ints] = []
    count = unmeshed = 0
    explorer = TopExp_Explorer(shape, TopAbs_FACE)
    while explorer.More():
        face = TopoDS.Face_s(explorer.Current())
        explorer.Next()
        place = TopLoc_Location()
        mesh = BRep_Tool.Triangulation_s(face, place)
        if mesh is None:
            unmeshed += 1
            continue
        nodes = np.array([mesh.Node(i).Coord() for i in range(1, mesh.NbNodes() + 1)])
        if not place.IsIdentity():
            move = place.Transformation()
            matrix = np.array([[move.Value(row, column) for column in range(1, 5)] for row in range(1, 4)])
            nodes = nodes @ matrix[:, :3].T + matrix[:, 3]
        corners = np.array([mesh.Triangle(i).Get() for i in range(1, mesh.NbTriangles() + 1)], dtype=np.int32) - 1
        if face.Orientation() == TopAbs_REVERSED:
            corners = corners[:, ::-1]
        points.append(nodes)
        triangles.append(corners + count)
        count += len(nodes)
    if not points:
        raise ValueError("the shape has no faces that can be meshed")
    model = from_arrays(np.concatenate(points), np.concatenate(triangles))
    return replace(model, unmeshed=unmeshed, fineness=fineness)


def from_mesh_file(path: Path) -> Reference:
    import trimesh

    scene = trimesh.load_scene(path, process=False)
    unit = 1000.0 if path.suffix.lower() in {".glb", ".gltf"} else 1.0
    mesh = scene.to_geometry()
    if not isinstance(mesh, trimesh.Trimesh):
        raise ValueError(f"{path.name}: no triangles in it")
    return from_arrays(mesh.vertices, mesh.faces, unit)
