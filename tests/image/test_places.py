"""Points before a camera and boxes where parts stand: the kernel's arithmetic, operation by operation."""

import numpy as np
import pytest

from hlr import _kernel

POINTS = np.random.default_rng(7).normal(size=(50, 3)) * (1.0, 1e3, 1e-3)
RIGHT, UP, DIRECTION = (0.6, 0.8, 0.0), (-0.48, 0.36, 0.8), (0.64, -0.48, 0.6)


def dot(points, v):
    return points[:, 0] * v[0] + points[:, 1] * v[1] + points[:, 2] * v[2]


def test_points_of_a_parallel_view_are_those_of_the_formula_bit_by_bit():
    wanted = np.stack([dot(POINTS, RIGHT), dot(POINTS, UP), -dot(POINTS, DIRECTION)], axis=1)
    assert np.array_equal(_kernel.Camera(DIRECTION, RIGHT, UP, None, 7.0).image(POINTS), wanted)


def test_points_before_an_eye_are_those_of_the_formula_bit_by_bit():
    eye, distance = (3000.0, -2000.0, 2500.0), 4300.0
    away = POINTS - np.array(eye)
    factor = distance / -dot(away, DIRECTION)
    wanted = np.stack([dot(away, RIGHT) * factor, dot(away, UP) * factor, -distance * factor], axis=1)
    assert np.array_equal(_kernel.Camera(DIRECTION, RIGHT, UP, (eye, distance), 7.0).image(POINTS), wanted)


def test_boxes_are_moved_corner_by_corner_and_void_ones_do_not_count():
    boxes = np.array([[[0, 0, 0], [1, 2, 3]], [[np.inf] * 3, [-np.inf] * 3]], float)
    turned = np.array([[0, -1, 0, 10], [1, 0, 0, 20], [0, 0, 1, 30], [0, 0, 0, 1]], float)
    corners, around = _kernel.placed_boxes(boxes, np.array([0, 1, 0], np.int32), np.stack([turned, turned, np.eye(4)]))
    cube = np.array([(i, 2 * j, 3 * k) for i in (0, 1) for j in (0, 1) for k in (0, 1)], float)
    assert np.array_equal(corners[2], cube) and not corners[1].any()
    assert np.array_equal(corners[0], cube @ turned[:3, :3].T + turned[:3, 3])
    assert around.tolist() == [[0, 0, 0], [10, 21, 33]]


def test_what_is_no_number_stays():
    boxes = np.array([[[0, 0, np.nan], [1, 2, 3]], [[0, 0, 0], [1, 1, 1]]], float)
    _, around = _kernel.placed_boxes(boxes, np.array([0, 1], np.int32), np.stack([np.eye(4)] * 2))
    assert np.isnan(around).all()


@pytest.mark.parametrize(
    ("root", "place", "said"),
    [
        ([1], np.eye(4)[None], "root holds 1"),
        ([0], np.zeros((2, 4, 4)), "matrices has 2"),
        ([0], np.asfortranarray(np.zeros((2, 4, 4)))[:1], "C-contiguous"),
    ],
)
def test_boxes_that_fit_nothing_are_refused(root, place, said):
    with pytest.raises(ValueError, match=said):
        _kernel.placed_boxes(np.zeros((1, 2, 3)), np.array(root, np.int32), place)


@pytest.mark.parametrize("count", [1, 7, 60_000])
@pytest.mark.parametrize("eye", [None, ((3000.0, -2000.0, 2500.0), 4300.0)])
def test_points_reach_as_far_as_their_images(count, eye):
    points = np.random.default_rng(count).normal(size=(count, 3))
    camera = _kernel.Camera(DIRECTION, RIGHT, UP, eye, 7.0)
    image = camera.image(points)[:, :2]
    assert np.array_equal(camera.reach(points), np.stack([image.min(axis=0), image.max(axis=0)], axis=1))


def test_no_points_reach_nowhere():
    low, high = _kernel.Camera(DIRECTION, RIGHT, UP, None, 1.0).reach(np.zeros((0, 3))).T
    assert (low > high).all()
