"""A section of one mesh in which a ring stands around a body that has a hollow.

The box of the ring has room for the hollow, and the ring may be the smaller of the two. The hollow was counted as the
ring's own. So the body was cut as if it were full, and false lines ran from its hollow to the ring.
"""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from support.sections import measured_area, section

RADIUS, HEIGHT = 10.0, 20.0
HOLLOW, HOLLOW_HEIGHT = 5.0, 10.0
INNER, OUTER, RING_HEIGHT = 10.5, 11.0, 30.0


def bodies():
    hollow = trimesh.creation.cylinder(HOLLOW, HOLLOW_HEIGHT, sections=48)
    hollow.invert()
    ring = trimesh.creation.annulus(INNER, OUTER, RING_HEIGHT, sections=48)
    return [trimesh.creation.cylinder(RADIUS, HEIGHT, sections=48), hollow, ring]


def lines_of(*meshes):
    whole = trimesh.util.concatenate(meshes)
    drawing = section((np.asarray(whole.vertices), np.asarray(whole.faces)), "front", 0.0)
    return drawing, [line for line in drawing.visible if line.kind != "hatch"]


def length(polylines):
    return sum(np.linalg.norm(np.diff(points, axis=0), axis=1).sum() for points in polylines)


@pytest.mark.parametrize("order", [(0, 1, 2), (2, 1, 0), (1, 2, 0)])
def test_each_cut_face_has_its_own_border(order):
    drum, hollow, ring = bodies()
    drawing, lines = lines_of(*(bodies()[k] for k in order))
    alone = [line.points for meshes in ((drum, hollow), (ring,)) for line in lines_of(*meshes)[1]]
    assert length(line.points for line in lines) == pytest.approx(length(alone), rel=1e-6)
    area = 2 * RADIUS * HEIGHT - 2 * HOLLOW * HOLLOW_HEIGHT + 2 * (OUTER - INNER) * RING_HEIGHT
    assert measured_area(drawing) == pytest.approx(area, rel=0.1)
