"""Needles have the normal of what lies beyond their longest side, and folds go with it."""

from types import SimpleNamespace

import numpy as np
import pytest

from hlr.scene import needles
from support.meshes import mesh_facts

STEP = 1e-6


def supported(points, triangles, precision=0.0):
    points, triangles = np.array(points, float), np.array(triangles, np.int32)
    mesh = mesh_facts(points, triangles)
    given = np.broadcast_to(np.asarray(precision, float), len(triangles)).copy()
    # Each triangle as a part of its own.
    found = needles.reliable_normals(mesh, points, triangles, np.arange(len(triangles), dtype=np.int32), given)
    return SimpleNamespace(edges=mesh.edges, normals=mesh.normals, fold=mesh.fold), SimpleNamespace(
        edges=mesh.edges, normals=found.normals, fold=found.fold
    )


def fold(mesh, a, b):
    at = np.flatnonzero((mesh.edges == sorted((a, b))).all(axis=1))
    return mesh.fold[at].item()


def same(a, b):
    return np.array_equal(a.normals, b.normals) and np.array_equal(a.fold, b.fold, equal_nan=True)


def roof(height, rise=1.0):
    """A needle 0 1 2 between a level triangle and two that rise; its third corner is `height` off its longest side."""
    points = [(0, 0, 0), (10, 0, 0), (5, -height, 0.3 * height), (5, 8, 0), (5, -8, rise)]
    return points, [(0, 1, 3), (1, 0, 2), (0, 4, 2), (2, 4, 1)]


def test_a_needle_goes_with_what_lies_beyond_its_longest_side():
    plain, found = supported(*roof(10 * STEP), precision=STEP)
    # As it stands the needle leans by a third; that is noise.
    assert abs(plain.normals[1] @ (0, 0, 1)) < 0.97
    assert (found.normals[1] == (0, 0, 1)).all() and fold(found, 0, 1) == 1.0
    # Against the others it has the folds of the triangle that it goes with.
    for low, other in (((0, 2), 2), ((1, 2), 3)):
        assert fold(found, *low) == pytest.approx(plain.normals[0] @ plain.normals[other], abs=1e-15)
    # What is no needle stays as it was.
    assert (found.normals[[0, 2, 3]] == plain.normals[[0, 2, 3]]).all()
    assert fold(found, 2, 4) == fold(plain, 2, 4)


@pytest.mark.parametrize(("share", "low"), [(0.9, True), (1.1, False)])
def test_the_limit_is_a_height_in_units_of_the_precision(share, low):
    # The height is square to the longest side, of whatever length that is; 1 / sqrt(1.09) of the corner's distance.
    height = share * 64 * STEP / np.sqrt(1.0 + 0.3**2)
    for scale in (0.1, 1.0, 100.0):
        points, triangles = roof(height)
        points = [(x * scale, y, z) for x, y, z in points]
        plain, found = supported(points, triangles, STEP)
        assert ((found.normals != plain.normals).any()) == low, scale
        assert same(found, plain) == (not low)


def test_each_triangle_has_its_own_precision():
    points, triangles = roof(10 * STEP)
    assert supported(points, triangles, [1, 0, 1, 1])[1].normals[1].tolist() != [0, 0, 1]
    assert supported(points, triangles, [0, STEP, 0, 0])[1].normals[1].tolist() == [0, 0, 1]


def test_exact_coordinates_leave_no_needles_but_those_without_area():
    plain, found = supported(*roof(1e-12))
    assert same(found, plain)
    points, triangles = roof(0.0)
    plain, found = supported(points, triangles)
    assert not plain.normals[1].any() and np.isnan(fold(plain, 0, 1))
    assert (found.normals[1] == (0, 0, 1)).all() and fold(found, 0, 1) == 1.0


@pytest.mark.parametrize("first", range(3))
def test_the_longest_side_may_be_any(first):
    points, triangles = roof(10 * STEP)
    a, b, c = triangles[1]
    triangles[1] = [(a, b, c), (b, c, a), (c, a, b)][first]
    assert (supported(points, triangles, STEP)[1].normals[1] == (0, 0, 1)).all()


def test_a_neighbour_wound_the_other_way_turns_the_normal_round():
    points, triangles = roof(10 * STEP)
    triangles[0] = triangles[0][::-1]
    plain, found = supported(points, triangles, STEP)
    assert (plain.normals[0] == (0, 0, -1)).all()
    assert (found.normals[1] == (0, 0, 1)).all() and fold(found, 0, 1) == 1.0


@pytest.mark.parametrize(("count", "known"), [(31, True), (32, True), (33, False)])
def test_no_more_than_so_many_needles_are_followed(count, known):
    found = fan(count)[1]
    assert found.normals[0].any() == known
    assert found.normals[count - 1].any()


def fan(n):
    """n needles, the longest side of each on the next one; beyond the last a triangle that is none."""
    points = [(0, 0, 0), *((10 - 0.01 * k, 5 * k * STEP, (-1) ** k * STEP) for k in range(n + 1)), (5, -8, 0)]
    triangles = [(0, k + 2, k + 1) for k in range(n)][::-1]
    return supported(points, [*triangles, (0, 1, n + 2)], STEP)


def test_needles_side_by_side_are_followed_to_the_first_that_is_none():
    # A fan of needles, the longest side of each the next one's second longest; beyond the last a level triangle.
    n = 5
    xs = 10.0 - np.arange(n + 1) * 0.01
    points = [(0, 0, 0), *((x, k * 5 * STEP, (-1) ** k * STEP) for k, x in enumerate(xs)), (5, -8, 0)]
    triangles = [(0, k + 1, k + 2) for k in range(n)] + [(0, n + 2, 1)]
    found = supported(points, triangles, STEP)[1]
    level = found.normals[n]
    assert (found.normals[:n] == level).all() and abs(level[2]) > 0.999


def test_a_needle_at_a_border_has_no_normal_and_its_folds_are_not_known():
    # Its longest side is nobody else's.
    points = [(0, 0, 0), (10, 0, 0), (5, -10 * STEP, 0), (5, -8, 1)]
    found = supported(points, [(1, 0, 2), (0, 3, 2), (2, 3, 1)], STEP)[1]
    assert not found.normals[0].any()
    assert np.isnan(fold(found, 0, 2)) and np.isnan(fold(found, 1, 2)) and not np.isnan(fold(found, 2, 3))


def test_two_needles_on_one_side_have_none():
    # Each is beyond the longest side of the other.
    points = [(0, 0, 0), (10, 0, 0), (5, -10 * STEP, 0), (5, 10 * STEP, 0)]
    found = supported(points, [(1, 0, 2), (0, 1, 3)], STEP)[1]
    assert not found.normals.any() and np.isnan(fold(found, 0, 1))


def test_where_three_meet_nobody_is_beyond():
    points, triangles = roof(10 * STEP)
    points, triangles = [*points, (5, 0, 9)], [*triangles, (0, 1, 5)]
    assert not supported(points, triangles, STEP)[1].normals[1].any()
