"""Two bars that cross, an octagon and a polygon of sixteen sides that is nearly as thick, as meshes.

Where the bars touch most nearly, their facets are almost parallel: there the line runs along a facet, square to the
pieces that lead to it on both sides. These pieces run in steps, too, and come from where the line goes on.
"""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

import hlr
from support.at_size import AT_SIZE

SIDES, RADIUS = 8, 10.0


def bars() -> tuple[trimesh.Trimesh, trimesh.Trimesh]:
    turned = trimesh.transformations.rotation_matrix
    one = trimesh.creation.cylinder(RADIUS, 60.0, sections=SIDES)
    two = trimesh.creation.cylinder(0.99 * RADIUS, 60.0, sections=2 * SIDES)
    return one.apply_transform(turned(np.pi / SIDES, (0, 0, 1))), two.apply_transform(turned(np.pi / 2, (1, 0, 0)))


def length_along_facets(two: trimesh.Trimesh) -> float:
    """Where the facets of the octagon, planes of a certain width, cut the other bar."""
    found = 0.0
    for k in range(SIDES):
        angle = 2 * np.pi * k / SIDES
        normal, along = np.array([[np.cos(angle), np.sin(angle), 0.0], [-np.sin(angle), np.cos(angle), 0.0]])
        at, half = RADIUS * np.cos(np.pi / SIDES) * normal, RADIUS * np.sin(np.pi / SIDES)
        for segment in trimesh.intersections.mesh_plane(two, normal, at):
            low, high = sorted(segment @ along)
            inside = max(0.0, min(high, half) - max(low, -half))
            share = inside / (high - low) if high > low else float(abs(low) < half)
            found += share * float(np.linalg.norm(segment[1] - segment[0]))
    return found


@pytest.mark.parametrize("turn", [0.4, 0.8])
def test_the_line_has_no_gaps(turn):
    one, two = bars()
    whole = trimesh.transformations.rotation_matrix(turn, (1, 2, 0.5))
    scene = trimesh.Scene({"one": one.copy().apply_transform(whole), "two": two.copy().apply_transform(whole)})
    lines = [line.points3 for line in hlr.draw(scene, "iso", **AT_SIZE).lines if line.kind == "intersection"]
    drawn = sum(float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum()) for points in lines)
    assert drawn == pytest.approx(length_along_facets(two), rel=0.02)
