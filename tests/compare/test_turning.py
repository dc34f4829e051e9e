"""Where rays look for outlines: where a mesh turns away, and not at each face that is seen from its edge."""

from types import SimpleNamespace

import numpy as np
import pytest

from hlr.compare.verdict.turning import turning_edges


def ribbon(profile, length=10.0):
    """A profile of (x, z), pushed along y: two triangles for each of its segments."""
    xz = np.array(profile, float)
    count = len(xz)
    points = np.concatenate([np.column_stack([xz[:, 0], np.full(count, y), xz[:, 1]]) for y in (0.0, length)])
    quads = [(i, i + 1, i + 1 + count, i + count) for i in range(count - 1)]
    triangles = np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])
    beside = {}
    for number, corners in enumerate(triangles):
        for k in range(3):
            beside.setdefault(tuple(sorted((corners[k], corners[k - 1]))), []).append(number)
    edges = np.array(list(beside))
    incident = np.array([t for each in beside.values() for t in each])
    offsets = np.cumsum([0, *(len(each) for each in beside.values())])
    return SimpleNamespace(triangles=triangles, edges=edges, offsets=offsets, incident=incident), points


def turned(profile):
    """The corners of the profile at which the surface turns."""
    scene, points = ribbon(profile)
    turns = scene.edges[turning_edges(scene, points, 0.01)]
    count = len(profile)
    return {int(a) for a, b in turns if b == a + count}


@pytest.mark.parametrize("lean", [0.0, 1e-3, -1e-3])
def test_a_wall_between_two_faces_that_turn_the_same_way_is_no_outline(lean):
    assert turned([(0, 0), (5, 0), (5 + lean, 4), (9, 4)]) == set()
    assert turned([(9, 0), (5, 0), (5 + lean, 4), (0, 4)]) == set()  # seen from below


@pytest.mark.parametrize("lean", [0.0, 1e-3, -1e-3])
def test_a_wall_between_one_face_toward_the_viewer_and_one_away_is_an_outline_on_both_sides(lean):
    assert turned([(0, 0), (5, 0), (5 + lean, -4), (0, -4)]) == {1, 2}


def test_a_wall_in_several_strips_is_an_outline_where_it_ends():
    assert turned([(0, 0), (5, 0), (5, -1), (5, -2), (5, -4), (0, -4)]) == {1, 4}


def test_a_wall_that_ends_elsewhere_says_nothing():
    """The wall goes on behind a ledge: what turns there lies at another place of the drawing."""
    assert turned([(0, 0), (5, 0), (5, -4), (9, -4), (9, -8), (6, -8)]) == {3, 4}


def test_faces_that_meet_at_an_angle_turn_there():
    assert turned([(0, 0), (5, 1), (0, 2)]) == {1}
    assert turned([(0, 0), (5, 1), (9, 3)]) == set()


def test_long_segments_have_no_more_points_than_can_be_searched():
    """Walls of 34 m at full size had one every 0.05 mm: a comparison of two boxes took minutes."""
    from hlr.compare.verdict.turning import cell_mm

    walls = np.array([[[0.0, 0.0], [34_000.0, 0.0]]] * 10)
    assert cell_mm([walls, walls], 0.01) == pytest.approx(680_000.0 / 200_000.0)
    assert cell_mm([walls / 1000.0], 0.01) == pytest.approx(0.05)
