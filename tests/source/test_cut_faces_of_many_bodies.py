"""Cut faces of meshes that are made of the lines in which their triangles meet the plane."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from hlr.source.mesh.capping import OpenBody, _cut, _is_inside, _open_sides
from hlr.source.mesh.one_by_one import body_numbers


def test_each_of_many_bodies_has_its_own_points_alone():
    """With all points each, a thousand bodies that are cut anew took a thousand times the memory."""
    balls = [trimesh.creation.icosphere(1, 1.0) for _ in range(40)]
    for k, ball in enumerate(balls):
        ball.apply_translation((3.0 * k, 0.0, 0.1))
    whole = trimesh.util.concatenate(balls)
    points, triangles = np.asarray(whole.vertices), np.asarray(whole.faces, np.int32)
    found = _cut(points, triangles, body_numbers(points, triangles), 1e-9)
    assert found is not None
    assert len(found) == len(balls)
    assert sum(len(body.points) for body in found) < 2 * len(points)


def test_a_triangle_falls_apart_whose_sides_are_crossed_two_by_two():
    """The first fan has the third corner's sides within it: the second one was looked for in vain."""
    points = np.array([[0, 0, 0], [10, 0, 0], [0, 10, 0], [1, -5, 0], [1, 5, 0], [2, 5, 0.0]], float)
    triangles = np.array([[0, 1, 2], [3, 4, 5]], np.int32)
    body = OpenBody(points, triangles, _open_sides(triangles, len(points)))
    divided = body.divided()
    assert len(divided.triangles) > len(triangles)
    assert divided.area() == pytest.approx(body.area())
    assert divided.length() == pytest.approx(body.length())


def test_a_triangle_with_one_corner_twice_has_no_part_in_it():
    ball = trimesh.creation.icosphere(1, 1.0)
    points, triangles = np.asarray(ball.vertices), np.asarray(ball.faces, np.int32)
    number = np.zeros(len(triangles) + 1, np.int64)
    lowest = int(np.argmin(points[:, 2]))
    with_it = np.concatenate([triangles, [[lowest, lowest, triangles[triangles != lowest][0]]]]).astype(np.int32)
    found = _cut(points, with_it, number, 1e-9)
    assert found is not None
    assert all(len(set(row)) == 3 for row in found[0].triangles.tolist())


@pytest.mark.parametrize("count", [3, 3000])
def test_a_loop_lies_within_another_one_of_many_corners(count):
    turn = np.arange(count) * (2 * np.pi / count)
    ring = np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1)
    points = np.concatenate([ring, 3.0 * ring])
    inner, outer = np.arange(count, dtype=np.int32), np.arange(count, 2 * count, dtype=np.int32)
    assert _is_inside(points, inner, outer)
    assert not _is_inside(points, outer, inner)
