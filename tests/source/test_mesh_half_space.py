"""Meshes cut by a plane: what is open ends at the plane, what is closed is closed there."""

from types import SimpleNamespace

import numpy as np
import pytest
import trimesh

from hlr.source.mesh.clipping import clipped
from hlr.source.mesh.closed import of_closed_bodies
from hlr.source.mesh.half_space import cut_mesh
from hlr.source.stepped import Stepped

UP, RIGHT = np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])


def plane(height=0.0, normal=UP):
    return Stepped(normal, RIGHT, np.array([height]), np.zeros(0))


def block(shift=(0.0, 0.0, 0.0), without=()):
    """A cube of 2 mm; without: the numbers of triangles that it lacks."""
    made = trimesh.creation.box((2, 2, 2))
    keep = np.setdiff1d(np.arange(12), without)
    return made.vertices + shift, made.faces[keep].astype(np.int32)


def together(*meshes):
    """One mesh of several."""
    first = np.cumsum([0, *(len(points) for points, _ in meshes)])
    return np.concatenate([points for points, _ in meshes]), np.concatenate(
        [rows + k for (_, rows), k in zip(meshes, first, strict=False)]
    )


def cut(mesh, planes=None):
    part = SimpleNamespace(points=np.array(mesh[0], float), triangles=np.array(mesh[1], np.int32))
    return cut_mesh(part, planes or plane(), 1e-9)


def area(points, rows):
    a, b, c = points[rows].transpose(1, 0, 2)
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()


def borders(rows):
    """The edges of triangles (m, 3) at which there is but one."""
    edges = np.sort(rows[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    found, counts = np.unique(edges, axis=0, return_counts=True)
    return found[counts == 1]


def clip(points, rows, height=0.0, near=1e-9):
    points, rows = np.array(points, float), np.array(rows, np.int32)
    return clipped(points, rows, plane(height), near)


def figures(points, rows):
    """Its triangles as sets of corners."""
    return {frozenset(map(tuple, np.round(points[row], 9).tolist())) for row in rows}


def test_a_triangle_with_one_corner_before_the_plane_leaves_two_and_one_with_two_leaves_one():
    points, rows = clip([(0, 0, 1), (4, 0, -1), (0, 4, -1)], [(0, 1, 2)])
    assert figures(points, rows) == {
        frozenset({(2, 0, 0), (4, 0, -1), (0, 4, -1)}),
        frozenset({(2, 0, 0), (0, 4, -1), (0, 2, 0)}),
    }
    points, rows = clip([(0, 0, 1), (4, 0, 1), (0, 4, -1)], [(0, 1, 2)])
    assert figures(points, rows) == {frozenset({(2, 2, 0), (0, 4, -1), (0, 2, 0)})}
    assert (np.cross(*np.diff(points[rows[0]], axis=0)) > 0.0)[2]


@pytest.mark.parametrize("turn", [0, 1, 2])
def test_corners_on_the_plane_are_kept_as_they_are(turn):
    through = np.roll([(0, 0, 1), (0, 4, -1), (4, 0, 0)], turn, axis=0)
    points, rows = clip(through, [(0, 1, 2)])
    assert figures(points, rows) == {frozenset({(0, 2, 0), (0, 4, -1), (4, 0, 0)})}
    points, rows = clip(np.roll([(0, 0, -1), (4, 0, 0), (0, 4, 1e-12)], turn, axis=0), [(0, 1, 2)])
    assert len(rows) == 1 and len(points) == 3
    points, rows = clip(np.roll([(0, 0, 1), (4, 0, 0), (0, 4, 0)], turn, axis=0), [(0, 1, 2)])
    assert len(rows) == 0


def test_of_triangles_on_the_plane_those_stay_that_look_to_the_viewer():
    corners = [(0, 0, 0), (4, 0, 0), (0, 4, 0)]
    assert len(clip(corners, [(0, 1, 2)])[1]) == 1
    assert len(clip(corners, [(0, 2, 1)])[1]) == 0


def test_what_is_left_meets_in_the_same_points_and_nothing_is_lost():
    ball = trimesh.creation.icosphere(3, 10.0)
    rows = ball.faces[ball.triangles_center[:, 0] < 8.0].astype(np.int32)
    points = np.asarray(ball.vertices)
    low = clipped(points, rows, plane(0.3), 1e-9)
    high = clipped(points, rows, plane(-0.3, -UP), 1e-9)
    assert area(*low) + area(*high) == pytest.approx(area(points, rows), rel=1e-12)
    given = {tuple(edge) for edge in borders(rows).tolist()}
    for made, sides in ((low, 1.0), (high, -1.0)):
        assert (sides * (made[0][np.unique(made[1])] @ UP - 0.3)).max() == pytest.approx(0.0, abs=1e-12)
        for a, b in borders(made[1]).tolist():
            ends = made[0][[a, b]]
            on_plane = np.abs(ends @ UP - 0.3).max() < 1e-12
            # An edge of the opening, or a piece of one.
            assert on_plane or (a, b) in given or max(a, b) >= len(points)
    whole = clipped(points, ball.faces.astype(np.int32), plane(0.3), 1e-9)
    assert np.abs(whole[0][borders(whole[1])] @ UP - 0.3).max() < 1e-12


def test_bodies_are_closed_where_each_edge_runs_both_ways():
    points, rows = together(block(), block((5, 0, 0), without=[3]), block((0, 5, 0)))
    assert of_closed_bodies(rows, len(points)).tolist() == [True] * 12 + [False] * 11 + [True] * 12
    # Bodies that meet in a corner alone are two.
    touching = trimesh.Trimesh(*together(block(), block((2, 2, 2), without=[3])), process=True)
    closed = of_closed_bodies(touching.faces.astype(np.int32), len(touching.vertices))
    assert len(touching.vertices) == 15 and closed.sum() == 12
    # A triangle that is turned over leaves its body open.
    points, rows = block()
    assert not of_closed_bodies(np.concatenate([rows[:11], rows[11:, ::-1]]), len(points)).any()


def test_a_closed_body_is_closed_at_the_plane_and_an_open_one_is_not():
    (piece,) = cut(block())
    assert piece.closed and piece.cut
    assert trimesh.Trimesh(piece.points, piece.triangles).volume == pytest.approx(4.0)
    (piece,) = cut(block(without=[0]))
    assert not piece.closed and piece.cut
    ends = piece.points[borders(piece.triangles)][:, :, 2]
    assert ((ends == 0.0).all(axis=1)).sum() >= 3


def test_closed_bodies_beside_an_open_one_are_closed_also_with_a_hollow_inside():
    hollow = trimesh.creation.box((1, 1, 1))
    inner = np.asarray(hollow.vertices), hollow.faces[:, ::-1].astype(np.int32)
    body, rest = cut(together(block(), inner, block((5, 0, 0), without=[3])))
    assert (body.closed, rest.closed) == (True, False)
    assert trimesh.Trimesh(body.points, body.triangles).volume == pytest.approx(4.0 - 0.5)
    assert rest.points[rest.triangles].min(axis=(0, 1)) == pytest.approx([4, -1, -1])


def test_the_hollow_of_an_open_body_is_no_body():
    hollow = trimesh.creation.box((1, 1, 1))
    inner = np.asarray(hollow.vertices), hollow.faces[:, ::-1].astype(np.int32)
    (piece,) = cut(together(block(without=[3]), inner))
    assert not piece.closed and piece.cut


@pytest.mark.parametrize("turned", [1, -1])
def test_all_may_be_turned_inside_out(turned):
    points, rows = together(block(), block((5, 0, 0), without=[3]))
    body, rest = cut((points, rows[:, ::turned]))
    assert (body.closed, rest.closed) == (True, False)
    assert trimesh.Trimesh(body.points, body.triangles).volume == pytest.approx(4.0)


def test_open_bodies_behind_the_plane_stay_and_those_before_it_go():
    open_ones = together(block((0, 0, -3), without=[3]), block())
    (body, rest) = cut(open_ones)
    assert body.closed and not rest.closed and not rest.cut
    assert len(rest.triangles) == 11
    (body,) = cut(together(block((0, 0, 3), without=[3]), block()))
    assert body.closed
    assert cut(block((0, 0, 3), without=[3])) == []


def test_a_flat_sheet_folded_onto_itself_has_no_inside():
    points, rows = [(0, 0, -1), (4, 0, -1), (0, 0, 3)], [(0, 1, 2), (0, 2, 1)]
    (piece,) = cut((points, rows))
    assert not piece.closed
    assert area(piece.points, piece.triangles) == pytest.approx(2 * (8 - 0.5 * 3 * 3))


STEPS = Stepped(UP, RIGHT, np.array([0.0, 0.5, -0.5]), np.array([-0.4, 0.3]))


def test_a_closed_body_is_cut_by_planes_that_step():
    (piece,) = cut(block(), STEPS)
    left = trimesh.Trimesh(piece.points, piece.triangles)
    assert left.is_watertight
    assert left.volume == pytest.approx(2 * (0.6 * 1.0 + 0.7 * 1.5 + 0.7 * 0.5))


def test_an_open_body_is_cut_by_planes_that_step_and_opens_nowhere_else():
    ball = trimesh.creation.icosphere(3, 1.0)
    part = np.asarray(ball.vertices), ball.faces[ball.triangles_center[:, 2] > -0.9].astype(np.int32)
    (piece,) = cut(part, STEPS)
    points, rows = piece.points, piece.triangles
    assert not piece.closed
    x, z = points[rows].mean(axis=1)[:, [0, 2]].T
    assert (z < np.select([x < -0.4, x < 0.3], [0.0, 0.5], -0.5)).all()
    for ends in points[borders(rows)]:
        x, z = ends[:, 0], ends[:, 2]
        on_level = any(np.abs(z - level).max() < 1e-9 for level in STEPS.levels)
        on_step = any(np.abs(x - step).max() < 1e-9 for step in STEPS.steps) and (z > -0.5 - 1e-9).all()
        assert on_level or on_step or (z < -0.8).all()
