"""A shaft in a bore of its own radius, both meshes of coarse facets that are turned against one another, and an arm on
the shaft that goes through the ring.

Facets of shaft and bore cross along the whole ring, at seventy places, by little and at small angles: that is no line.
The arm really passes through both ends of the ring, and its lines lead to the rims of the bore: so these are certain,
and the crossings between them looked like gaps in a line that runs from rim to rim.
"""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

import hlr
from support.at_size import AT_SIZE

RADIUS, LENGTH, FACETS = 26.0, 8.0, 36


def cylinder(radius: float, height: float, turn: float = 0.0) -> trimesh.Trimesh:
    found = trimesh.creation.cylinder(radius, height, sections=FACETS)
    return found.apply_transform(trimesh.transformations.rotation_matrix(turn, (0, 0, 1)))


def scene() -> dict[str, trimesh.Trimesh]:
    arm = trimesh.creation.box((38, 6, 22)).apply_translation((19, 0, 0))
    shaft = trimesh.boolean.union([cylinder(RADIUS, 60.0), arm], engine="manifold")
    bore = cylinder(RADIUS, 3 * LENGTH, np.pi / FACETS)
    ring = trimesh.boolean.difference([cylinder(32.0, LENGTH), bore], engine="manifold")
    return {"shaft": shaft, "ring": ring}


@pytest.mark.parametrize("turn", [0.0, 0.4])
def test_facets_that_cross_along_the_bore_are_no_line(turn):
    parts = scene()
    whole = trimesh.transformations.rotation_matrix(turn, (1, 2, 0.5))
    both = trimesh.Scene({name: mesh.apply_transform(whole) for name, mesh in parts.items()})
    drawing = hlr.draw(both, "iso", **AT_SIZE)
    back = np.linalg.inv(whole)
    along, across = 0.0, 0.0
    for line in drawing.lines:
        if line.kind != "intersection":
            continue
        points = trimesh.transform_points(line.points3, back)
        steps = np.diff(points, axis=0)
        at_wall = np.abs(np.hypot(points[:-1, 0], points[:-1, 1]) - RADIUS) < 0.2
        beside_arm = (points[:-1, 0] > 0) & (np.abs(points[:-1, 1]) < 3.3)
        along += np.abs(steps[at_wall & ~beside_arm, 2]).sum()
        across += np.hypot(steps[:, 0], steps[:, 1])[~at_wall].sum()
    assert along < 0.1 * LENGTH
    assert across > 0.0
