"""Pockets cut through a fillet, in a part that lies askew: their floors end at the fillet, all in one straight line.

The mesher joins corners of several pockets by one long chord of the fillet's border. The triangles that are filled in
beside it are as high as the coordinates are exact; once rounded, they may lie in front of the edges of the floors.
They hide nothing: each edge is visible from end to end.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr

POCKETS, WIDTH, FLOOR, RADIUS = 5, 4.9375, 1.4, 2.5
BACK = RADIUS - np.sqrt(RADIUS**2 - (RADIUS - FLOOR) ** 2)
"""How far behind the front the fillet is at the height of the floors."""
AXIS, ANGLE = np.array([1.0, 2.0, 3.0]) / np.sqrt(14.0), np.radians(33.3)
CROSS = np.array([[0, -AXIS[2], AXIS[1]], [AXIS[2], 0, -AXIS[0]], [-AXIS[1], AXIS[0], 0]])
TURN = np.eye(3) + np.sin(ANGLE) * CROSS + (1.0 - np.cos(ANGLE)) * CROSS @ CROSS
SHIFT = np.array([3.3, 7.7, -1.1])


@pytest.fixture(scope="module")
def comb(tmp_path_factory):
    body = cq.Workplane().box(60, 20, 20, centered=(True, False, False)).edges("|X and <Y and <Z").fillet(RADIUS)
    for i in range(POCKETS):
        pocket = cq.Workplane().box(WIDTH, 2.4, 30, centered=False).translate((7.9375 * i - 25, 0, FLOOR))
        body = body.cut(pocket)
    path = tmp_path_factory.mktemp("comb") / "comb.brep"
    body.translate(tuple(SHIFT)).rotate((0, 0, 0), (1, 2, 3), 33.3).val().exportBrep(str(path))
    return path


@pytest.mark.parametrize("view", [(0.3, -0.8, 0.5), (0.2, -1, 0.4), (0.5, -0.7, 0.3)])
@pytest.mark.parametrize("scale", [1.0, 3.0, 7.7, 10.0])
def test_the_floors_end_in_visible_edges(comb, view, scale):
    drawing = hlr.draw(comb, tuple(TURN @ view), scale=scale, hidden=True, smooth=False)
    lines = [(line, line.points3 @ TURN - SHIFT) for line in drawing.lines]
    on_edge = [(line, p) for line, p in lines if (np.abs(p[:, 1:] - [BACK, FLOOR]) < 1e-4).all()]
    seen = sum(float(np.ptp(p[:, 0])) for line, p in on_edge if line.visible)
    assert seen == pytest.approx(POCKETS * WIDTH, abs=0.05)
    assert all(line.visible for line, _ in on_edge)
