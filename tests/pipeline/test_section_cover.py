"""What whole parts hide before the plane of a section."""

from types import SimpleNamespace

import numpy as np
import pytest

from hlr.pipeline.section.cover import cover_of
from hlr.source.stepped import Stepped

UP, RIGHT = np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])
PLANE = Stepped(UP, RIGHT, np.zeros(1), np.zeros(0))


def sides(points, triangles, name="part", planes=PLANE):
    part = SimpleNamespace(name=name, points=np.array(points, float), triangles=np.array(triangles))
    found = cover_of([part], {"part"}, planes, 1e-9)
    return {tuple(map(tuple, np.round(side, 6).tolist())) for side in found}


def test_triangles_are_cut_at_the_plane():
    found = sides([(0, 0, 2), (4, 0, -2), (0, 4, -2)], [(0, 1, 2)])
    assert found == {((0, 0, 2), (2, 0, 0)), ((2, 0, 0), (0, 2, 0)), ((0, 2, 0), (0, 0, 2))}
    two = sides([(0, 0, 1), (4, 0, 1), (0, 4, -1)], [(0, 1, 2)])
    assert two == {((0, 0, 1), (4, 0, 1)), ((4, 0, 1), (2, 2, 0)), ((2, 2, 0), (0, 2, 0)), ((0, 2, 0), (0, 0, 1))}


def test_what_triangles_share_is_no_border():
    corners = [(0, 0, 1), (4, 0, 1), (4, 4, 1), (0, 4, 1)]
    found = sides(corners, [(0, 1, 2), (0, 2, 3)])
    assert found == {(corners[k], corners[(k + 1) % 4]) for k in range(4)}
    through = sides([(0, 0, 1), (4, 0, 1), (4, 4, -1), (0, 4, -1)], [(0, 1, 2), (0, 2, 3)])
    assert {point[1] for side in through for point in side} == {0.0, 2.0}
    assert ((0, 0, 1), (2, 2, 0)) not in through and ((2, 2, 0), (0, 0, 1)) not in through


@pytest.mark.parametrize(
    ("points", "name"),
    [
        ([(0, 0, -1), (4, 0, -1), (0, 4, -1)], "part"),
        ([(0, 0, 1), (0, 4, 1), (4, 0, 1)], "part"),
        ([(0, 0, 1), (4, 0, 1), (0, 4, 1)], "other"),
    ],
)
def test_what_lies_behind_looks_away_or_is_of_other_parts_hides_nothing(points, name):
    assert sides(points, [(0, 1, 2)], name) == set()


def test_planes_that_step_cut_what_lies_before_each_of_them():
    stepped = Stepped(UP, RIGHT, np.array([0.0, 2.0]), np.array([2.0]))
    corners = [(0, 0, 1), (4, 0, 1), (4, 4, 1), (0, 4, 1)]
    found = sides(corners, [(0, 1, 2), (0, 2, 3)], planes=stepped)
    # Half of the square is left: its border, in pieces where triangles end.
    length = sum(float(np.linalg.norm(np.subtract(*side))) for side in found)
    assert length == 12.0 and max(point[0] for side in found for point in side) == 2.0
