"""How far shapes reach, and their volumes, beside what is known of cylinders, balls and boxes."""

from __future__ import annotations

import math

import cadquery as cq
import numpy as np
import pytest

from hlr.source.cad.shape_measures import ShapeMeasures, is_inside_out

AXES = np.array([[0.6, 0.0, 0.8], [0.0, 1.0, 0.0], [-0.8, 0.0, 0.6]])


def placed(shape):
    return shape.moved(cq.Location((1.0, 2.0, 3.0), (0, 0, 1), 90.0)).wrapped


def test_a_placed_cylinder_reaches_as_far_as_its_rims():
    extent = ShapeMeasures(placed(cq.Solid.makeCylinder(2.0, 5.0))).extent(*AXES.tolist())
    middle = AXES @ np.array([1.0, 2.0, 5.5])
    half = np.abs(AXES[:, 2]) * 2.5 + 2.0 * np.hypot(AXES[:, 0], AXES[:, 1])
    assert np.allclose(extent, [middle - half, middle + half], rtol=0.0, atol=1e-12)


def test_edges_without_faces_reach_and_nothing_reaches_nowhere():
    wire = cq.Edge.makeLine(cq.Vector(0, 0, 0), cq.Vector(3, 0, 4)).wrapped
    assert np.allclose(ShapeMeasures(wire).extent(*AXES.tolist()), [[0, 0, 0], [5, 0, 0]], rtol=0.0, atol=1e-12)
    assert ShapeMeasures(cq.Compound.makeCompound([]).wrapped).extent(*AXES.tolist()) is None


@pytest.mark.parametrize(
    ("shape", "volume"),
    [(cq.Solid.makeBox(1, 2, 3), 6.0), (cq.Solid.makeSphere(2.0, angleDegrees1=-90), 32.0 / 3.0 * math.pi)],
    ids=["box", "ball"],
)
def test_volumes_and_solids_turned_inside_out(shape, volume):
    shape = placed(shape)
    assert ShapeMeasures(shape).volume() == pytest.approx(volume, rel=0.06)
    assert ShapeMeasures(shape.Reversed()).volume() == pytest.approx(-volume, rel=0.06)
    assert (is_inside_out(shape), is_inside_out(shape.Reversed())) == (False, True)
