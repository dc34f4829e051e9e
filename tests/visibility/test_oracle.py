"""The oracle against places worked out by hand, and against its own second way of counting."""

from __future__ import annotations

import itertools
import random
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support.visibility import oracle, scenes
from support.visibility.oracle import Segment, Triangle

SQUARE: list[Triangle] = [((0, 0, 0), (4, 0, 0), (4, 4, 0)), ((0, 0, 0), (4, 4, 0), (0, 4, 0))]
THIRD, HALF = Fraction(1, 3), Fraction(1, 2)


@pytest.mark.parametrize(
    ("segment", "expected"),
    [
        (((1, 1, 1), (3, 1, 1)), [(0, 1, 1)]),  # behind
        (((1, 1, -1), (3, 1, -1)), [(0, 1, 0)]),  # before
        (((1, 1, 0), (3, 1, 0)), [(0, 1, 0)]),  # on the face: a face does not hide what lies on it
        (((2, 1, 1), (6, 1, 1)), [(0, HALF, 1), (HALF, 1, 0)]),  # out from behind
        (((1, 1, -1), (3, 1, 1)), [(0, HALF, 0), (HALF, 1, 1)]),  # through
        (((1, 1, 0), (3, 1, 1)), [(0, 1, 1)]),  # dives behind from the face: hidden from 0, no stub
        (((0, 0, 1), (4, 4, 1)), [(0, 1, 1)]),  # along the diagonal two triangles share: no gap, not twice
        (((-2, -2, 1), (4, 4, 1)), [(0, THIRD, 0), (THIRD, 1, 1)]),  # enters at a corner
        (((-2, 2, 1), (2, -2, 1)), [(0, 1, 0)]),  # touches a corner
        (((4, 0, 1), (4, 4, 1)), [(0, 1, 0)]),  # under the right border: moved by +x off it
        (((0, 0, 1), (0, 4, 1)), [(0, 1, 1)]),  # under the left border: moved by +x inside
        (((0, 0, 1), (4, 0, 1)), [(0, 1, 1)]),  # under the lower border: moved by +y inside
        (((0, 4, 1), (4, 4, 1)), [(0, 1, 0)]),
        (((0, 0, 0), (0, 4, 0)), [(0, 1, 0)]),  # the border itself
    ],
)
def test_a_square(segment: Segment, expected: list[tuple[Fraction, Fraction, int]]) -> None:
    assert oracle.intervals(segment, SQUARE) == expected


def test_the_other_side_decides_the_other_way() -> None:
    right: Segment = ((4, 0, 1), (4, 4, 1))
    assert oracle.intervals(right, SQUARE, side=-1) == [(0, 1, 1)]
    assert oracle.states_either_side(right, SQUARE) == [(0, 1, False)]
    assert oracle.states_either_side(((2, 1, 1), (6, 1, 1)), SQUARE) == [(0, HALF, True), (HALF, 1, False)]


def test_edge_on_faces_hide_nothing() -> None:
    standing: Triangle = ((0, 0, 0), (4, 0, 0), (2, 0, 5))
    assert oracle.intervals(((1, 0, 3), (3, 0, 3)), [standing]) == [(0, 1, 0)]


def test_invisibility_counts_faces_not_parts() -> None:
    twice = [*SQUARE, *[tuple((x, y, z + 1) for x, y, z in triangle) for triangle in SQUARE]]
    assert oracle.intervals(((1, 2, 5), (7, 2, 5)), twice) == [(0, HALF, 2), (HALF, 1, 0)]  # type: ignore[arg-type]
    assert oracle.intervals(((1, 2, 5), (7, 2, 5)), SQUARE * 3)[0].invisibility == 3


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(80))
def test_intervals_against_counting_at_their_middles(seed: int) -> None:
    scene = scenes.scene(seed)
    triangles = scene.triangles()
    rng = random.Random(seed)
    edges = scene.edges()
    for edge in rng.sample(edges, min(5, len(edges))):
        segment = scene.segment(edge)
        for side in (1, -1):
            found = oracle.intervals(segment, triangles, side)
            assert (found[0].t0, found[-1].t1) == (0, 1)
            assert all(one.t1 == next.t0 for one, next in itertools.pairwise(found))
            for t0, t1, count in found:
                for share in (Fraction(1, 1000), Fraction(rng.randint(1, 998), 999), Fraction(999, 1000)):
                    assert oracle.invisibility_at(segment, triangles, t0 + share * (t1 - t0), side) == count


coordinate = st.integers(0, 4)
point = st.tuples(coordinate, coordinate, coordinate)
triangle = st.tuples(point, point, point)


@pytest.mark.slow
@settings(max_examples=150, deadline=None)
@given(st.tuples(point, point), st.lists(triangle, max_size=5), st.permutations(range(3)))
def test_winding_does_not_matter_and_triangles_add_up(
    segment: Segment, triangles: list[Triangle], order: list[int]
) -> None:
    found = oracle.intervals(segment, triangles)
    turned = [(t[order[0]], t[order[1]], t[order[2]]) for t in triangles]
    assert oracle.intervals(segment, turned) == found
    alone = [oracle.intervals(segment, [t]) for t in triangles]
    for t0, t1, count in found:
        place = t0 + (t1 - t0) * Fraction(500009, 1000003)  # not where two of the same count meet
        assert count == sum(i.invisibility for each in alone for i in each if i.t0 < place < i.t1)


@pytest.mark.slow
@settings(max_examples=150, deadline=None)
@given(st.tuples(point, point), st.lists(triangle, max_size=5))
def test_a_segment_may_be_drawn_from_either_end(segment: Segment, triangles: list[Triangle]) -> None:
    back = oracle.intervals((segment[1], segment[0]), triangles)
    assert [(1 - t1, 1 - t0, count) for t0, t1, count in reversed(back)] == oracle.intervals(segment, triangles)
