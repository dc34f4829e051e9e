"""Of triangles on the same corners one stays: the same, however they are listed."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from hlr.source.mesh.duplicate_triangles import unique_triangles

SHAPES = {
    "box": trimesh.creation.box(),
    "torus": trimesh.creation.torus(3, 1, major_sections=9, minor_sections=7),
    "ball": trimesh.creation.icosphere(1),
}


def rolled(triangles):
    """As a set of corners walked from the lowest, which keeps the way round."""
    return {tuple(np.roll(t, -int(np.argmin(t))).tolist()) for t in triangles}


def shuffled(triangles, rng):
    out = triangles[rng.permutation(len(triangles))]
    return np.stack([np.roll(t, rng.integers(3)) for t in out]).astype(np.int32)


def test_of_no_triangles_none_stays():
    assert len(kept(np.zeros((4, 3)), np.zeros((0, 3), np.int32))) == 0


def kept(points, triangles):
    return triangles[unique_triangles(points, triangles, np.zeros(len(triangles), np.int32))]


@pytest.mark.parametrize("share", [1.0, 0.5])
@pytest.mark.parametrize("name", SHAPES)
def test_of_a_mesh_listed_from_both_sides_the_outside_stays(name, share):
    points, triangles = np.asarray(SHAPES[name].vertices), np.asarray(SHAPES[name].faces, np.int32)
    both = np.concatenate([triangles, triangles[: int(share * len(triangles)), ::-1]])
    for seed in range(4):
        assert rolled(kept(points, shuffled(both, np.random.default_rng(seed)))) == rolled(triangles)


def test_the_side_of_single_neighbours_stays_though_it_faces_inward():
    points, triangles = np.asarray(SHAPES["ball"].vertices), np.asarray(SHAPES["ball"].faces, np.int32)[:, ::-1]
    both = np.concatenate([triangles, triangles[:5, ::-1]])
    assert rolled(kept(points, shuffled(both, np.random.default_rng(1)))) == rolled(triangles)


def test_of_three_copies_the_two_that_agree_win():
    points = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0.0)])
    for order in ([0, 1, 2], [2, 1, 0], [1, 0, 2]):
        copies = np.array([(2, 1, 0), (0, 1, 2), (1, 2, 0)], np.int32)[order]
        assert rolled(kept(points, copies)) == {(0, 1, 2)}


def test_a_sheet_of_two_sides_is_the_same_in_any_order():
    x, y = np.meshgrid(np.arange(4.0), np.arange(4.0))
    points = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    corner = (np.arange(3)[:, None] * 4 + np.arange(3)).ravel()
    triangles = np.concatenate([corner[:, None] + (0, 1, 5), corner[:, None] + (0, 5, 4)]).astype(np.int32)
    both = np.concatenate([triangles, triangles[:, ::-1]])
    found = [rolled(kept(points, shuffled(both, np.random.default_rng(seed)))) for seed in range(6)]
    assert all(each == found[0] for each in found)
    assert found[0] in (rolled(triangles), rolled(triangles[:, ::-1]))


def test_the_face_with_the_lowest_number_stays():
    points = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0.0)])
    copies = np.array([(0, 1, 2), (1, 2, 0), (2, 0, 1)], np.int32)
    assert unique_triangles(points, copies, np.array([7, 3, 5], np.int32)).tolist() == [1]
