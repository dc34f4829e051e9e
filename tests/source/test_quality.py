"""How fine the meshes of curved faces are: within the chord error, and not much finer than it calls for."""

from __future__ import annotations

import math

import numpy as np
import pytest
from source.samples import samples

from hlr.source import open_source

cq = pytest.importorskip("cadquery")

FACES = {
    "sphere": (lambda: cq.Solid.makeSphere(10), lambda p: np.linalg.norm(p, axis=1) - 10),
    "torus": (
        lambda: cq.Solid.makeTorus(10, 3),
        lambda p: np.hypot(np.hypot(p[:, 0], p[:, 1]) - 10, p[:, 2]) - 3,
    ),
    "placed": (
        lambda: cq.Solid.makeSphere(10).moved(cq.Location((50, 0, 7), (1, 1, 0), 40)),
        lambda p: np.linalg.norm(p - (50, 0, 7), axis=1) - 10,
    ),
    "half": (
        lambda: cq.Solid.makeSphere(10, angleDegrees1=0).Faces()[0],
        lambda p: np.linalg.norm(p, axis=1) - 10,
    ),
}


@pytest.mark.slow
@pytest.mark.parametrize("deflection", [0.3, 0.02, 0.003])
@pytest.mark.parametrize("name", FACES)
def test_the_chord_error_is_kept(name, deflection):
    make, off = FACES[name]
    (part,) = open_source(make()).mesh(deflection, 0.8).parts
    curved = part.triangles[~part.face_planar[part.triangle_face]]
    assert np.abs(off(part.points[np.unique(curved)])).max() < 1e-6
    assert np.abs(off(samples(part.points, curved))).max() <= deflection * (1 + 1e-9)


def test_flat_and_straight_things_take_no_more_triangles_than_their_corners_call_for():
    (box,) = open_source(cq.Workplane().box(3, 4, 5)).mesh(0.01, 0.3).parts
    assert len(box.triangles) == 12
    (rod,) = open_source(cq.Solid.makeCylinder(10, 50)).mesh(0.05, 0.8).parts
    # Two discs and the side, in chords of the circle: nothing along the axis.
    rim = len(np.unique(rod.edge_nodes[: rod.edge_offsets[1]]))
    assert len(rod.triangles) <= 4 * rim


@pytest.mark.parametrize("deflection", [0.1, 0.01, 0.001])
def test_a_sphere_takes_few_triangles(deflection):
    """Where triangles have the error of their circumscribed circle, 3 sqrt(3) / 4 of its square are an area each."""
    (part,) = open_source(cq.Solid.makeSphere(10)).mesh(deflection, 1.0).parts
    # Half the deflection goes into the distance of two surfaces that touch.
    circle2 = 2 * 10 * deflection / 2
    least = 4 * math.pi * 100 / (0.75 * math.sqrt(3) * circle2)
    assert len(part.triangles) < 3 * least
