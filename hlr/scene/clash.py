"""Interpenetration: intersection lines of parts, and solids that intersect themselves.

Triangles of surfaces that only touch cross here and there, because tessellation and files round. The depth decides: a
connected set of segments is an intersection where at least one of its triangles reaches beyond the other's plane, on
both sides, by more than the accuracy: two fifths of the contact tolerance. Facets of meshes at small angles have to
reach farther, by all of it. Planar faces have no chord error: next to nothing is forgiven there.

::

        \\   /            ___________      a shaft in a bore of the same radius: the facets cross,
         \\ /  real       ‾‾‾\\_/‾‾‾\\_/‾     by less than the deflection, at small angles
          X
         / \\
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hlr._kernel import Groups, MeshScene
from hlr.common.types import Floats, Ints
from hlr.request.accuracy import CONTACT, CONTACT_PLANAR, MESH_CONTACT


@dataclass(frozen=True, slots=True)
class Clashes:
    """Segments of intersection lines.

    points   (n, 3)
    edges    (m, 2) into points
    group    (m, 2) the two groups of each edge, the lower first
    triangle (m, 2) a triangle of each of these groups that the edge lies on
    shallow  (m,) bool: along the whole line of the edge one surface is nowhere deep in the other
    through  (g,) bool: the group intersects itself
    """

    points: Floats
    edges: Ints
    group: Ints
    triangle: Ints
    shallow: npt.NDArray[np.bool_]
    through: npt.NDArray[np.bool_]
    tests: int
    """Pairs of triangles that were tested."""


def find_clashes(found: MeshScene, groups: Groups, deflection: float) -> Clashes:
    """All intersections between groups, and of groups with themselves. deflection: model units."""
    contact = CONTACT * deflection, CONTACT_PLANAR * deflection, MESH_CONTACT
    return Clashes(*found.crossings(groups, contact, deflection))


def self_intersecting_parts(met: Clashes, part_of_group: Ints) -> set[int]:
    """Indices of the parts that intersect themselves."""
    a, b = part_of_group[met.group[:, 0]], part_of_group[met.group[:, 1]]
    return {*a[a == b].tolist(), *part_of_group[met.through].tolist()}
