"""Faces that lie on one another where they meet: the sharp end of a body, and the tip of a slot.

A rounded body cut out of a block along a line of its top leaves it as thin as a knife there. The outer normals of the
two faces are opposite, so their turn about the edge is rounding: it does not tell a knife, which is visible wherever
its top is, from the tip of a slot, which no one sees. Where the faces lie off the edge does.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr

LENGTH = 20.0


def knife(plane: cq.Plane) -> cq.Workplane:
    """Its end lies in x = -2, z = 0 of the plane; its top in z = 0, the hollow below it."""
    hollow = cq.Workplane(plane).workplane(offset=-6).center(-3, 10).rect(6, LENGTH).extrude(6)
    hollow = hollow.edges(cq.selectors.NearestToPointSelector(plane.toWorldCoords((0, 10, 0)))).fillet(2)
    body = cq.Workplane(plane).workplane(offset=-3).center(3, 10).rect(10, LENGTH).extrude(3)
    return body.cut(hollow)


def slot(plane: cq.Plane) -> cq.Workplane:
    """A block with the knife taken out of it; the tip lies where the end was."""
    block = cq.Workplane(plane).workplane(offset=-6).center(0, 10).rect(20, LENGTH).extrude(12)
    return block.cut(knife(plane))


def axes(turn: int) -> np.ndarray:
    """Rows: where the x, y and z axes point after a turn."""
    rng = np.random.default_rng(turn)
    return np.linalg.qr(rng.normal(size=(3, 3)))[0] if turn else np.eye(3)


@pytest.mark.parametrize("turn", range(12))
@pytest.mark.parametrize("up", [0.02, 0.1, 0.25])
@pytest.mark.parametrize(("shape", "seen"), [(knife, True), (slot, False)])
def test_a_knife_is_seen_and_the_tip_of_a_slot_is_not(shape, seen, up, turn):
    x, y, z = axes(turn)
    if np.dot(np.cross(x, y), z) < 0.0:
        y = -y
    plane = cq.Plane(tuple(0.37 * x), tuple(x), tuple(z))
    body = shape(plane)
    y = np.cross(z, x)
    drawing = hlr.draw(body, tuple(-0.8 * x + 0.5 * y + up * z), hidden=True, smooth=False, details=True)
    at = lambda line: (line.points3 - 0.37 * x) @ np.stack([x, y, z]).T  # noqa: E731
    edge = [line for line in drawing.lines if np.abs(at(line) - [-2, 0, 0])[:, [0, 2]].max() < 1e-6]
    assert sum(np.ptp(at(line)[:, 1]) for line in edge if line.visible == seen) == pytest.approx(LENGTH, abs=0.01)
    assert all(line.visible == seen for line in edge)
