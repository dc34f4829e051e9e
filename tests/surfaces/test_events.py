"""Events of the active lists: starts and ends are counted, and crossings between them are swaps."""

from itertools import pairwise

import pytest
from surfaces.random_scenes import SIZE, interpenetrating

from hlr.lab.methods import SCREEN, active_edges, render

SCANNING = [
    ("scan line", None),
    ("span list", None),
    ("scan-line z-buffer", "merged"),
    ("scan-line z-buffer", "per polygon"),
]


def rectangle(x0, y0, x1, y1, z):
    return [(x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z)]


@pytest.mark.parametrize(("method", "variant"), SCANNING)
def test_every_edge_starts_once_and_ends_once(method, variant):
    # Horizontal edges are none; of two rectangles one reaches the last row, and there is a gap between them.
    scene = [rectangle(1, 1, 5, 3, 1), rectangle(2, 6, 7, 9, 1), [(10, 0, 1), (14, 9, 1), (8, 5, 1)]]
    found = render(scene, SCREEN, (16, 9), method, variant=variant).statistics
    assert (found.edge_starts, found.edge_ends) == (7, 7)


@pytest.mark.parametrize(("method", "variant"), SCANNING)
@pytest.mark.parametrize("seed", range(5))
def test_events_are_those_of_the_rows(method, variant, seed):
    scene = interpenetrating(seed)
    found = render(scene, SCREEN, SIZE, method, variant=variant).statistics
    rows = [{(p, e) for p, e, _ in active_edges(scene, SCREEN, SIZE, y)} for y in range(SIZE[1])]
    starts = len(rows[0]) + sum(len(b - a) for a, b in pairwise(rows))
    assert found.edge_starts == found.edge_ends == starts


def test_spans_start_and_end_and_cross():
    # Two rows of three rectangles behind one another, then a slope that passes through one of them.
    apart = [rectangle(1, 0, 20, 2, 30), rectangle(4, 0, 12, 2, 20), rectangle(7, 0, 15, 2, 10)]
    found = render(apart, SCREEN, (24, 2), "span list").statistics
    assert (found.span_starts, found.span_ends, found.swaps) == (6, 6, 0)
    slope = [(1, 0, 1), (20, 0, 20), (20, 2, 20), (1, 2, 1)]
    found = render([slope, rectangle(2, 0, 19, 2, 10.4)], SCREEN, (24, 2), "span list").statistics
    assert (found.span_starts, found.span_ends, found.swaps) == (4, 4, 2)
    assert render(apart, SCREEN, (24, 2), "scan line").statistics.span_starts == 0
