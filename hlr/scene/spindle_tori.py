"""Tori whose tube reaches beyond their axis: such a surface passes through itself in two points of the axis.

Triangles show that only where their corners happen to lie well. The surface says it.

::

        __.--.__       the lemon inside belongs to the same face; its outer side is turned inward
      .'   /\\   '.
      |    ||    |
      '.__ \\/ __.'
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from hlr._kernel import MeshScene
from hlr.source.part_meshes import PartMeshes

ROUNDING = 1e-9
"""Of the minor radius: what is no further beyond the axis lies on it."""


def self_intersecting_tori(whole: PartMeshes, found: MeshScene) -> npt.NDArray[np.bool_]:
    """(g,) bool: groups with a face on both sides of the axis of its torus."""
    out = np.zeros(len(found.group_part), bool)
    spindles = () if whole.surfaces is None else whole.surfaces.spindles()
    if not spindles:
        return out
    tables = whole.tables
    face = tables.face_start[found.triangle_part] + tables.triangle_face
    shape = tables.face_shape[face]
    for number, major, minor in spindles:
        of = np.flatnonzero(shape == number)
        v = tables.uv[found.corner[of], 1]
        beyond = major + minor * np.cos(v)
        group = found.triangle_group[of]
        low, high = np.full(len(out), np.inf), np.full(len(out), -np.inf)
        np.minimum.at(low, group, beyond.min(axis=1, initial=np.inf))
        np.maximum.at(high, group, beyond.max(axis=1, initial=-np.inf))
        out |= (low < -ROUNDING * minor) & (high > ROUNDING * minor)
    return out
