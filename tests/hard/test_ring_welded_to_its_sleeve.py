"""A ring on a sleeve of the same radius, welded along one circle into one mesh: the rim of its bore lies on the sleeve.

Rounding puts it a hair behind the sleeve's wall here and there. Between two bodies the contact tolerance absorbs that;
these two are one connected piece of a mesh, closed, with four triangles at each edge that they share. Seen in the
motor.stl of OpenCASCADE's samples, whose bearing lost the front half of such a rim.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

import hlr
from hlr.drawing.drawing import Drawing
from hlr.drawing.saving import render
from support.at_size import AT_SIZE
from support.referee import exchange, referee, reference

SIDES = 24
INNER, RADIUS, OUTER = 14.0, 16.0, 28.0
LOW, TOP, HIGH = 9.0, 24.0, 25.9


def tube(inner: float, outer: float, low: float, high: float) -> tuple[np.ndarray, np.ndarray]:
    """A pipe of flat sides; its points and triangles, turned outward."""
    t = np.arange(SIDES) * (2 * np.pi / SIDES) + 0.1
    points = np.concatenate(
        [
            np.stack([r * np.cos(t), r * np.sin(t), np.full(SIDES, z)], axis=1)
            for r in (inner, outer)
            for z in (low, high)
        ]
    )
    i, j = np.arange(SIDES), (np.arange(SIDES) + 1) % SIDES
    rings = [(0, 1), (1, 3), (3, 2), (2, 0)]
    faces = [np.stack([p * SIDES + i, q * SIDES + i, q * SIDES + j, p * SIDES + j], axis=1) for p, q in rings]
    quads = np.concatenate(faces)
    return points, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def mesh() -> tuple[np.ndarray, np.ndarray]:
    """Both as one array of points, those that coincide counted once."""
    (one, a), (other, b) = tube(INNER, RADIUS, LOW, HIGH), tube(RADIUS, OUTER, LOW, TOP)
    points, number = np.unique(np.concatenate([one, other]), axis=0, return_inverse=True)
    return points, number.ravel()[np.concatenate([a, b + len(one)])]


@pytest.mark.slow
@pytest.mark.parametrize("view", ["iso", "iso-sw", "iso-ne", "iso-nw", (0.3, -0.8, 0.6)])
def test_the_rim_is_seen_where_it_lies_on_the_sleeve(view: object, picture: Callable[[Drawing], None]) -> None:
    points, triangles = mesh()
    drawing = hlr.draw((points, triangles), view, **AT_SIZE)
    judged = referee.Referee(reference.from_arrays(points, triangles)).judge(
        "ring", "hlr", exchange.parse(render(drawing, "json"))
    )
    assert judged.row.asked > 1000 and not judged.row.bad, list(judged.why())
    if view == "iso":
        picture(drawing)
