"""Triangle meshes as a source."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hlr import _kernel
from hlr.common.types import Color, Floats, Ints, Progress
from hlr.drawing.notes import Note
from hlr.errors import SourceError, counted
from hlr.request.options import Vector
from hlr.source.bounds import bounding_box, check_bounds
from hlr.source.mesh.cleaning import CleanMesh, clean_mesh
from hlr.source.model import Appearance, Choice, Frame, PartInfo, PartMesh, Tessellation
from hlr.source.transforms import determinant_sign, transform_points


@dataclass(frozen=True, slots=True)
class Instance:
    """A placed mesh: the index of its geometry, and a (4, 4) transform.

    mesh: the source of its colours, a trimesh object or `FileColors`; None for plain arrays.
    opacity: of its colour, 0 to 1, where `mesh` says nothing
    """

    name: str
    geometry: int
    transform: Floats
    color: Color | None
    mesh: Any = None
    opacity: float = 1.0


class MeshSource:
    """Parts that are triangles already. The deflection does not change them."""

    def __init__(
        self,
        name: str,
        kind: str,
        geometries: Sequence[tuple[Any, Any]],
        instances: Sequence[Instance],
        frame: Frame | None = None,
        notes: Sequence[Note] = (),
    ) -> None:
        """Clean each geometry (points (n, 3), triangles (m, 3)). notes: what was left out before.

        Raises:
            SourceError: no triangle is left, or the model is too large to calculate with.
        """
        self._name, self._kind = name, kind
        self.choice: Choice | None = None
        self.reading = ""
        self._frame = frame if frame is not None else Frame()
        self._notes = list(notes)
        cleaned = [clean_mesh(points, triangles) for points, triangles in geometries]
        self._report(cleaned)
        self._parts: list[PartMesh] = []
        self._boxes: list[Floats] | None = None
        self._drawn: list[tuple[PartMesh, Instance, CleanMesh]] = []
        for instance, label in zip(instances, unique_names([i.name for i in instances]), strict=True):
            mesh = cleaned[instance.geometry]
            if len(mesh.triangles):
                self._parts.append(_part(label, mesh, instance))
                self._drawn.append((self._parts[-1], instance, mesh))
            else:
                self._notes.append(Note("part-left-out", f'Part "{label}" has no triangles and was left out.'))
        if not self._parts:
            raise SourceError(self._refusal(cleaned))
        check_bounds(name, self.bounds())

    def _report(self, cleaned: list[CleanMesh]) -> None:
        for count, what, why in (
            (sum(mesh.not_finite for mesh in cleaned), "triangle", " with coordinates that are no numbers"),
            (sum(mesh.out_of_range for mesh in cleaned), "triangle", " with corners that do not exist"),
            (sum(mesh.degenerate for mesh in cleaned), "degenerate triangle", " (two corners in one place)"),
        ):
            if count:
                left = "was" if count == 1 else "were"
                self._notes.append(Note("triangles-left-out", f"{counted(count, what)}{why} {left} left out."))

    def _refusal(self, cleaned: list[CleanMesh]) -> str:
        if any(mesh.not_finite for mesh in cleaned):
            return f"{self._name} holds no triangle whose coordinates are all numbers: export it again."
        if any(mesh.out_of_range for mesh in cleaned):
            return f"{self._name} holds no triangle whose corners all exist: export it again."
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
        return bounding_box(np.concatenate(self.boxes()))

    def reach(self, right: Vector, up: Vector) -> Floats:
        """(2, 2) how far the parts reach along two directions of length 1: lower and upper end along each."""
        view = _kernel.Camera((0.0, 0.0, 0.0), right, up, None, 1.0)
        ends = np.array([view.reach(part.points) for part in self._parts])
        return np.stack([ends[..., 0].min(axis=0), ends[..., 1].max(axis=0)], axis=1)

    def names(self) -> list[str]:
        """Name of every part."""
        return [part.name for part in self._parts]

    def infos(self) -> list[PartInfo]:
        """Meshes have no faces or edges of their own; both counts are 0."""
        return [PartInfo(part.name, 0, 0, 0) for part in self._parts]

    def boxes(self) -> list[Floats]:
        """(2, 3) corners of every part."""
        if self._boxes is None:
            self._boxes = [bounding_box(part.points) for part in self._parts]
        return [box.copy() for box in self._boxes]

    def of_parts(self, names: Collection[str], choice: Choice) -> MeshSource:
        """The same source with these parts only."""
        chosen = copy(self)
        chosen.choice = choice
        chosen._drawn = [drawn for drawn in self._drawn if drawn[0].name in names]
        chosen._parts = [part for part, _, _ in chosen._drawn]
        chosen._boxes = None
        return chosen

    @property
    def parts(self) -> list[PartMesh]:
        """The parts that are drawn."""
        return self._parts

    def with_pieces(
        self, pieces: Mapping[str, Sequence[tuple[Floats, Ints]]]
    ) -> tuple[MeshSource, dict[str, tuple[str, int]]]:
        """The same source with other points and triangles of some parts: as many parts as there are pieces of one.

        They have one colour each. Also, by the name of each part, that of the whole part, and the number of the piece.
        """
        changed = copy(self)
        changed._drawn, changed._boxes = [], None
        names = {part.name for part in self._parts}
        whose = {part.name: (part.name, 0) for part in self._parts if part.name not in pieces}
        for part, instance, mesh in self._drawn:
            if part.name not in pieces:
                changed._drawn.append((part, instance, mesh))
            for k, piece in enumerate(pieces.get(part.name, ())):
                cleaned = clean_mesh(*piece)
                if not len(cleaned.triangles):
                    continue
                name = part.name if part.name not in whose else unique_names([*names, part.name])[-1]
                names.add(name)
                whose[name] = part.name, k
                whole = Instance(name, 0, np.eye(4), instance.color, opacity=instance.opacity)
                made = replace(_part(name, cleaned, whole), precision=max(part.precision, cleaned.precision))
                changed._drawn.append((made, whole, cleaned))
        changed._parts = [part for part, _, _ in changed._drawn]
        return changed, whose

    def transparent(self) -> bool:
        """Whether there are colours that may be transparent."""
        return any(instance.mesh is not None or instance.opacity < 1.0 for _, instance, _ in self._drawn)

    def appearances(self) -> dict[str, Appearance]:
        """Colours of materials; where there is no material, of vertices or faces."""
        from hlr.source.mesh.colors import mesh_appearance

        return {
            part.name: mesh_appearance(part, instance.mesh, mesh, instance.opacity)
            for part, instance, mesh in self._drawn
        }

    def mesh(self, deflection: float, angle: float, progress: Progress | None = None) -> Tessellation:
        """The triangles as they are; deflection and angle (radians) have no effect."""
        if progress is not None:
            progress("tessellate", 1.0)
        return Tessellation(parts=list(self._parts))


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


def _part(name: str, mesh: CleanMesh, instance: Instance) -> PartMesh:
    points, triangles = mesh.points, mesh.triangles
    is_moved = not (instance.transform == np.eye(4)).all()
    if is_moved:
        with np.errstate(over="ignore", invalid="ignore"):  # too large a model is refused later, in one sentence
            points = transform_points(points, instance.transform)
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
        joined=not is_moved,
        precision=mesh.precision * float(np.sqrt((instance.transform[:3, :3] ** 2).sum(axis=0).max())),
    )
