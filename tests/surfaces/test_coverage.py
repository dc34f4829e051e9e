"""Pixel ownership: a centre on a shared edge belongs to exactly one side; no gap, nothing twice."""

import numpy as np
import pytest

from hlr.lab.methods import METHODS, SCREEN, Polygons, render
from hlr.lab.methods.viewport import Screen


def triangles(points, faces, cull=False):
    faces = np.asarray(faces, np.int32)
    offsets = np.arange(len(faces) + 1, dtype=np.int32)
    return Polygons(np.asarray(points, float), faces.ravel(), 3 * offsets, offsets, np.full(len(faces), cull))


def owners(polygons, size):
    """How many polygons own each pixel, each rendered alone."""
    count = np.zeros((size[1], size[0]), int)
    for number in range(len(polygons)):
        corners = polygons.corners[3 * number : 3 * number + 3]
        count += render([polygons.points[corners]], SCREEN, size).ids == 0
    return count


def ball(rings=9, around=14, centre=(20.0, 15.5), radius=13.0, grid=2.0):
    """A closed mesh with corners on a coarse grid: many centres lie on edges and corners."""
    points = [(centre[0], centre[1], -radius)]
    for i in range(1, rings):
        a = np.pi * i / rings
        points += [
            (
                centre[0] + radius * np.sin(a) * np.cos(b),
                centre[1] + radius * np.sin(a) * np.sin(b),
                -radius * np.cos(a),
            )
            for b in 2 * np.pi * np.arange(around) / around
        ]
    points.append((centre[0], centre[1], radius))
    at = lambda i, j: 1 + (i - 1) * around + j % around  # noqa: E731
    faces = [(0, at(1, j + 1), at(1, j)) for j in range(around)]
    for i in range(1, rings - 1):
        for j in range(around):
            faces += [(at(i, j), at(i, j + 1), at(i + 1, j)), (at(i + 1, j), at(i, j + 1), at(i + 1, j + 1))]
    faces += [(len(points) - 1, at(rings - 1, j), at(rings - 1, j + 1)) for j in range(around)]
    return triangles(np.round(np.array(points) * grid) / grid, faces)


def test_a_closed_mesh_covers_each_pixel_once_per_layer():
    mesh = ball()
    count = owners(mesh, (40, 31))
    # A convex body has two layers, its front and its back.
    assert set(np.unique(count)) == {0, 2}
    assert (count == 2).sum() > 400


def test_a_net_of_triangles_covers_without_gap_or_double_paint():
    rng = np.random.default_rng(7)
    n = 6
    x, y = np.meshgrid(np.linspace(0, 24, n), np.linspace(0, 20, n))
    points = np.stack([x, y, 0 * x], axis=-1)
    points[1:-1, 1:-1, :2] += np.round(rng.uniform(-1.5, 1.5, (n - 2, n - 2, 2)) * 2) / 2
    at = lambda i, j: i * n + j  # noqa: E731
    faces = []
    for i in range(n - 1):
        for j in range(n - 1):
            faces += [(at(i, j), at(i, j + 1), at(i + 1, j)), (at(i + 1, j), at(i, j + 1), at(i + 1, j + 1))]
    assert (owners(triangles(points.reshape(-1, 3), faces), (24, 20)) == 1).all()


def test_top_and_left_edges_own_their_centres():
    square = [(1.5, 1.5, 0), (4.5, 1.5, 0), (4.5, 3.5, 0), (1.5, 3.5, 0)]
    for method in METHODS:
        ids = render([square], SCREEN, (6, 6), method).ids
        assert np.argwhere(ids == 0).tolist() == [[y, x] for y in (1, 2) for x in (1, 2, 3)], method


def test_slivers_own_nothing_that_they_do_not_contain():
    between = [(0, 1.6, 0), (10, 2.4, 0), (10, 2.49, 0)]  # passes between the centres of rows 1 and 2
    assert (render([between], SCREEN, (10, 5)).ids == -1).all()


def test_shared_corners_belong_to_one():
    fan = [
        [(5.5, 5.5, 0), (5.5 + 4 * np.cos(a), 5.5 + 4 * np.sin(a), 0), (5.5 + 4 * np.cos(b), 5.5 + 4 * np.sin(b), 0)]
        for a, b in zip(np.arange(8) * np.pi / 4, np.arange(1, 9) * np.pi / 4, strict=True)
    ]
    count = sum((render([t], SCREEN, (11, 11)).ids == 0).astype(int) for t in fan)
    assert count[5, 5] == 1 and count.max() == 1


@pytest.mark.parametrize(("rule", "inner"), [("even-odd", -1), ("non-zero", 0)])
def test_inside_rules(rule, inner):
    star = [(10 + 9 * np.sin(a), 10 - 9 * np.cos(a), 0) for a in np.arange(5) * 4 * np.pi / 5]
    for method in METHODS:
        assert render([star], SCREEN, (20, 20), method, rule=rule).ids[10, 10] == inner


def test_a_hole_is_a_hole():
    square, hole = [(0, 0, 0), (8, 0, 0), (8, 8, 0), (0, 8, 0)], [(2, 2, 0), (2, 6, 0), (6, 6, 0), (6, 2, 0)]
    for rule in ("even-odd", "non-zero"):
        assert (render([[square, hole]], SCREEN, (8, 8), rule=rule).ids == 0).sum() == 64 - 16


@pytest.mark.parametrize("method", METHODS)
def test_a_warped_polygon_is_triangulated_and_keeps_its_id(method):
    warped = [(0, 0, 0), (10, 0, 5), (10, 10, 0), (0, 10, 5)]
    behind = [(0, 0, 9), (10, 0, 9), (10, 10, 9), (0, 10, 9)]
    found = render([behind, warped], SCREEN, (10, 10), method)
    assert (found.ids == 1).all()
    assert found.statistics.facets == 3


def test_coplanar_ties_go_to_the_lowest_id():
    a, b = [(0, 0, 1), (6, 0, 1), (6, 6, 1)], [(0, 0, 1), (6, 0, 1), (6, 6, 1), (0, 6, 1)]
    for method in METHODS:
        for first, second in ((a, b), (b, a)):
            ids = render([first, second], SCREEN, (6, 6), method).ids
            alone = render([first], SCREEN, (6, 6)).ids
            assert (ids[alone == 0] == 0).all()


def test_back_faces_of_a_closed_body_are_left_out():
    mesh = ball()
    whole = render(mesh, SCREEN, (40, 31))
    culled = Polygons(mesh.points, mesh.corners, mesh.loops, mesh.polygons, np.full(len(mesh), True))
    for method in METHODS:
        found = render(culled, SCREEN, (40, 31), method)
        assert (found.ids == whole.ids).all()
        assert 0.4 * len(mesh) < found.statistics.culled < 0.6 * len(mesh)
    # Turned inside out, the front is left out.
    inside = Polygons(mesh.points, mesh.corners.reshape(-1, 3)[:, ::-1].ravel(), mesh.loops, mesh.polygons, culled.cull)
    assert (render(inside, SCREEN, (40, 31)).depth[15, 20] > whole.depth[15, 20] + 10).all()


def test_the_larger_convention_mirrors_depth():
    mesh = ball()
    flipped = Polygons(mesh.points * [1, 1, -1], mesh.corners, mesh.loops, mesh.polygons, mesh.cull)
    ids, depth, _ = render(mesh, SCREEN, (40, 31))
    other = render(flipped, Screen(nearer="larger"), (40, 31), "z-buffer", variant="larger")
    assert (other.ids == ids).all() and np.array_equal(other.depth, -depth)
