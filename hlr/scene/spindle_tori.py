"""Spindle tori, whose tube reaches beyond the axis: such a surface intersects itself at two points of the axis.

The triangles need not show it; the parameters of the surface do.

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
"""Share of the minor radius within which a point counts as on the axis."""


def self_intersecting_tori(whole: PartMeshes, found: MeshScene) -> npt.NDArray[np.bool_]:
    """(g,) bool: the group has a torus face that lies on both sides of the axis."""
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
