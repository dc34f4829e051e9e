"""From roots to part meshes: the kernel reads and meshes OpenCASCADE's dump; what fails goes back to OpenCASCADE."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hlr import _kernel
from hlr.common.types import Ints, Progress
from hlr.request.accuracy import EACH_SURFACE
from hlr.source.cad.meshing_faults import MeshingFaults
from hlr.source.cad.prototypes import Prototypes
from hlr.source.cad.rescue import faces_of, rescue
from hlr.source.model import Curves, SurfaceRecords

FLAT = 1e-7
"""A free-form surface is planar where it departs from a plane by less than this share of the model's size."""

MOST_TRIES = 200
"""After so many faces that could not be rescued, a few milliseconds each, the others are given up, too."""


class Tessellator:
    """Meshes roots (shapes without placement), each underlying face once. The shapes stay as they are."""

    def __init__(self, roots: Prototypes, chosen: Sequence[int], size: float) -> None:
        """chosen: numbers of the roots that are meshed, ascending; size: the model's diagonal, to judge planarity."""
        self._roots, self._chosen = roots, chosen
        self._model = roots.model_of(chosen)
        self._planar = self._model.planar(FLAT * size)

    def mesh(
        self, deflection: float, angle: float, progress: Progress | None = None
    ) -> tuple[_kernel.PartTables, MeshingFaults]:
        """The roots at this chord error and turning angle (radians), and what failed."""
        if progress is not None:
            progress("tessellate", 0.0)
        tell = None if progress is None else lambda done: progress("tessellate", done)
        meshed = self._model.mesh(EACH_SURFACE * deflection, angle, tell)
        faults = self._rescued(meshed, deflection, angle)
        if progress is not None:
            progress("tessellate", 1.0)
        return meshed.parts(self._planar), faults

    def _rescued(self, meshed: _kernel.BrepMesh, deflection: float, angle: float) -> MeshingFaults:
        """What became of the faces that the kernel could not mesh."""
        failed = {number for number, _ in meshed.faults()}
        faults = MeshingFaults(turned=[number for number, _ in meshed.turned()])
        if not failed:
            return faults
        # Of the shapes as they were dumped: a model out of the cache has no others, and is to give the same triangles.
        shapes = self._roots.read_back
        faces = faces_of([shapes[number] for number in self._chosen], failed)
        for number, face in sorted(faces.items()):
            hopeless = len(faults.lost) >= MOST_TRIES
            if not hopeless and rescue(meshed, number, face, deflection, angle):
                faults.rescued.append(number)
            else:
                faults.lost.append(number)
        return faults

    def records(self, numbers: Sequence[int]) -> SurfaceRecords:
        """The surfaces of the underlying faces with these numbers, in this order."""
        return SurfaceRecords(*self._model.surface_records(np.asarray(numbers, np.int32)))

    def spindles(self) -> list[tuple[int, float, float]]:
        """Faces on tori whose tube reaches beyond their axis: number, major and minor radius."""
        return self._model.spindles()

    def edge_curves(self, roots: Ints, edges: Ints) -> Curves:
        """Curves of edges (m,) in the TopExp edge maps of roots (m,)."""
        return Curves(*self._model.edge_curves(roots, edges))
