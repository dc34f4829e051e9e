"""Triangle meshes as a source: from trimesh and manifold3d objects, and from plain arrays."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from copy import copy
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr.common.types import Color, Floats, Ints, Progress
from hlr.drawing.notes import Note
from hlr.errors import SourceError, counted
from hlr.source.extent import box, checked
from hlr.source.locations import determinant_sign, moved
from hlr.source.mesh.weld import Clean, clean
from hlr.source.model import Choice, Frame, Look, Meshed, PartInfo, PartMesh

UNITS = {
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
"""Millimetres per unit, by the names that files and trimesh use."""

Y_UP = ((1.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0))
"""glTF: y points up and z toward the viewer; world = unit * up * model."""


@dataclass(frozen=True, slots=True)
class Instance:
    """One mesh standing somewhere: the number of its geometry and a (4, 4) transform.

    mesh: what knows its colours: the trimesh object that it comes from, or `Painted`; None for bare arrays.
    """

    name: str
    geometry: int
    transform: Floats
    color: Color | None
    mesh: Any = None


class MeshSource:
    """Parts that are triangles already: `mesh` hands them over whatever the deflection."""

    def __init__(
        self,
        name: str,
        kind: str,
        geometries: Sequence[tuple[Any, Any]],
        instances: Sequence[Instance],
        frame: Frame | None = None,
    ) -> None:
        """Clean each geometry, given as (points, triangles), once.

        Raises:
            SourceError: no triangle is left, or the model is too large to calculate with.
        """
        self._name, self._kind = name, kind
        self.choice: Choice | None = None
        self._frame = frame if frame is not None else Frame()
        self._notes: list[Note] = []
        cleaned = [clean(points, triangles) for points, triangles in geometries]
        self._report(cleaned)
        self._parts: list[PartMesh] = []
        self._drawn: list[tuple[PartMesh, Instance, Clean]] = []
        for instance, label in zip(instances, unique_names([i.name for i in instances]), strict=True):
            mesh = cleaned[instance.geometry]
            if len(mesh.triangles):
                self._parts.append(_part(label, mesh, instance))
                self._drawn.append((self._parts[-1], instance, mesh))
            else:
                self._notes.append(Note("part-left-out", f'Part "{label}" has no triangles and was left out.'))
        if not self._parts:
            raise SourceError(self._refusal(cleaned))
        checked(name, self.bounds())

    def _report(self, cleaned: list[Clean]) -> None:
        for count, what, why in (
            (sum(mesh.not_finite for mesh in cleaned), "triangle", " with coordinates that are no numbers"),
            (sum(mesh.out_of_range for mesh in cleaned), "triangle", " with corners that do not exist"),
            (sum(mesh.degenerate for mesh in cleaned), "degenerate triangle", " (two corners in one place)"),
        ):
            if count:
                left = "was" if count == 1 else "were"
                self._notes.append(Note("triangles-left-out", f"{counted(count, what)}{why} {left} left out."))

    def _refusal(self, cleaned: list[Clean]) -> str:
        if any(mesh.not_finite for mesh in cleaned):
            return f"{self._name} holds no triangle whose coordinates are all numbers: export it again."
        if any(mesh.degenerate for mesh in cleaned):
            return f"{self._name} holds only degenerate triangles: there is nothing to draw."
        return f"{self._name} holds no triangles: there is nothing to draw."

    @property
    def name(self) -> str:
        """Base name."""
        return self._name

    @property
    def kind(self) -> str:
        """stl, obj, ply, off, 3mf, glb or mesh."""
        return self._kind

    @property
    def frame(self) -> Frame:
        """Unit and up axis of the model's coordinates."""
        return self._frame

    @property
    def notes(self) -> list[Note]:
        """What was left out while reading."""
        return list(self._notes)

    def bounds(self) -> Floats:
        """(2, 3) exact corners in model coordinates."""
        return box(np.concatenate(self.boxes()))

    def names(self) -> list[str]:
        """Of every part."""
        return [part.name for part in self._parts]

    def infos(self) -> list[PartInfo]:
        """Meshes have no faces or edges of their own; both counts are 0."""
        return [PartInfo(part.name, 0, 0, 0) for part in self._parts]

    def boxes(self) -> list[Floats]:
        """(2, 3) corners of every part."""
        return [box(part.points) for part in self._parts]

    def of_parts(self, names: Collection[str], choice: Choice) -> MeshSource:
        """The same source with these parts only."""
        chosen = copy(self)
        chosen.choice = choice
        chosen._drawn = [drawn for drawn in self._drawn if drawn[0].name in names]
        chosen._parts = [part for part, _, _ in chosen._drawn]
        return chosen

    def transparent(self) -> bool:
        """The file says something of colours."""
        return any(instance.mesh is not None for _, instance, _ in self._drawn)

    def looks(self) -> dict[str, Look]:
        """Materials, and colours of vertices and faces where there is no material."""
        from hlr.source.mesh.looks import look

        return {part.name: look(part, instance.mesh, clean) for part, instance, clean in self._drawn}

    def mesh(self, deflection: float, angle: float, progress: Progress | None = None) -> Meshed:
        """The triangles as they are; deflection and angle (radians) have no effect."""
        if progress is not None:
            progress("tessellate", 1.0)
        return Meshed(parts=list(self._parts))


def unique_names(names: Sequence[str]) -> list[str]:
    """Names in order, repeated ones numbered from 2: bolt, bolt:2, bolt:3."""
    taken: set[str] = set()
    counts: dict[str, int] = {}
    result = []
    for name in names:
        unique = name
        while unique in taken or not unique:
            base = name or "part"
            counts[base] = counts.get(base, 1) + 1 if base in taken else 1
            unique = base if counts[base] == 1 else f"{base}:{counts[base]}"
        taken.add(unique)
        result.append(unique)
    return result


def _part(name: str, mesh: Clean, instance: Instance) -> PartMesh:
    points, triangles = mesh.points, mesh.triangles
    moved_away = not (instance.transform == np.eye(4)).all()
    if moved_away:
        with np.errstate(over="ignore", invalid="ignore"):  # such a size is refused in a sentence
            points = moved(points, instance.transform)
            mirrored = determinant_sign(instance.transform) < 0
        if mirrored:
            triangles = np.ascontiguousarray(triangles[:, [0, 2, 1]])
    none = np.empty(0, dtype=np.int32)
    return PartMesh(
        name=name,
        color=instance.color,
        transform=instance.transform,
        points=points,
        triangles=triangles,
        triangle_face=np.zeros(len(triangles), dtype=np.int32),
        face_planar=np.zeros(1, dtype=bool),
        edge_nodes=none,
        edge_offsets=np.zeros(1, dtype=np.int32),
        edge_index=none,
        edge_class=np.empty(0, dtype=np.uint8),
        brep=False,
        joined=not moved_away,
        precision=mesh.precision * float(np.sqrt((instance.transform[:3, :3] ** 2).sum(axis=0).max())),
    )


def open_trimesh(thing: Any) -> MeshSource:
    """A trimesh.Trimesh or trimesh.Scene.

    Raises:
        SourceError: it holds no triangles.
    """
    source = getattr(thing, "source", None)
    kind = str(getattr(source, "file_type", "") or "").lower()
    up = Y_UP if kind in ("glb", "gltf") else Frame().up
    frame = Frame(UNITS.get(str(getattr(thing, "units", None) or "mm").lower(), 1.0), up)
    return from_trimesh(type(thing).__name__, "mesh", thing, frame, "part")


def from_trimesh(name: str, kind: str, thing: Any, frame: Frame, part: str) -> MeshSource:
    """Meshes of a trimesh object under its own names; `part` names a single nameless one.

    Raises:
        SourceError: it holds no triangles.
    """
    if not hasattr(thing, "graph"):
        if not hasattr(thing, "faces"):
            raise SourceError(f"{name} holds no triangles (only points or curves): there is nothing to draw.")
        whole = Instance(part, 0, np.eye(4), _color(thing), thing)
        return MeshSource(name, kind, [_arrays(name, thing)], [whole], frame)
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
    return MeshSource(name, kind, geometries, instances, frame)


def _arrays(name: str, mesh: Any) -> tuple[Any, Any]:
    """Vertices and faces; some readers of trimesh hand on whatever number of columns a file has."""
    vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)
    if any(table.size and table.shape[1:] != (3,) for table in (vertices, faces)):
        raise SourceError(f"{name} holds vertices or faces that are not three numbers each: export it again.")
    return vertices, faces


def _placement(graph: Any, node: str) -> tuple[Floats, str]:
    """(4, 4) transform of a node, multiplied up to the base without BLAS: the same bits on every machine."""
    from hlr.source.locations import HERE, chained, four

    transforms = graph.transforms
    key = transforms.node_data[node]["geometry"]
    result, here = HERE, node
    for _ in range(10_000):
        parent = transforms.parents.get(here)
        if parent is None or here == graph.base_frame:
            break
        edge = transforms.edge_data[(parent, here)]
        step = edge.get("matrix")
        if step is not None:
            result = chained(tuple(np.asarray(step, dtype=np.float64)[:3].ravel().tolist()), result)
        here = parent
    return four(result), key


def node_name(node: str, key: str, part: str) -> str:
    """A readable name: trimesh invents some for nameless geometry."""
    for text in (key, node):
        plain = str(text)
        if plain and not plain.startswith(("geometry_", "GLTF", "world")) and "." not in plain[-5:]:
            return plain
    return part


def _color(mesh: Any) -> Color | None:
    """The one colour of a mesh's material; vertex and face colours are no colour of the part."""
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
    red, green, blue = (_srgb(float(v)) if linear else round(float(v), 6) for v in scaled[:3])
    return red, green, blue


def _srgb(value: float) -> float:
    value = min(max(value, 0.0), 1.0)
    return round(12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055, 6)


def open_manifold(thing: Any) -> MeshSource:
    """A manifold3d.Manifold.

    Raises:
        SourceError: it is empty, or in an error state.
    """
    status = getattr(thing, "status", None)
    if status is not None and getattr(status(), "name", "NoError") != "NoError":
        raise SourceError(f"The Manifold is in the error state {status().name}: there is nothing to draw.")
    mesh = thing.to_mesh64() if hasattr(thing, "to_mesh64") else thing.to_mesh()
    points = np.asarray(mesh.vert_properties)[:, :3]
    whole = Instance("part", 0, np.eye(4), None)
    return MeshSource("Manifold", "mesh", [(points, np.asarray(mesh.tri_verts))], [whole])


def open_arrays(vertices: Any, faces: Any) -> MeshSource:
    """Plain arrays: vertices (n, 3), faces (m, 3) or (m, 4) of vertex numbers.

    Raises:
        SourceError: other shapes, or no triangles.
    """
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
    return MeshSource("mesh", "mesh", [(points, triangles)], [Instance("part", 0, np.eye(4), None)])
