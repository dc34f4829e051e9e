"""A B-rep model as a source: parts with names, colours and placements, tessellated to a requested chord error."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from copy import copy
from typing import Any

import numpy as np

from hlr import _kernel
from hlr.common.types import Bools, Floats, Ints, Progress
from hlr.drawing.notes import Note
from hlr.errors import SourceError
from hlr.request.accuracy import CONTACT
from hlr.request.options import Vector
from hlr.source.bounds import check_bounds, diagonal
from hlr.source.cad.occt_collections import new_collection
from hlr.source.cad.parts import Part
from hlr.source.cad.prototypes import Prototypes
from hlr.source.cad.shapes import make_compound
from hlr.source.cad.tessellator import Tessellator
from hlr.source.model import Appearance, Choice, EdgeCurves, Frame, PartInfo, Tessellation
from hlr.source.part_meshes import PartMeshes, check_triangle_count
from hlr.source.precision import coordinate_precision


class BrepSource:
    """Parts and the prototypes that they are instances of, as a source. Lengths are millimetres, z is up.

    Built from the leaves of an assembly (`hlr.source.cad.source_builder`) or from the cache. The caller's shapes are
    neither copied nor changed; triangulations that they carry stay.
    reading: one sentence for users on how the model was read and whether it came from the cache; may be empty.
    """

    def __init__(
        self, name: str, kind: str, parts: Sequence[Part], prototypes: Prototypes, notes: Sequence[Note] = ()
    ) -> None:
        """Args: `parts`, at least one, each an instance of one of `prototypes`."""
        self._name, self._kind, self._notes = name, kind, list(notes)
        self._prototypes = prototypes
        self.choice: Choice | None = None
        self.reading = ""
        self._set_parts(parts)

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

    def names(self) -> list[str]:
        """Name of every part."""
        return [part.name for part in self._parts]

    def also_called(self) -> dict[str, tuple[str, ...]]:
        """By the names of parts, those of their assemblies, and of their places there, where these differ."""
        return {part.name: part.above for part in self._parts if part.above}

    def infos(self) -> list[PartInfo]:
        """Numbers of faces, edges and solids of every part."""
        return [PartInfo(part.name, *self._prototypes.counts[part.prototype].tolist()) for part in self._parts]

    def of_parts(self, names: Collection[str], choice: Choice) -> BrepSource:
        """The same source with these parts only; no other part is tessellated."""
        chosen = copy(self)
        chosen.choice = choice
        chosen._set_parts([part for part in self._parts if part.name in names])
        return chosen

    def _set_parts(self, parts: Sequence[Part]) -> None:
        """Set the parts that are drawn, and forget what was computed for others."""
        self._parts = list(parts)
        used = {part.prototype for part in parts}
        # A prototype without faces takes no time to mesh, whereas a model without it would have to be read anew.
        self._used_prototypes = [i for i, has in enumerate(self._prototypes.has_faces) if i in used or not has]
        self._prototype_numbers: Ints = np.array([part.prototype for part in self._parts], np.int32)
        # The number of each part's prototype among those that are used.
        self._used_numbers = self._prototype_numbers
        if len(self._used_prototypes) < len(self._prototypes.has_faces):
            self._used_numbers = np.searchsorted(self._used_prototypes, self._prototype_numbers).astype(np.int32)
        self._places: Floats = np.array([part.transform for part in self._parts])
        self._corners: tuple[Floats, Floats] | None = None
        self._bounds: Floats | None = None
        self._tessellator: Tessellator | None = None
        self._maps: dict[tuple[int, Any], Any] = {}
        self._prototype_of = {part.name: part.prototype for part in self._parts}

    @property
    def parts(self) -> list[Part]:
        """The parts that are drawn."""
        return self._parts

    @property
    def prototypes(self) -> Prototypes:
        """The prototypes of all parts, also of those that are left out."""
        return self._prototypes

    def transparent(self) -> bool:
        """Some part has an opacity below one."""
        return any(part.transparent for part in self._parts)

    def appearances(self) -> dict[str, Appearance]:
        """Colours and opacities of parts and faces."""
        return {part.name: part.appearance() for part in self._parts}

    def boxes(self) -> list[Floats]:
        """Corners of every part's box, (8, 3), or none where it has no extent."""
        boxes = self._prototypes.boxes
        void = (boxes[:, 0, 0] > boxes[:, 1, 0]).tolist()
        corners, _ = self._placed
        return [box[:0] if void[part.prototype] else box for part, box in zip(self._parts, corners, strict=True)]

    def bounds(self) -> Floats:
        """(2, 3) lower and upper corner in millimetres; a free-form surface has the box of its control points."""
        if self._bounds is None:
            _, bounds = self._placed
            if bounds[0, 0] > bounds[1, 0]:
                raise SourceError(f"{self._name}: no part has any extent.")
            self._bounds = check_bounds(self._name, bounds)
        return self._bounds.copy()

    def reach(self, right: Vector, up: Vector) -> Floats:
        """(2, 2) how far the parts reach along two directions of length 1: lower and upper end along each.

        May be a little too far: splines count by the control points of small pieces.
        """
        return self._part_tessellator.reach(self._used_numbers, self._places, right, up)

    @property
    def _placed(self) -> tuple[Floats, Floats]:
        """Corners (p, 8, 3) of the parts' boxes, and the box (2, 3) around all that are not empty."""
        if self._corners is None:
            self._corners = _kernel.placed_boxes(self._prototypes.boxes, self._prototype_numbers, self._places)
        return self._corners

    def edge_shape(self, part: str, index: int) -> Any:
        """The TopoDS_Edge with this index in the TopExp edge map of the named part, without its placement."""
        from OCP.TopAbs import TopAbs_ShapeEnum as Kind
        from OCP.TopoDS import TopoDS

        return TopoDS.Edge(self._map(part, Kind.TopAbs_EDGE).FindKey(index + 1))

    def face_shape(self, part: str, index: int) -> Any:
        """The TopoDS_Face with this index in the TopExp face map of the named part, without its placement."""
        from OCP.TopAbs import TopAbs_ShapeEnum as Kind
        from OCP.TopoDS import TopoDS

        return TopoDS.Face(self._map(part, Kind.TopAbs_FACE).FindKey(index + 1))

    def face_edges(self, part: str, index: int) -> list[int]:
        """Indices (TopExp edge map of the part) of the edges of a face (index in its TopExp face map)."""
        from OCP.TopAbs import TopAbs_ShapeEnum as Kind
        from OCP.TopExp import TopExp

        own = new_collection("shape_map")
        TopExp.MapShapes_s(self.face_shape(part, index), Kind.TopAbs_EDGE, own)
        every = self._map(part, Kind.TopAbs_EDGE)
        return [every.FindIndex(own.FindKey(i)) - 1 for i in range(1, own.Extent() + 1)]

    def _map(self, part: str, kind: Any) -> Any:
        """The TopExp map of a part's edges or faces."""
        from OCP.TopExp import TopExp

        key = self._prototype_of[part], kind
        if key not in self._maps:
            self._maps[key] = new_collection("shape_map")
            TopExp.MapShapes_s(self._prototypes.shapes[key[0]], kind, self._maps[key])
        return self._maps[key]

    def shape(self) -> Any:
        """All parts that are drawn, with their placements, as one TopoDS_Compound."""
        from OCP.gp import gp_Trsf
        from OCP.TopLoc import TopLoc_Location

        placed = []
        for part in self._parts:
            move = gp_Trsf()
            move.SetValues(*(float(value) for value in part.transform[:3].ravel()))
            placed.append(self._prototypes.shapes[part.prototype].Moved(TopLoc_Location(move), False))
        return make_compound(placed)

    @property
    def _part_tessellator(self) -> Tessellator:
        if self._tessellator is None:
            self._tessellator = Tessellator(self._prototypes, self._used_prototypes, diagonal(self.bounds()))
        return self._tessellator

    def is_one_sphere(self) -> bool:
        """There is one part, and it is one whole sphere: no other line of it than its outline is ever drawn."""
        return len(self._parts) == 1 and self._part_tessellator.is_one_sphere()

    def mesh(
        self, deflection: float, angle: float, progress: Progress | None = None, *, finer: Collection[str] = ()
    ) -> Tessellation:
        """Tessellate: chord error at most `deflection` (millimetres), turning per chord at most `angle` (radians).

        Faces that may touch other parts are meshed more finely, and all faces of the parts named by `finer`.

        Raises:
            SourceError: no part could be meshed, or it would have too many triangles.
        """
        surfaces, (fine, touching) = self._part_tessellator, self._touching(deflection, finer)
        try:
            tables, faults = surfaces.mesh(deflection, angle, fine, progress)
        except MemoryError:
            raise SourceError(
                f"{self._name} would have more than 16 million triangles: give a coarser accuracy, or a smaller scale."
            ) from None
        prototypes, kept, notes = self._used_numbers, self._parts, []
        transforms = np.ascontiguousarray(self._places[:, :3])
        fewest, triangles = tables.triangle_counts(prototypes)
        if faults or not fewest:
            starts = tables.triangle_start
            triangles_of = (starts[1:] - starts[:-1])[prototypes]
            meshed = (triangles_of > 0) | ~np.array(self._prototypes.has_faces)[self._prototype_numbers]
            kept = [part for part, is_meshed in zip(self._parts, meshed, strict=True) if is_meshed]
            for part, number, is_meshed in zip(self._parts, prototypes.tolist(), meshed.tolist(), strict=True):
                a, b = tables.face_start[number : number + 2]
                notes += faults.notes(part.name, tables.face_shape[a:b])
                if not is_meshed:
                    text = f'Part "{part.name}" has no triangles and was left out.'
                    notes.append(Note("part-left-out", text))
            prototypes, transforms, touching = prototypes[meshed], transforms[meshed], touching[meshed]
        if not kept:
            raise SourceError(f"{self._name}: none of its faces could be meshed.")
        if faults.off:
            first = tables.face_start
            faces = (tables.face_shape[first[i] : first[i + 1]] for i in self._used_numbers)
            notes.append(faults.off_note((part.name, own) for part, own in zip(self._parts, faces, strict=True)))
        check_triangle_count(triangles)
        placed = tables.placed(prototypes, transforms, _precisions(tables)[prototypes])

        def edge_curves(part: Ints, edge: Ints) -> EdgeCurves:
            keys = prototypes[part].astype(np.int64) << 32 | edge
            distinct, which = np.unique(keys, return_inverse=True)
            found = surfaces.edge_curves((distinct >> 32).astype(np.int32), distinct.astype(np.int32))
            return EdgeCurves(found, which.ravel().astype(np.int32), part, transforms)

        parts = PartMeshes(kept, placed, surfaces if placed.brep_parts else None)
        rescued = len(faults.rescued) + len(faults.crossed)
        return Tessellation(parts, notes, rescued, len(faults.lost), edge_curves, self._surface_parts, touching)

    def _touching(self, deflection: float, finer: Collection[str] = ()) -> tuple[Bools, Ints]:
        """Which underlying faces may touch another part somewhere, and (p,) how many faces of each part may.

        All faces may of a part that is not one solid, as they may touch one another, and of those named by `finer`.
        """
        faces, _, solids = self._prototypes.counts[self._prototype_numbers].T
        faced = faces > 0  # Lines of annotations and sketches have no facets.
        whole: Bools = faced & (solids != 1)
        if finer:
            whole |= faced & [part.name in finer for part in self._parts]
        reach = CONTACT * deflection
        near = whole.copy()
        if np.count_nonzero(faced) > 1:
            corners, _ = self._placed
            near[faced] |= _kernel.boxes_near(corners[faced], reach)
        touching: Ints = np.zeros(len(self._parts), np.int32)
        fine, touching[near] = self._part_tessellator.faces_near(
            self._used_numbers[near], self._places[near], whole[near], reach
        )
        return fine, touching

    def _surface_parts(self) -> frozenset[str]:
        """The names of parts that are faces outside all solids."""
        return frozenset(info.name for info in self.infos() if info.faces and not info.solids)


def _precisions(tables: _kernel.PartTables) -> Floats:
    """(p,) coordinate precision of parts that a file stores as triangles alone; 0 for all others."""
    out = np.zeros(len(tables))
    if tables.brep_parts == len(tables):
        return out
    for i in np.flatnonzero(~tables.brep).tolist():
        a, b = tables.point_start[i : i + 2]
        out[i] = coordinate_precision(tables.points[a:b])
    return out
