"""Sections of meshes where the plane meets the surface at a small angle: near the pole of a ball, along a shaft's wall.

There the cut face and the surface fold by less than the crease angle. The cut face was hatched, but had no border.
"""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

import hlr
from support.at_size import AT_SIZE

RADIUS = 20.0


def border(mesh: trimesh.Trimesh, section: object) -> float:
    """The length of the sharp visible lines on the plane y = `section`, or on its steps."""
    drawing = hlr.draw(mesh, "front", section=section, **AT_SIZE)
    assert not drawing.notes
    assert any(line.kind == "hatch" for line in drawing.lines)
    return sum(line.length_mm for line in drawing.lines if line.kind == "sharp" and line.visible)


@pytest.mark.parametrize("depth", [0.5, 2.0, 5.0, 15.0])
def test_a_ball_near_its_pole(depth: float) -> None:
    radius = np.sqrt(RADIUS**2 - (RADIUS - depth) ** 2)
    found = border(trimesh.creation.icosphere(5, RADIUS), depth - RADIUS)
    assert found == pytest.approx(2 * np.pi * radius, rel=0.01)


@pytest.mark.parametrize("depth", [0.3, 1.0, 4.0])
def test_a_shaft_along_its_wall(depth: float) -> None:
    shaft = trimesh.creation.cylinder(RADIUS, 60.0, sections=180)
    width = 2 * np.sqrt(RADIUS**2 - (RADIUS - depth) ** 2)
    # The border of the cut face, and the rims at both ends beside it.
    assert border(shaft, depth - RADIUS) == pytest.approx(2 * (60.0 + 2 * RADIUS), rel=0.01)
    found = hlr.draw(shaft, "front", section=depth - RADIUS, **AT_SIZE)
    walls = [line for line in found.visible if line.kind == "sharp" and np.ptp(line.points[:, 0]) < 1e-6]
    assert sum(line.length_mm for line in walls) == pytest.approx(120.0, rel=0.01)
    assert np.ptp([line.points[0, 0] for line in walls]) == pytest.approx(width, abs=0.05)


def test_steps_have_borders_too() -> None:
    drawing = hlr.draw(trimesh.creation.icosphere(5, RADIUS), "front", section=(-19.0, (0.0, -18.0)), **AT_SIZE)
    arcs = [line for line in drawing.visible if line.kind == "sharp" and np.ptp(line.points[:, 0]) > 1.0]
    # Half of each circle; what runs along the step is no arc.
    wanted = np.pi * sum(np.sqrt(RADIUS**2 - y**2) for y in (19.0, 18.0))
    assert sum(line.length_mm for line in arcs) == pytest.approx(wanted, abs=0.2)
