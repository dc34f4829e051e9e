"""Of two faces the same small triangle, seen from both sides, encloses nothing."""

from __future__ import annotations

import numpy as np

from hlr.scene.flat_wedges import flat_wedges

# Two tents on one floor that meet in the triangle 0, 1, 2: the walls of a closed body, of zero thickness there.
TENTS = np.array(
    [
        [0, 1, 2],  # the wedge, above
        [2, 1, 0],  # and below
        [0, 3, 1],
        [1, 3, 2],
        [2, 3, 0],
        [1, 4, 0],
        [2, 4, 1],
        [0, 4, 2],
    ],
    np.int32,
)
FACES = np.array([0, 1, 0, 0, 0, 1, 1, 1], np.int32)


def test_both_halves_of_a_wedge_are_found():
    assert np.flatnonzero(flat_wedges(TENTS, FACES, 5)).tolist() == [0, 1]


def test_the_order_of_corners_and_triangles_does_not_matter():
    rng = np.random.default_rng(2)
    for _ in range(20):
        order = rng.permutation(len(TENTS))
        turned = np.stack([np.roll(t, rng.integers(3)) for t in TENTS[order]])
        assert sorted(order[flat_wedges(turned, FACES[order], 5)].tolist()) == [0, 1]


def test_what_has_both_sides_in_one_face_is_no_wedge():
    assert not flat_wedges(TENTS, np.zeros(8, np.int32), 5).any()


def test_triangles_that_face_the_same_way_are_no_wedge():
    same = TENTS.copy()
    same[1] = [1, 2, 0]
    assert not flat_wedges(same, FACES, 5).any()


def test_in_an_open_surface_there_is_no_wedge():
    # One tent alone, on both halves.
    assert not flat_wedges(TENTS[:6], FACES[:6], 5).any()


def test_a_face_all_of_which_lies_on_another_is_no_wedge():
    faces = np.array([2, 1, 0, 0, 0, 1, 1, 1], np.int32)
    assert not flat_wedges(TENTS, faces, 5).any()
    assert not flat_wedges(np.zeros((0, 3), np.int32), np.zeros(0, np.int32), 0).any()


def test_the_tip_of_a_pillow_is_no_wedge():
    # Two faces that have both sides of the corner 0 in common: without its triangle the body would be shorter.
    below = np.array([[0, 1, 2], [1, 3, 2]], np.int32)
    above = np.array([[2, 1, 0], [2, 4, 1], [4, 3, 1], [2, 3, 4]], np.int32)
    face = np.array([0, 0, 1, 1, 1, 1], np.int32)
    assert not flat_wedges(np.concatenate([below, above]), face, 5).any()
