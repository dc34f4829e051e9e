"""A torus seen exactly edge-on: its upper and lower circles are contours that lie on top of themselves in the image.

Half of each contour is collinear with the other half; the inner halves of the two end circles lie in the torus' own
shadow. A turn of 1e-9 must not change the picture.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import Ink, agrees, doubled, pieces, wrong_by_rays
from support.meshes import circle, torus

MAJOR, MINOR = 20.0, 6.0
N, M = 240, 96


def half(side, start, end):
    """A half circle of the tube's section at x = side * MAJOR."""
    return circle(MINOR, M // 2, start, end) + [side * MAJOR, 0]


@pytest.mark.slow
@pytest.mark.parametrize("turn", [0.0, 1e-12, 1e-9, 1e-6])
def test_edge_on_it_is_a_stadium_with_two_hidden_half_circles(picture, turn):
    drawing = hlr.draw(torus(MAJOR, MINOR, N, M), (turn, -1, turn), **AT_SIZE)
    flat = [np.array([[-MAJOR, z], [MAJOR, z]]) for z in (-MINOR, MINOR)]
    quarter = np.pi / 2
    seen = pieces([*flat, half(1, -quarter, quarter), half(-1, quarter, 3 * quarter)])
    unseen = pieces([half(1, quarter, 3 * quarter), half(-1, -quarter, quarter)])
    agrees(drawing, Ink(seen, unseen))
    if turn == 0.0:
        picture(drawing)


def test_from_above_it_is_two_circles():
    drawing = hlr.draw(torus(MAJOR, MINOR, N, M), "top", **AT_SIZE)
    agrees(drawing, Ink(pieces([circle(MAJOR + MINOR, N), circle(MAJOR - MINOR, N)]), np.zeros((0, 2, 2))))


@pytest.mark.slow
@pytest.mark.parametrize("height", [0.05, 0.2, 0.3, 0.6, 1.0])
def test_obliquely_the_inner_outline_has_cusps_and_rays_agree(picture, height):
    # Koenderink (1984): a contour ends where the line of sight is asymptotic; beyond that it is hidden by its own lip.
    points, triangles = torus(MAJOR, MINOR, N, M)
    drawing = hlr.draw((points, triangles), (0.3, -1, height), **AT_SIZE)
    judged, wrong = wrong_by_rays(drawing, points, triangles)
    # Five places on each line, of which there are two at least: the outer outline, and the inner one.
    assert judged >= 10
    assert wrong == 0
    if height == 0.3:
        picture(drawing, "cusps", twice=10.0)


def test_no_outline_runs_back_over_itself():
    assert doubled(hlr.draw(torus(MAJOR, MINOR, N, M), (0.3, -1, 0.3), **AT_SIZE)) == 0.0
