"""Tessellation of prototypes by the kernel; faces that it cannot mesh are meshed by OpenCASCADE, else mended.

OpenCASCADE is not asked for a face that took all the steps it may take: its mesher may work on it for minutes, and
cannot be interrupted.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from hlr import _kernel
from hlr.common.types import Bools, Floats, Ints, Progress
from hlr.request.accuracy import ALONE, TOUCHING
from hlr.request.options import Vector
from hlr.source.cad.meshing_faults import MeshingFaults
from hlr.source.cad.prototypes import Prototypes
from hlr.source.cad.rescue import rescue, smallest_deflection
from hlr.source.model import Curves, SurfaceRecords

PLANARITY_SHARE = 1e-7
"""Share of the model's diagonal: a free-form surface that departs from a plane by less is planar."""

MAX_FAILED_RESCUES = 200
"""After this number of failed rescues, a few milliseconds each, all remaining faces count as lost."""


class Tessellator:
    """Tessellates prototypes (shapes without placement), each underlying face once. The shapes are not changed."""

    def __init__(self, prototypes: Prototypes, chosen: Sequence[int], size: float) -> None:
        """Args: chosen: ascending indices of the prototypes to mesh; size: the model's diagonal, to judge planarity."""
        self._prototypes, self._chosen = prototypes, chosen
        self._model = prototypes.model_of(chosen)
        self._planar = self._model.planar(PLANARITY_SHARE * size)

    def mesh(
        self, deflection: float, angle: float, fine: Bools, progress: Progress | None = None
    ) -> tuple[_kernel.PartTables, MeshingFaults]:
        """Meshes of the prototypes, and the faces that failed. deflection: model units; angle: turning, radians.

        fine: of each underlying face, whether it may touch another part somewhere
        """
        if progress is not None:
            progress("tessellate", 0.0)
        report = None if progress is None else lambda done: progress("tessellate", done)
        meshed = self._model.mesh(ALONE * deflection, angle, report, np.where(fine, TOUCHING / ALONE, 1.0))
        faults = self._rescue_failed(meshed, deflection, angle)
        faults.folded = self._model.folded()
        # Two faces that meet at an edge may be twice as far apart: that is the accuracy.
        faults.off = dict(meshed.off_their_edges(deflection))
        if progress is not None:
            progress("tessellate", 1.0)
        return meshed.parts(self._planar), faults

    def _rescue_failed(self, meshed: _kernel.BrepMesh, deflection: float, angle: float) -> MeshingFaults:
        """Mesh the faces that the kernel could not: with OpenCASCADE, and else what their crossing loops enclose."""
        if meshed.is_sound():
            return MeshingFaults()
        faults = MeshingFaults(turned=[number for number, _ in meshed.turned()])
        given_up = [number for number, off in meshed.unfinished() if math.isinf(off)]
        failed = {number for number, _ in meshed.faults()}.difference(given_up)
        if failed:
            self._rescue(meshed, failed, faults, deflection, angle)
        faults.lost += given_up
        # Of the crossing loops as well.
        faults.torn = dict(meshed.torn())
        faults.unfinished |= {number: off for number, off in meshed.unfinished() if math.isfinite(off)}
        return faults

    def _rescue(
        self, meshed: _kernel.BrepMesh, failed: set[int], faults: MeshingFaults, deflection: float, angle: float
    ) -> None:
        faces = self._prototypes.failed_faces(self._chosen, failed)
        for number, face in sorted(faces.items(), key=lambda item: item[0]):
            give_up = len(faults.lost) >= MAX_FAILED_RESCUES
            possible = 0.0 if give_up or face is None else max(deflection, smallest_deflection(face))
            if possible and rescue(meshed, number, face, possible, angle):
                faults.rescued.append(number)
                if possible > deflection:
                    faults.unfinished[number] = possible
            elif not give_up and meshed.fill(number, deflection, angle):
                faults.crossed.append(number)
            else:
                faults.lost.append(number)

    def records(self, numbers: Sequence[int]) -> SurfaceRecords:
        """The surfaces of the underlying faces with these numbers, in this order."""
        return SurfaceRecords(*self._model.surface_records(np.asarray(numbers, np.int32)))

    def spindles(self) -> list[tuple[int, float, float]]:
        """Faces on tori whose tube reaches beyond their axis: number, major and minor radius."""
        return self._model.spindles()

    def reach(self, prototypes: Ints, places: Floats, right: Vector, up: Vector) -> Floats:
        """As of `BrepSource`: of prototypes, numbers (n,) among the chosen, that stand at `places` (n, 4, 4)."""
        return self._model.reach(prototypes, np.ascontiguousarray(places[:, :3]), right, up)

    def faces_near(self, prototypes: Ints, places: Floats, whole: Bools, reach: float) -> tuple[Bools, Ints]:
        """Which underlying faces come near another part, and (n,) how many faces of each part; all, of those `whole`.

        prototypes: (n,) numbers among the chosen, of parts that stand at `places` (n, 4, 4)
        """
        return _kernel.faces_near(self._model, prototypes, np.ascontiguousarray(places[:, :3]), whole, reach)

    def is_one_sphere(self) -> bool:
        """Whether the prototypes are one, and that one whole sphere."""
        return self._model.is_one_sphere()

    def edge_curves(self, prototypes: Ints, edges: Ints) -> Curves:
        """Curves of edges: (m,) prototypes, and (m,) indices in their TopExp edge maps."""
        return Curves(*self._model.edge_curves(prototypes, edges))
