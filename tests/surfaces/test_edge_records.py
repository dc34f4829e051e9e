"""Entries of the active edge list: x, z and colour, and their changes from row to row."""

from itertools import pairwise

import numpy as np
import pytest

from hlr.lab.methods import METHODS, SCREEN, edge_records, render

A, B, C, D = 2.0, -3.0, 4.0, -100.0
"""A plane, Ax + By + Cz + D = 0: z = 25 - x / 2 + 3 y / 4."""


def on_plane(*corners):
    return [(x, y, -(A * x + B * y + D) / C) for x, y in corners]


TRIANGLE = on_plane((4, 0.5), (20, 16.5), (2, 12.5))
"""Edges: 0 of slope 1 to the right, 1 back at the lower end, 2 of slope -6."""

COLOURS = [(0.0, 0.0, 160.0), (16.0, 0.0, 0.0), (0.0, 48.0, 160.0)]


def records(row):
    return edge_records([TRIANGLE], SCREEN, (24, 20), row, values=COLOURS)


def test_an_entry_of_the_edge_table():
    left, right = records(0)
    # From (4, 0.5) to (2, 12.5): dx = -2 / 12; to (20, 16.5): dx = 16 / 16.
    assert (left.polygon, left.edge, right.edge) == (0, 2, 0)
    assert (left.x, right.x, right.dx) == (4, 4, 1) and left.dx == pytest.approx(-1 / 6, abs=1e-15)
    # -(A / m + B) / C.
    assert right.dz == pytest.approx(-(A * 1 + B) / C, abs=1e-12) == 0.25
    assert left.dz == pytest.approx(-(A * -1 / 6 + B) / C, abs=1e-12)
    assert left.z == right.z == -(A * 4 + B * 0.5 + D) / C
    assert right.values == (0, 0, 160) and right.steps == (1, 0, -10)
    assert left.values == (0, 0, 160) and left.steps == (0, 4, 0)


def test_each_row_is_the_one_before_and_a_step():
    rows = [records(row) for row in range(12)]
    for before, after in pairwise(rows):
        for p, q in zip(before, after, strict=True):
            assert (p.edge, p.dx, p.dz, p.steps) == (q.edge, q.dx, q.dz, q.steps)
            assert q.x == pytest.approx(p.x + p.dx, abs=1e-12)
            assert q.z == pytest.approx(p.z + p.dz, abs=1e-9)
            assert q.values == pytest.approx(np.add(p.values, p.steps), abs=1e-12)
    # The third corner is that of row 12: its edge ends before it, the next one starts there.
    assert [r.edge for r in records(11)] == [2, 0] and [r.edge for r in records(12)] == [1, 0]
    assert records(12)[0].x == pytest.approx(2, abs=1e-12)


def test_a_vertical_edge_has_the_second_constant_alone():
    left, right = edge_records([on_plane((2, 1), (9, 1), (9, 7), (2, 7))], SCREEN, (12, 8), 4)
    assert (left.dx, right.dx) == (0, 0)
    assert left.dz == right.dz == pytest.approx(-B / C, abs=1e-12)
    assert right.z - left.z == pytest.approx(7 * -A / C, abs=1e-9)
    assert left.values is None and left.steps is None


@pytest.mark.parametrize("method", ["scan line", "scan-line z-buffer"])
def test_depths_by_steps_decide_as_exact_ones_do(method):
    # Planes that differ by less than a step by step could tell, over thousands of rows; and the same tie everywhere.
    size = (64, 4096)
    tall = [(3.25, 0), (60.5, 7.75), (41.125, 4096), (9.0, 4001.5)]
    planes = [(0.3, 1e-4, 5.0), (0.3, 1e-4, 5.0 + 1e-11), (-0.3, 2e-4, 9.5), (0.3, 1e-4, 5.0)]
    scene = [[(x, y, a * x + b * y + c) for x, y in tall] for a, b, c in planes]
    for order in (scene, scene[::-1]):
        expected = render(order, SCREEN, size, "ray casting", variant="flat")
        for variant in METHODS[method] if method != "scan line" else (None,):
            found = render(order, SCREEN, size, method, variant=variant)
            assert (found.ids == expected.ids).all() and (found.depth == expected.depth).all()


@pytest.mark.parametrize("shading", ["textbook", "correct"])
def test_colours_by_steps_are_those_of_the_plane(shading):
    found = render([TRIANGLE], SCREEN, (24, 20), values=COLOURS, shading=shading)
    corners = np.array([(x, y, 1.0) for x, y, _ in TRIANGLE])
    plane = np.linalg.solve(corners, np.array(COLOURS))
    rows, columns = np.nonzero(found.ids == 0)
    centres = np.stack([columns + 0.5, rows + 0.5, np.ones(len(rows))], axis=1)
    assert len(rows) > 100
    np.testing.assert_allclose(found.values[rows, columns], centres @ plane, atol=1e-11)
    assert np.isnan(found.values[found.ids < 0]).all()


def test_a_concave_polygon_and_one_with_a_hole_are_shaded_between_their_own_edges():
    outer = [(0, 0, 1), (16, 0, 1), (16, 8, 1), (0, 8, 1)]
    hole = [(6, 2, 1), (6, 6, 1), (10, 6, 1), (10, 2, 1)]
    values = [(x, y, 0.0) for x, y, _ in outer + hole]
    found = render([[outer, hole]], SCREEN, (16, 8), values=values)
    rows, columns = np.nonzero(found.ids == 0)
    assert len(rows) == 16 * 8 - 4 * 4
    np.testing.assert_allclose(found.values[rows, columns, 0], columns + 0.5, atol=1e-12)
    np.testing.assert_allclose(found.values[rows, columns, 1], rows + 0.5, atol=1e-12)
