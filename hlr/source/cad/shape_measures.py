"""How far one shape of OpenCASCADE reaches, and its volume, by the kernel: OpenCASCADE may take a second for either."""

from __future__ import annotations

from typing import Any

import numpy as np

from hlr import _kernel
from hlr.common.types import Floats
from hlr.request.options import Vector
from hlr.source.cad.cut_check import volume as exact_volume
from hlr.source.cad.prototypes import LivePrototypes
from hlr.source.cad.shapes import location_matrix, with_location

COARSE = 0.01
"""Of the size of a shape: chord error of the mesh whose volume is taken."""

ANGLE = 0.5
"""Radians from chord to chord of that mesh."""


class ShapeMeasures:
    """Measures of a shape, which stays as it is. The kernel reads it once.

    Raises:
        ValueError: the kernel cannot read it.
    """

    def __init__(self, shape: Any) -> None:
        self._place = np.array(location_matrix(shape.Location()), np.float64).reshape(1, 3, 4)
        self._model: _kernel.BrepModel = LivePrototypes([with_location(shape, None)]).model

    def extent(self, x: Vector, y: Vector, z: Vector) -> Floats | None:
        """(2, 3) from where to where the shape reaches along directions of length 1; None where it has no points."""
        box = self._model.boxes()[0]
        if bool((box[0] > box[1]).any()):
            return None
        part = np.zeros(1, np.int32)
        ends = [*self._model.reach(part, self._place, x, y), self._model.reach(part, self._place, z, x)[0]]
        return np.array(ends).T

    def volume(self) -> float | None:
        """That of a mesh, negative where the shape is turned inside out; None where a face has no mesh."""
        box = self._model.boxes()[0]
        mesh = self._model.mesh(COARSE * float(np.linalg.norm(box[1] - box[0])), ANGLE)
        if mesh.faults():
            return None
        tables = mesh.parts(np.zeros(self._model.n_faces, np.bool_))
        a, b, c = np.moveaxis(tables.points[tables.triangles] - box.mean(axis=0), 1, 0)
        return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum()) / 6.0


def is_inside_out(solid: Any) -> bool:
    """Whether the volume of a solid is negative."""
    volume = ShapeMeasures(solid).volume()
    return (exact_volume(solid) if volume is None else volume) < 0.0
