"""A ball sunk into a plate by little: the finer its mesh, the less each of its triangles goes through the plate.

At small angles the depth was measured at the triangles' own corners. So a ball of 5 mm that is sunk by 0.1 mm had its
circle as a mesh of 1,280 triangles, and none as one of 5,120 or 81,920.
"""

from __future__ import annotations

import math

import pytest
import trimesh

import hlr
from support.at_size import AT_SIZE

RADIUS, SUNK = 5.0, 0.1


@pytest.mark.parametrize("halved", [3, 4, 5, 6])
@pytest.mark.parametrize("size", [0.01, 1.0, 1000.0])
def test_a_ball_has_its_circle_however_fine_its_mesh_is(halved: int, size: float) -> None:
    ball = trimesh.creation.icosphere(halved, RADIUS)
    ball.apply_translation((0.01, 0.02, RADIUS - SUNK))
    plate = trimesh.creation.box((30, 30, 10))
    plate.apply_translation((0, 0, -5))
    for mesh in (ball, plate):
        mesh.apply_scale(size)
    options = {**AT_SIZE, "scale": 1.0 / size, "accuracy": 0.02}
    drawn = hlr.draw(trimesh.Scene([ball, plate]), view="top", **options).lines
    circle = 2 * math.pi * math.sqrt(RADIUS**2 - (RADIUS - SUNK) ** 2)
    length = sum(line.length_mm for line in drawn if line.kind == "intersection")
    assert length == pytest.approx(circle, rel=0.1)
