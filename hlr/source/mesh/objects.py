"""Meshes in memory: trimesh and manifold3d objects, and plain arrays."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr.common.types import Color, Floats, Ints
from hlr.errors import SourceError
from hlr.source.mesh.mesh_source import Instance, MeshSource
from hlr.source.model import Frame
from hlr.source.packages import package_of
from hlr.tables.readers import is_model

MM_PER_UNIT = {
    "micron": 1e-3,
    "micrometer": 1e-3,
    "micrometers": 1e-3,
    "millimeter": 1.0,
    "millimeters": 1.0,
    "mm": 1.0,
    "centimeter": 10.0,
    "centimeters": 10.0,
    "cm": 10.0,
    "meter": 1000.0,
    "meters": 1000.0,
    "m": 1000.0,
    "inch": 25.4,
    "inches": 25.4,
    "in": 25.4,
    "foot": 304.8,
    "feet": 304.8,
    "ft": 304.8,
}
"""Millimetres per unit, by the names of units in files and trimesh."""


Y_UP = ((1.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0))
"""glTF: y points up and z toward the viewer; world = unit * up * model."""


def is_trimesh(thing: Any) -> bool:
    """Whether `read_trimesh` reads it; nothing is imported."""
    return package_of(thing) == "trimesh"


def is_manifold(thing: Any) -> bool:
    """Whether `read_manifold` reads it; nothing is imported."""
    return package_of(thing) == "manifold3d"


@dataclass(frozen=True, slots=True)
class Meshes:
    """What was read of one object: geometries as `MeshSource` takes them, where they are placed, and their frame."""

    geometries: list[tuple[Any, Any]]
    instances: list[Instance]
    frame: Frame = field(default_factory=Frame)


def read_trimesh(thing: Any, part: str) -> Meshes:
    """A trimesh.Trimesh or trimesh.Scene. part: the name of what has none.

    Raises:
        SourceError: it holds no triangles, only points or curves.
    """
    source = getattr(thing, "source", None)
    kind = str(getattr(source, "file_type", "") or "").lower()
    up = Y_UP if kind in ("glb", "gltf") else Frame().up
    frame = Frame(MM_PER_UNIT.get(str(getattr(thing, "units", None) or "mm").lower(), 1.0), up)
    return _meshes(type(thing).__name__, thing, frame, own_name(thing) or part)


def own_name(thing: Any) -> str:
    """The name of a trimesh.Trimesh: what it was given, or that of its file without the ending; "": it has none."""
    if not hasattr(thing, "faces"):
        return ""
    given = (getattr(thing, "metadata", None) or {}).get("name")
    name = str(given or getattr(getattr(thing, "source", None), "file_path", None) or "")
    if name.startswith(_MADE_UP):
        return ""
    return Path(name).stem if is_model(name) else name


_MADE_UP = ("geometry_", "GLTF", "world")
"""How names begin that trimesh makes up."""


def from_trimesh(name: str, kind: str, thing: Any, frame: Frame, part: str) -> MeshSource:
    """The meshes of a trimesh object, with its names; a nameless one is named `part`.

    Raises:
        SourceError: it holds no triangles.
    """
    found = _meshes(name, thing, frame, part)
    return MeshSource(name, kind, found.geometries, found.instances, found.frame)


def _meshes(name: str, thing: Any, frame: Frame, part: str) -> Meshes:
    if not hasattr(thing, "graph"):
        if not hasattr(thing, "faces"):
            raise SourceError(f"{name} holds no triangles (only points or curves): there is nothing to draw.")
        return Meshes([_arrays(name, thing)], [Instance(part, 0, np.eye(4), _color(thing), thing)], frame)
    geometries: list[tuple[Any, Any]] = []
    numbers: dict[str, int] = {}
    instances: list[Instance] = []
    for node in thing.graph.nodes_geometry:
        matrix, key = _placement(thing.graph, node)
        geometry = thing.geometry.get(key)
        if geometry is None or not hasattr(geometry, "faces"):
            continue
        if key not in numbers:
            numbers[key] = len(geometries)
            geometries.append(_arrays(name, geometry))
        named = node_name(node, key, part)
        instances.append(Instance(named, numbers[key], matrix, _color(geometry), geometry))
    if len(instances) == 1 and not instances[0].name:
        instances = [replace(instances[0], name=part)]
    return Meshes(geometries, instances, frame)


def _arrays(name: str, mesh: Any) -> tuple[Any, Any]:
    """Vertices (n, 3) and faces (m, 3). Some readers of trimesh pass on other numbers of columns: SourceError."""
    vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)
    if any(table.size and table.shape[1:] != (3,) for table in (vertices, faces)):
        raise SourceError(f"{name} holds vertices or faces that are not three numbers each: export it again.")
    return vertices, faces


def _placement(graph: Any, node: str) -> tuple[Floats, str]:
    """The (4, 4) transform of a node relative to the base, and its geometry's key.

    Multiplied without BLAS: the same bits on every machine.
    """
    from hlr.source.transforms import IDENTITY, compose, matrix4

    transforms = graph.transforms
    key = transforms.node_data[node]["geometry"]
    result, here = IDENTITY, node
    for _ in range(10_000):
        parent = transforms.parents.get(here)
        if parent is None or here == graph.base_frame:
            break
        edge = transforms.edge_data[(parent, here)]
        step = edge.get("matrix")
        if step is not None:
            result = compose(tuple(np.asarray(step, dtype=np.float64)[:3].ravel().tolist()), result)
        here = parent
    return matrix4(result), key


def node_name(node: str, key: str, part: str) -> str:
    """The name of a node; `part` where trimesh made up one."""
    for text in (key, node):
        plain = str(text)
        if plain and not plain.startswith(_MADE_UP) and "." not in plain[-5:]:
            return plain
    return part


def _color(mesh: Any) -> Color | None:
    """The colour of a mesh's material; colours of vertices and faces do not count."""
    material = getattr(getattr(mesh, "visual", None), "material", None)
    factor = getattr(material, "baseColorFactor", None)
    linear = factor is not None
    if factor is None:
        factor = getattr(material, "diffuse", None)
    if factor is None:
        return None
    values = np.asarray(factor)
    if values.shape not in ((3,), (4,)):
        return None
    scaled = values.astype(np.float64) / (255.0 if values.dtype.kind in "ui" else 1.0)
    red, green, blue = (_linear_to_srgb(float(v)) if linear else round(float(v), 6) for v in scaled[:3])
    return red, green, blue


def _linear_to_srgb(value: float) -> float:
    value = min(max(value, 0.0), 1.0)
    return round(12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055, 6)


def read_manifold(thing: Any, part: str) -> Meshes:
    """A manifold3d.Manifold.

    Raises:
        SourceError: it is in an error state.
    """
    status = getattr(thing, "status", None)
    if status is not None and getattr(status(), "name", "NoError") != "NoError":
        raise SourceError(f"The Manifold is in the error state {status().name}: there is nothing to draw.")
    mesh = thing.to_mesh64() if hasattr(thing, "to_mesh64") else thing.to_mesh()
    points = np.asarray(mesh.vert_properties)[:, :3]
    return Meshes([(points, np.asarray(mesh.tri_verts))], [Instance(part, 0, np.eye(4), None)])


def read_pair(thing: Any, part: str) -> Meshes:
    """Plain arrays: vertices (n, 3), faces (m, 3) or (m, 4) of vertex numbers.

    Raises:
        SourceError: other shapes.
    """
    vertices, faces = thing
    try:
        given: npt.NDArray[Any] = np.asarray(vertices)
        if given.dtype.kind not in "iufbO":  # an imaginary part would be lost, and text is no coordinate
            raise TypeError
        points = given.astype(np.float64, copy=False)
        corners: npt.NDArray[Any] = np.asarray(faces)
    except (TypeError, ValueError):
        raise SourceError("(vertices, faces) must be arrays of numbers: (n, 3) and (m, 3).") from None
    if points.ndim != 2 or points.shape[1] != 3:
        raise SourceError(f"vertices must have the shape (n, 3), not {points.shape}.")
    if corners.ndim != 2 or corners.shape[1] not in (3, 4) or corners.dtype.kind not in "iu":
        raise SourceError(f"faces must be whole numbers of the shape (m, 3) or (m, 4), not {corners.shape}.")
    if corners.shape[1] == 4:
        corners = np.concatenate((corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]))
    if corners.size and not (corners.min() >= 0 and corners.max() < len(points)):
        outside = (corners < 0) | (corners >= len(points))
        raise SourceError(f"faces name {int(outside.sum())} vertices that do not exist (there are {len(points)}).")
    triangles: Ints = corners.astype(np.int32, copy=False)
    return Meshes([(points, triangles)], [Instance(part, 0, np.eye(4), None)])
