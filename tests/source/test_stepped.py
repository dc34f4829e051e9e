"""Planes that step: what lies before them, and how far."""

import numpy as np
import pytest

from hlr.source.stepped import Stepped

UP, RIGHT = np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])
STEPS = Stepped(UP, RIGHT, np.array([0.0, 20.0, 10.0]), np.array([-5.0, 5.0]))


def test_heights_are_those_over_the_plane_at_each_point_and_over_the_higher_one_at_a_step():
    points = np.array([(-6, 3, 1), (0, 3, 1), (6, 3, 1), (-5, 3, 1), (5.05, 3, 1)], float)
    assert STEPS.heights(points, 0.1).tolist() == [1, -19, -9, -19, -19]
    assert STEPS.heights(points[-1:]).tolist() == [-9]


def test_reach_counts_the_planes_that_a_part_lies_over():
    assert STEPS.reach(np.array([(-9.0, 0, 1), (-6.0, 0, 4)])) == (1.0, 4.0)
    # Its ends lie over low planes, its middle over a high one.
    assert STEPS.reach(np.array([(-9.0, 0, 12), (9.0, 0, 12)])) == (-8.0, 12.0)
    assert STEPS.reach(np.array([(0.0, 0, 12), (9.0, 0, 12)])) == (-8.0, 2.0)


def test_what_lies_behind_them_is_blocks_that_overlap():
    ends = np.inf
    assert list(STEPS.blocks()) == [(-ends, ends, 0.0), (-5.0, ends, 10.0), (-5.0, 5.0, 20.0)]
    assert list(Stepped(UP, RIGHT, np.array([3.0]), np.zeros(0)).blocks()) == [(-ends, ends, 3.0)]


def test_points_before_a_placement_lie_as_far_before_the_planes_as_after_it():
    turn = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]])
    placement = np.eye(4)
    placement[:3, :3], placement[:3, 3] = 2.5 * turn, (7.0, -3.0, 11.0)
    points = np.random.default_rng(1).uniform(-10, 10, (50, 3))
    placed = points @ placement[:3, :3].T + placement[:3, 3]
    before = STEPS.before(placement)
    assert 2.5 * before.heights(points) == pytest.approx(STEPS.heights(placed))
    assert np.linalg.norm(before.normal) == pytest.approx(1.0) and np.linalg.norm(before.along) == pytest.approx(1.0)
