"""A mesh that goes through a plate, with a row of its corners at the plate's top or less than the accuracy beside it.

No triangle then has a corner deep in the plate and another one high above it: those above the row end on the plate, and
those below it begin there. The surface goes on all the same, from one triangle to the next. Measured at single
triangles, all of it was a contact, and the line in which the two meet was not drawn: of a ball that is sunk to its
equator, and of any mesh whose triangles are as small as the accuracy.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.meshes import as_parts, box, cells, moved, sphere, torus

ACCURACY = 0.02
SIDE, RADIUS = 10.0, 6.0
PLATE = box((-20, -20, -8), (20, 20, 0))
SHARES = [-0.9, -0.3, -1e-6, 0.0, 1e-6, 0.3, 0.9]
"""Accuracies: how high the row of corners lies above the plate's top."""
UNDER = 0.08
"""Of the whole line: hidden pieces that are not drawn, for they lie under the ink of an outline."""


def post(heights):
    """A square post about z with a ring of four corners at each height."""
    corners = SIDE / 2 * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    points = np.array([[*corner, z] for z in heights for corner in corners])
    rings = np.arange(len(points)).reshape(-1, 4)
    walls = cells(np.concatenate([rings, rings[:, :1]], axis=1))[:, ::-1]
    last = len(points) - 4
    caps = np.array([[0, 2, 1], [0, 3, 2], [last, last + 1, last + 2], [last, last + 2, last + 3]])
    return points, np.concatenate([walls, caps]).astype(np.int32)


def meetings(*meshes, accuracy=ACCURACY):
    """The whole length of the lines in which the meshes meet, hidden ones too, in the model; and all their points."""
    drawing = hlr.draw(as_parts(*meshes), "iso", accuracy=accuracy, **AT_SIZE)
    lines = [line.points3 for line in drawing.lines if line.kind == "intersection"]
    length = sum(np.linalg.norm(np.diff(points, axis=0), axis=1).sum() for points in lines)
    return length, np.concatenate([np.zeros((0, 3)), *lines])


@pytest.mark.parametrize("share", SHARES)
def test_a_post_meets_the_plate_in_a_square(share):
    length, points = meetings(PLATE, post([-4.0, share * ACCURACY, 6.0]))
    assert length == pytest.approx(4 * SIDE, rel=1e-4)
    assert np.abs(points[:, 2]).max() < 1e-6


@pytest.mark.parametrize("share", SHARES)
@pytest.mark.parametrize("rows", [16, 32, 64])
def test_a_ball_sunk_to_its_equator_meets_it_in_a_circle(share, rows):
    ball = moved(sphere(RADIUS, rows, rows), lambda p: p + [0, 0, share * ACCURACY])
    length, points = meetings(PLATE, ball)
    assert length == pytest.approx(2 * rows * RADIUS * np.sin(np.pi / rows), rel=UNDER)
    assert np.abs(points[:, 2]).max() < 1e-6


@pytest.mark.parametrize("height", [0.0, 0.1, 1.5])
def test_a_ball_of_triangles_as_small_as_the_accuracy_meets_it_in_a_circle(height):
    ball = moved(sphere(RADIUS, 128, 128), lambda p: p + [0, 0, height])
    length, points = meetings(PLATE, ball, accuracy=0.3)
    assert length == pytest.approx(2 * np.pi * np.sqrt(RADIUS**2 - height**2), rel=UNDER)
    assert np.abs(points[:, 2]).max() < 1e-6


def test_a_ring_around_a_drum_meets_it_in_two_circles():
    """The drum's wall runs through the middle of the ring's section, along rows of its corners."""
    n = 64
    turn = 2 * np.pi * np.arange(n) / n
    wall = np.array([[10 * np.cos(t), 10 * np.sin(t), z] for z in (-15, 15) for t in turn])
    ends = np.array([[0, 0, -15], [0, 0, 15]])
    lower, upper = np.arange(n), n + np.arange(n)
    rings = np.stack([np.append(lower, 0), np.append(upper, n)])
    fans = [[[2 * n, (i + 1) % n, i], [2 * n + 1, n + i, n + (i + 1) % n]] for i in range(n)]
    drum = np.concatenate([wall, ends]), np.concatenate([cells(rings)[:, ::-1], np.reshape(fans, (-1, 3))])
    length, points = meetings((drum[0], drum[1].astype(np.int32)), torus(10.0, 3.0, n, 32))
    assert length == pytest.approx(2 * 2 * n * 10 * np.sin(np.pi / n), rel=UNDER)
    assert np.abs(points[:, 2]) == pytest.approx(3.0)


@pytest.mark.parametrize("share", [-0.5, -0.3, 0.0, 0.5])
def test_a_post_that_stands_on_the_plate_does_not_meet_it(share):
    assert meetings(PLATE, post([share * 0.1 * ACCURACY, 6.0]))[0] == 0.0


def test_the_picture(picture):
    ball = moved(sphere(RADIUS, 32, 32), lambda p: p + [-10, -8, 0.3 * ACCURACY])
    block = moved(post([-4.0, 0.3 * ACCURACY, 6.0]), lambda p: p + [8, 6, 0])
    picture(hlr.draw(as_parts(PLATE, ball, block), "iso", accuracy=ACCURACY, **AT_SIZE), twice=1.0)
