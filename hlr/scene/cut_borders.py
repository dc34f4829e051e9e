"""The borders of cut faces of meshes: lines, at whatever angle the plane of a section meets the surface."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from hlr._kernel import MeshFacts
from hlr.common.types import Floats, Ints
from hlr.scene.scene_parts import OnCut

LEVEL = math.cos(math.radians(0.1))
"""The cosine of a fold below which two triangles lie in one plane."""


def cut_borders(
    mesh: MeshFacts, points: Floats, triangles: Ints, of_mesh: npt.NDArray[np.bool_], on_cut: OnCut
) -> npt.NDArray[np.intp]:
    """The edges of `mesh` between a triangle on the plane of a section and one beside it, ascending.

    A ball cut near its pole is met at a small angle: by their fold alone these edges would be no creases.

    points (n, 3); triangles (t, 3); of_mesh (e,): whether an edge is of a part without B-rep
    """
    on = on_cut(points)
    flat = np.asarray(on[triangles].all(axis=1), np.bool_)
    first = mesh.offsets[:-1]
    # The wall at a step has triangles with all corners on the planes, beside others in one plane with them.
    two = np.flatnonzero((np.diff(mesh.offsets) == 2) & of_mesh & (mesh.fold < LEVEL))
    beside = np.stack([mesh.incident[first[two]], mesh.incident[first[two] + 1]])
    return np.asarray(two[flat[beside[0]] != flat[beside[1]]])
