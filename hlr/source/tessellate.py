"""OpenCASCADE's mesher, and the way from its result to arrays."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from typing import Any

import numpy as np

from hlr.notes import Note
from hlr.source.delabella import treacherous, without
from hlr.source.dump import DumpError, read_dump
from hlr.source.faults import Faults
from hlr.source.filled import unfilled
from hlr.source.freeform import FreeEdges, is_free, with_nodes
from hlr.source.mesher import run_mesher
from hlr.source.model import Ints, Progress
from hlr.source.outlines import periods
from hlr.source.parts import compound, explored
from hlr.source.quality import FINE, coarse_faces, edge_pairs, lapped_faces, tightened
from hlr.source.refine import refine
from hlr.source.rescue import rescue
from hlr.source.surfaces import FaceSurfaces
from hlr.source.tables import FACE, Tables
from hlr.source.topology import Meshes, build

BATCH_FACES = 3000
"""So many faces are meshed in one call: enough to fill the cores, few enough to report progress in between."""

MOST_TRIES = 200
"""After so many faces that could not be rescued, a few milliseconds each, the others are given up, too."""

FLAT = 1e-7
"""A free-form surface is planar where it departs from a plane by less than this share of the model's size."""


class Tessellator:
    """Meshes a list of roots (shapes without placement), each underlying face once."""

    def __init__(self, roots: list[Any], size: float) -> None:
        """`size`: the model's diagonal, to judge planarity."""
        from OCP.TopAbs import TopAbs_ShapeEnum as Kind
        from OCP.TopoDS import TopoDS

        self._roots = roots
        self._faces: list[Any] = []
        self._flat: list[bool] = []
        self._batches: list[list[int]] = [[]]
        self._number: dict[Any, int] = {}
        filled = 0
        for number, root in enumerate(roots):
            faces = explored(root, Kind.TopAbs_FACE)
            if filled and filled + len(faces) > BATCH_FACES:
                self._batches.append([])
                filled = 0
            self._batches[-1].append(number)
            filled += len(faces)
            for face in faces:
                underlying = face.TShape()
                if underlying not in self._number:
                    self._number[underlying] = len(self._faces)
                    self._faces.append(TopoDS.Face(face))
        self._flat = [_is_flat(face, FLAT * size) for face in self._faces]
        self.surfaces = FaceSurfaces(self._faces)
        self._free_edges: FreeEdges | None = None
        self.faults = Faults()
        straight = (np.inf, np.inf)
        turning = [straight if flat else periods(f) for f, flat in zip(self._faces, self._flat, strict=True)]
        self._periods = np.array(turning).reshape(-1, 2)
        kept = zip(self._faces, self._flat, strict=True)
        self._kept_back = {face.TShape() for face, flat in kept if flat and treacherous(face)}

    def mesh(self, deflection: float, angle: float, progress: Progress | None = None) -> tuple[Meshes, list[Note]]:
        """All roots at this chord error and turning angle (radians), and notes on what failed."""
        if self._free_edges is None:
            free = [not flat and is_free(face) for face, flat in zip(self._faces, self._flat, strict=True)]
            self._free_edges = FreeEdges.compared(self._roots, self._number, free, self.surfaces)
        with with_nodes(self._free_edges.uneven):
            return self._mesh(self._free_edges, deflection, angle, progress)

    def _mesh(
        self, free_edges: FreeEdges, deflection: float, angle: float, progress: Progress | None
    ) -> tuple[Meshes, list[Note]]:
        from OCP.BRepTools import BRepTools

        notes: list[Note] = []
        # A triangulation from earlier, ours or the caller's, would be kept where it is finer: the result would depend
        # on history. Faces that are nothing but a triangulation keep it.
        everything = compound(self._roots)
        BRepTools.Clean_s(everything)
        for done, batch in enumerate(self._batches):
            if progress is not None:
                progress("tessellate", done / len(self._batches))
            for failed in self._mesh_batch(batch, deflection, angle):
                notes.append(failed)
        # With their neighbours, so that their common edges keep their polygons.
        self._retry([r for r in self._roots if self._for_delabella(r) is not r], deflection, angle)
        self._retry([self._faces[i] for i in self._lost()], deflection, angle)
        tables, first = self._sound(deflection, angle)
        faces = np.flatnonzero(tables.kind == FACE)[first:]
        planar = np.zeros(len(tables.kind), dtype=bool)
        # The dump lists each underlying face once, in the order in which an explorer meets them: so do we.
        planar[faces] = self._flat
        result = build(tables, planar, free_edges.found)
        result.face_shape -= np.int32(first)
        if progress is not None:
            progress("tessellate", 1.0)
        return result, notes

    def _mesh_batch(self, batch: list[int], deflection: float, angle: float) -> Iterator[Note]:
        try:
            run_mesher(compound([self._for_delabella(self._roots[i]) for i in batch]), deflection, angle)
        except Exception as error:  # OpenCASCADE's exceptions derive from Exception alone
            if len(batch) == 1:
                text = f"Part {batch[0]} could not be meshed completely ({type(error).__name__})."
                yield Note("not-meshed", text)
                return
            for number in batch:
                yield from self._mesh_batch([number], deflection, angle)

    def _for_delabella(self, root: Any) -> Any:
        return without(root, self._kept_back) if self._kept_back else root

    def _tables(self) -> tuple[Tables, int]:
        """Tables of all roots, and how many faces that only carry normals come first."""
        carriers = self._normal_carriers()
        return read_tables(compound([compound(carriers), *self._roots])), len(carriers)

    def _sound(self, deflection: float, angle: float) -> tuple[Tables, int]:
        """The tables of `_tables`, after faces that came out coarse or incomplete were meshed again.

        What is then still empty or incomplete is rescued, and what is left coarse is refined.
        """
        from OCP.BRepTools import BRepTools

        tables, first = self._tables()
        lapped, partly = lapped_faces(tables, deflection), unfilled(tables, deflection, self._periods)
        lost = bool(self._lost())
        self.faults = Faults()
        if not (len(lapped) or len(partly) or lost or len(coarse_faces(tables, deflection, FINE))):
            return tables, first
        again = np.unique(np.concatenate((lapped, partly, coarse_faces(tables, deflection))))
        again = again[again >= first] - first
        if len(again):
            with tightened([self._faces[i] for i in again]) as faces:
                for face in faces:
                    BRepTools.Clean_s(face)
                # With all the others, which keep their triangulation: alone, a face would get edges cut anew.
                self._retry(self._roots, deflection, angle)
            tables, first = self._tables()
        if len(again) or lost:
            self.faults = self._rescued(unfilled(tables, deflection, self._periods) - first, deflection, angle)
            if self.faults.rescued:
                tables, first = self._tables()
        triangulation = tables.face_tri[tables.kind == FACE]
        changed = False
        for i in coarse_faces(tables, deflection, FINE).tolist():
            if i >= first:
                number = int(triangulation[i])
                triangles = tables.triangles[tables.tri_start[number] : tables.tri_start[number + 1]]
                changed |= refine(self._faces[i - first], triangles, edge_pairs(tables, number), deflection)
        return self._tables() if changed else (tables, first)

    def _lost(self) -> list[int]:
        """Numbers of the faces that nothing has triangulated so far."""
        from OCP.BRep import BRep_Tool
        from OCP.TopLoc import TopLoc_Location

        place = TopLoc_Location()
        return [i for i, face in enumerate(self._faces) if BRep_Tool.Triangulation_s(face, place) is None]

    def _rescued(self, partly: Ints, deflection: float, angle: float) -> Faults:
        """What became of the faces that are lost, or filled only in part (numbers), after a last try."""
        faults = Faults()
        for i in sorted({*self._lost(), *partly.tolist()}):
            hopeless = len(faults.lost) + len(faults.unfilled) >= MOST_TRIES
            if not hopeless and rescue(self._faces[i], deflection, angle):
                faults.rescued.append(i)
            elif i in partly:
                faults.unfilled.append(i)
            else:
                faults.lost.append(i)
        return faults

    def _retry(self, shapes: list[Any], deflection: float, angle: float) -> None:
        """What has no triangulation in these shapes goes to the older Watson algorithm; edges keep their polygons."""
        if shapes:
            with suppress(Exception):  # OpenCASCADE's exceptions derive from Exception alone; the faces are counted
                run_mesher(compound(shapes), deflection, angle, delabella=False)

    def _normal_carriers(self) -> list[Any]:
        """Bare faces that make the dump hold surface normals beside the nodes of curved faces.

        The normals tell creases from tangent edges. The dump writes them where a triangulation is first met through a
        face, not where it is first met through an edge: hence faces without edges, ahead of the parts.
        """
        from OCP.BRep import BRep_Builder, BRep_Tool
        from OCP.BRepLib import BRepLib_ToolTriangulatedShape
        from OCP.TopLoc import TopLoc_Location
        from OCP.TopoDS import TopoDS_Face

        place, builder = TopLoc_Location(), BRep_Builder()
        carriers = []
        for face, flat in zip(self._faces, self._flat, strict=True):
            triangulation = None if flat else BRep_Tool.Triangulation_s(face, place)
            if triangulation is not None:
                BRepLib_ToolTriangulatedShape.ComputeNormals_s(face, triangulation)
                carrier = TopoDS_Face()
                builder.MakeFace(carrier, triangulation)
                carriers.append(carrier)
        return carriers


def read_tables(everything: Any) -> Tables:
    """Tables of a meshed compound (normal carriers first, then the roots).

    They come from the dump, or item by item where its layout is not the known one.
    """
    try:
        return read_dump(everything)
    except DumpError:
        from hlr.source.walk import walk

        return walk(everything)


_CURVED = {"Geom_CylindricalSurface", "Geom_ConicalSurface", "Geom_SphericalSurface", "Geom_ToroidalSurface"}


def _is_flat(face: Any, tolerance: float) -> bool:
    from OCP.BRep import BRep_Tool
    from OCP.GeomLib import GeomLib_IsPlanarSurface
    from OCP.TopLoc import TopLoc_Location

    surface = BRep_Tool.Surface_s(face, TopLoc_Location())
    name = type(surface).__name__
    while name == "Geom_RectangularTrimmedSurface":
        surface = surface.BasisSurface()
        name = type(surface).__name__
    if name == "Geom_Plane":
        return True
    if surface is None or name in _CURVED:
        return False
    try:
        return bool(GeomLib_IsPlanarSurface(surface, tolerance).IsPlanar())
    except Exception:  # a surface OpenCASCADE cannot judge is taken as curved
        return False
