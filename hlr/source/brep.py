"""A B-rep source: parts with names, colours and placements, tessellated as finely as asked."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from copy import copy
from dataclasses import replace
from typing import Any

import numpy as np

from hlr import _kernel
from hlr.errors import SourceError
from hlr.notes import Note
from hlr.source.bindings import collection
from hlr.source.extent import checked
from hlr.source.locations import determinant_sign, moved, moved_each
from hlr.source.model import (
    Choice,
    EdgeCurves,
    Floats,
    Frame,
    Ints,
    Look,
    Meshed,
    OnSurfaces,
    PartInfo,
    PartMesh,
    Progress,
    Surfaces,
)
from hlr.source.parts import Part, compound
from hlr.source.roots import Roots
from hlr.source.tessellate import Tessellator
from hlr.source.weld import clean


class BrepSource:
    """Parts on roots as a source: from leaves of an assembly (`hlr.source.leaves`), or out of the cache.

    Lengths are millimetres, z is up. The caller's shapes are neither copied nor changed: triangles that they have stay.
    reading: how the model was come by, for people; "" where there is nothing to say.
    """

    def __init__(self, name: str, kind: str, parts: Sequence[Part], roots: Roots, notes: Sequence[Note] = ()) -> None:
        """Parts, at least one, that stand on `roots` and have faces."""
        self._name, self._kind, self._notes = name, kind, list(notes)
        self._roots = roots
        self.choice: Choice | None = None
        self.reading = ""
        self._hold(parts)

    @property
    def name(self) -> str:
        """Base name."""
        return self._name

    @property
    def kind(self) -> str:
        """step, iges, brep, script or object."""
        return self._kind

    @property
    def frame(self) -> Frame:
        """Millimetres, z up."""
        return Frame()

    @property
    def notes(self) -> list[Note]:
        """Warnings met while reading."""
        return list(self._notes)

    def infos(self) -> list[PartInfo]:
        """Counts of every part's index maps."""
        return [PartInfo(part.name, *self._roots.counts[part.root].tolist()) for part in self._parts]

    def boxes(self) -> list[Floats]:
        """Corners of every part's box, (8, 3), or none where it has no extent."""
        boxes = self._roots.boxes
        return [moved(_corners(*boxes[part.root].tolist()), part.transform) for part in self._parts]

    def of_parts(self, names: Collection[str], choice: Choice) -> BrepSource:
        """The same source with these parts only; nothing else of it is meshed."""
        chosen = copy(self)
        chosen.choice = choice
        chosen._hold([part for part in self._parts if part.name in names])
        return chosen

    def _hold(self, parts: Sequence[Part]) -> None:
        """The parts that are drawn, and what will be known of them."""
        self._parts = list(parts)
        self._used = sorted({part.root for part in parts})
        self._bounds: Floats | None = None
        self._tessellator: Tessellator | None = None
        self._maps: dict[tuple[int, Any], Any] = {}
        self._root_of = {part.name: part.root for part in self._parts}

    @property
    def parts(self) -> list[Part]:
        """The parts that are drawn."""
        return self._parts

    @property
    def roots(self) -> Roots:
        """What they stand on, and parts that are left out as well."""
        return self._roots

    def transparent(self) -> bool:
        """Some part has an opacity below one."""
        return any(part.transparent for part in self._parts)

    def looks(self) -> dict[str, Look]:
        """Colours and opacities of parts and faces."""
        return {part.name: part.look() for part in self._parts}

    def bounds(self) -> Floats:
        """(2, 3) corners in millimetres; free-form surfaces count with their control points."""
        if self._bounds is None:
            corners = [box for box in self.boxes() if len(box)]
            if not corners:
                raise SourceError(f"{self._name}: no part has any extent.")
            every = np.concatenate(corners)
            self._bounds = checked(self._name, np.stack((every.min(axis=0), every.max(axis=0))))
        return self._bounds.copy()

    def edge_shape(self, part: str, index: int) -> Any:
        """The TopoDS_Edge with this number in the TopExp edge map of the part of that name, without its placement."""
        from OCP.TopAbs import TopAbs_ShapeEnum as Kind
        from OCP.TopoDS import TopoDS

        return TopoDS.Edge(self._map(part, Kind.TopAbs_EDGE).FindKey(index + 1))

    def face_shape(self, part: str, index: int) -> Any:
        """The TopoDS_Face with this number in the TopExp face map of the part of that name, without its placement."""
        from OCP.TopAbs import TopAbs_ShapeEnum as Kind
        from OCP.TopoDS import TopoDS

        return TopoDS.Face(self._map(part, Kind.TopAbs_FACE).FindKey(index + 1))

    def face_edges(self, part: str, index: int) -> list[int]:
        """Numbers of the edges of a face of a part, both counted as TopExp does."""
        from OCP.TopAbs import TopAbs_ShapeEnum as Kind
        from OCP.TopExp import TopExp

        own = collection("shape_map")
        TopExp.MapShapes_s(self.face_shape(part, index), Kind.TopAbs_EDGE, own)
        every = self._map(part, Kind.TopAbs_EDGE)
        return [every.FindIndex(own.FindKey(i)) - 1 for i in range(1, own.Extent() + 1)]

    def _map(self, part: str, kind: Any) -> Any:
        """The TopExp map of a part's edges or faces."""
        from OCP.TopExp import TopExp

        key = self._root_of[part], kind
        if key not in self._maps:
            self._maps[key] = collection("shape_map")
            TopExp.MapShapes_s(self._roots.shapes[key[0]], kind, self._maps[key])
        return self._maps[key]

    def shape(self) -> Any:
        """All parts that are drawn, each where it stands, as one TopoDS_Compound."""
        from OCP.gp import gp_Trsf
        from OCP.TopLoc import TopLoc_Location

        placed = []
        for part in self._parts:
            move = gp_Trsf()
            move.SetValues(*(float(value) for value in part.transform[:3].ravel()))
            placed.append(self._roots.shapes[part.root].Moved(TopLoc_Location(move), False))
        return compound(placed)

    def mesh(self, deflection: float, angle: float, progress: Progress | None = None) -> Meshed:
        """Tessellate: chord error at most `deflection` (millimetres), turning at most `angle` (radians).

        Raises:
            SourceError: no part could be meshed.
        """
        if self._tessellator is None:
            low, high = self.bounds()
            self._tessellator = Tessellator(self._roots, self._used, float(np.sqrt(((high - low) ** 2).sum())))
        meshes = self._tessellator.mesh(deflection, angle, progress)
        faults = self._tessellator.faults
        meshed = Meshed(parts=[], rescued=len(faults.rescued), lost=len(faults.lost))
        kept: list[Part] = []
        surfaces = self._tessellator
        shared = {root: _Shared(meshes, number, surfaces) for number, root in enumerate(self._used)}
        places = _placed_points([(part, shared[part.root].points) for part in self._parts])
        for part, points in zip(self._parts, places, strict=True):
            mesh = shared[part.root]
            meshed.notes += faults.notes(part.name, mesh.face_shape)
            if len(mesh.triangles):
                meshed.parts.append(mesh.placed(part, points))
                kept.append(part)
            else:
                text = f'Part "{part.name}" has no triangles and was left out.'
                meshed.notes.append(Note("part-left-out", text))
        if not any(len(part.triangles) for part in meshed.parts):
            raise SourceError(f"{self._name}: none of its faces could be meshed.")
        number = {root: i for i, root in enumerate(self._used)}
        roots = np.array([number[part.root] for part in kept], np.int32)
        transforms = np.array([part.transform[:3] for part in kept])

        def edge_curves(part: Ints, edge: Ints) -> EdgeCurves:
            keys = np.stack([roots[part], edge], axis=1)
            distinct, which = np.unique(keys, axis=0, return_inverse=True)
            found = surfaces.edge_curves(*np.ascontiguousarray(distinct.T, np.int32))
            return EdgeCurves(found, which.ravel().astype(np.int32), part, transforms)

        meshed.edge_curves = edge_curves
        return meshed


class _Shared:
    """One root's arrays, shared by all its placements."""

    def __init__(self, meshes: _kernel.BrepParts, number: int, surfaces: Surfaces) -> None:
        a, b = meshes.point_start[number : number + 2]
        c, d = meshes.triangle_start[number : number + 2]
        e, f = meshes.edge_start[number : number + 2]
        g, h = meshes.face_start[number : number + 2]
        self.points = meshes.points[a:b]
        self.triangles = meshes.triangles[c:d]
        self.triangle_face = meshes.triangle_face[c:d]
        self.face_planar = meshes.face_planar[g:h]
        offsets = meshes.edge_offsets[e : f + 1]
        self.edge_nodes = meshes.edge_nodes[offsets[0] : offsets[-1]]
        self.edge_offsets = offsets - offsets[0]
        self.edge_index = meshes.edge_index[e:f]
        self.edge_class = meshes.edge_class[e:f]
        self.face_shape = meshes.face_shape[g:h]
        i, j = meshes.node_start[number : number + 2]
        self.on_surfaces: OnSurfaces | None = OnSurfaces(
            corner=meshes.corner[c:d],
            uv=meshes.uv[i:j],
            number=meshes.face_shape[g:h],
            place=meshes.face_place[g:h],
            reversed=meshes.face_reversed[g:h],
            surfaces=surfaces,
        )
        self.brep, self.precision = True, 0.0
        if len(self.triangles) and not len(self.edge_index):
            # Tessellated geometry: faces are loose triangles, and what they share must be found by position.
            joined = clean(self.points, self.triangles)
            self.points, self.triangles = joined.points, joined.triangles
            self.triangle_face = joined.of_kept(self.triangle_face)
            # Of a round of few facets a face may be one: it may show an outline though it is flat.
            self.face_planar = np.zeros(len(self.face_planar), dtype=bool)
            self.brep = False
            self.precision = joined.precision
            self.on_surfaces = None

    def placed(self, part: Part, points: Floats) -> PartMesh:
        triangles, on_surfaces = self.triangles, self.on_surfaces
        if determinant_sign(part.transform) < 0:
            triangles = np.ascontiguousarray(triangles[:, [0, 2, 1]])
            if on_surfaces is not None:
                on_surfaces = replace(on_surfaces, corner=np.ascontiguousarray(on_surfaces.corner[:, [0, 2, 1]]))
        return PartMesh(
            name=part.name,
            color=part.color,
            transform=part.transform,
            points=points,
            triangles=triangles,
            triangle_face=self.triangle_face,
            face_planar=self.face_planar,
            edge_nodes=self.edge_nodes,
            edge_offsets=self.edge_offsets,
            edge_index=self.edge_index,
            edge_class=self.edge_class,
            brep=self.brep,
            on_surfaces=on_surfaces,
            precision=self.precision,
        )


def _placed_points(parts: list[tuple[Part, Floats]]) -> list[Floats]:
    """Points of every part where it stands; thousands of small parts are moved in one go."""
    transforms = np.array([part.transform for part, _ in parts])
    result = [points for _, points in parts]
    away = np.flatnonzero((transforms != np.eye(4)).any(axis=(1, 2)))
    small = [i for i in away if len(result[i]) <= SMALL_PART]
    for i in away:
        if len(result[i]) > SMALL_PART:
            result[i] = moved(result[i], transforms[i])
    if small:
        sizes = np.array([len(result[i]) for i in small])
        together = moved_each(np.concatenate([result[i] for i in small]), np.repeat(transforms[small], sizes, axis=0))
        for i, points in zip(small, np.split(together, np.cumsum(sizes)[:-1]), strict=True):
            result[i] = points
    return result


SMALL_PART = 1000
"""Points: up to here moving part by part costs more in calls than in arithmetic."""


def _corners(low: list[float], high: list[float]) -> Floats:
    """(8, 3) corners of a box, or none where there is none."""
    if low > high:
        return np.empty((0, 3))
    sides = list(zip(low, high, strict=True))
    return np.array([(x, y, z) for x in sides[0] for y in sides[1] for z in sides[2]])
