"""The rim of a cone that the frame of a perspective view cuts, or whose body reaches behind the eye.

The eye sees the base of the cone, so all of the rim is seen, and the outline leaves it at two places. A body that was
cut at the frame, or at the plane of the eye, counted as open. So triangles of the side that are turned away hid the rim
beside these places, 10 mm of it at 20:1.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr
from support.expected import Ink, differences, ink_length, on_paper, pieces
from support.measures import placed

RADIUS, HEIGHT = 4.25, 4.0
EYE, TARGET, UP = (57.0, 32.2, -0.6), (25.5, 16.2, 38.4), (-0.17, -0.95, -0.25)
ROD = 200.0
"""Its length: it reaches behind the eye."""


def cone():
    """On its base in the plane z = 0, which the eye is below."""
    return cq.Workplane(cq.Solid.makeCone(RADIUS, 0, HEIGHT))


def with_a_rod(x, y):
    """The same with a rod from within it, which is above the plane of the base and so hides nothing of the rim."""
    return cone().union(cq.Workplane().box(x, y, 0.5, centered=(x < 1, y < 1, True)).translate((0, 0, 1)))


SHAPES = {"cone": cone(), "rod along x": with_a_rod(ROD, 0.5), "rod along y": with_a_rod(0.5, ROD)}


def frame_of(drawing):
    """Half the width and the height of the frame on paper."""
    tall = np.tan(np.radians(drawing.view.fov / 2)) * drawing.view.distance * drawing.scale
    return np.array([tall * 4 / 3, tall])


@pytest.mark.parametrize("fov", [74.0, 100.0])
@pytest.mark.parametrize(
    "shape", [cone(), with_a_rod(ROD, 0.5), with_a_rod(0.5, ROD)], ids=["cone", "along x", "along y"]
)
def test_all_of_a_rim_is_seen_whose_face_is_turned_to_the_eye(shape, fov):
    camera = hlr.Perspective(eye=EYE, target=TARGET, fov=fov)
    drawing = hlr.draw(shape, perspective=camera, up=UP, scale=20.0, hidden=True, smooth=False, details=True)
    rim = [line for line in drawing.lines if np.abs(line.points3[:, 2]).max() < 1e-9]
    drawn = Ink(*[pieces(placed(drawing, line) for line in rim if line.visible == seen) for seen in (True, False)])
    turn = np.linspace(0.0, 2.0 * np.pi, 40_001)
    circle = on_paper(drawing, np.stack([RADIUS * np.cos(turn), RADIUS * np.sin(turn), 0.0 * turn], axis=1))
    all_of_it = pieces([circle])
    seen = all_of_it[(np.abs(all_of_it) <= frame_of(drawing)).all(axis=(1, 2))]
    assert (len(seen) < len(all_of_it)) == (fov < 100.0), "the frame cuts the rim where it is narrow, and only there"
    assert ink_length(seen) > 100.0
    told = differences(Ink(seen, np.zeros((0, 2, 2))), drawn, drawing.accuracy.used)
    assert not told, "\n".join(told)
