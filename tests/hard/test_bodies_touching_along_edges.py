"""Closed bodies of one mesh touch along an edge only: four triangles meet there, and which belong together is open.

(cycloidal.ply of trimesh: 242 such edges, rolling bodies standing in the corners of others.) It is closed all the
same, so nothing shows through, and the common edge is drawn once.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import agrees, by_oracle, defects, of_kind
from support.meshes import BOX_EDGES, box, merged

LOW, HIGH = ((0, 0, 0), (10, 10, 10)), ((10, 10, 0), (18, 16, 10))
"""They share the upright edge at (10, 10)."""


def model(welded):
    points, triangles = merged(box(*LOW), box(*HIGH))
    if welded:
        points, number = np.unique(points, axis=0, return_inverse=True)
        triangles = number.ravel()[triangles].astype(np.int32)
    return points, triangles


@pytest.mark.parametrize("welded", [True, False])
@pytest.mark.parametrize("view", ["iso", "front", (1, -2, 1.5), (-1, 0.4, -0.5)])
def test_the_common_edge_is_there_once(view, welded, picture):
    drawing = hlr.draw(model(welded), view, **AT_SIZE)
    points, triangles = merged(box(*LOW), box(*HIGH))
    edges = [(i + k, j + k) for k in (0, 8) for i, j in BOX_EDGES]
    agrees(drawing, by_oracle(drawing, points, triangles, edges))
    common = [line for line in of_kind(drawing, "sharp") if np.ptp(line.points3, axis=0)[2] > 1]
    assert sum(abs(line.points3[:, :2] - 10).max() < 1e-6 for line in common) <= 2
    if view == "iso":
        picture(drawing)


def test_the_defect_is_named():
    (defect,) = defects(model(True))
    assert defect.startswith("1 non-manifold edge")
