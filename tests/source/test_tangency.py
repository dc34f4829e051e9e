"""Along an edge two faces are tangent or not: knots, places, and the pieces that angles make."""

import numpy as np
import pytest

from hlr.source import tangency
from hlr.source.geometry import SPLINE
from hlr.source.surfaces import SurfaceKind


def ints(*values):
    return np.array(values, np.int32)


# Knots and places ----------------------------------------------------------------------------------------------------


def test_knots_of_a_spline_curve():
    # Degree 2, three poles, a flag, six knots, and what follows them.
    assert tangency._spline_knots(np.array([2, 3, 1, 10, 11, 12, 13, 14, 15, 99, 98.0])).tolist() == [*range(10, 16)]


def test_knots_of_surfaces():
    curve = [1.0, 2.0, 0.0, 5.0, 6.0, 7.0, 8.0, 0.0]
    revolved = np.array([1, 2, 3, 4, 5, 6.0, SPLINE, *curve])
    extruded = np.array([1, 2, 3.0, SPLINE, *curve])
    knots = [5, 6, 7, 8]

    def of(kind, data):
        return [list(k) for k in tangency._surface_knots(int(kind), data)]

    assert of(SurfaceKind.REVOLUTION, revolved) == [[], knots]
    assert of(SurfaceKind.EXTRUSION, extruded) == [knots, []]
    other = SPLINE + 1
    assert of(SurfaceKind.REVOLUTION, np.array([*revolved[:6], other, *curve])) == [[], []]
    assert of(SurfaceKind.EXTRUSION, np.array([*extruded[:3], other, *curve])) == [[], []]
    assert of(SurfaceKind.OFFSET, np.array([0.5, float(SurfaceKind.EXTRUSION), *extruded])) == [knots, []]
    assert of(SurfaceKind.PLANE, extruded) == [[], []]
    # Degrees 1 and 2, two and three poles, periods 10 and 20; four knots and six.
    u, v = [0, 0, 1, 1], [0, 0, 0, 3, 4, 4]
    spline = np.array([1, 2, 2, 3, 10, 20, *u, *v, 77, 78.0])
    assert of(SurfaceKind.SPLINE, spline) == [[-10, -9, 0, 1, 10, 11], [-20, -17, -16, 0, 3, 4, 20, 23, 24]]


def test_steps_are_divided_but_not_from_one_edge_to_the_next():
    edge, share = tangency._divided(ints(3, 3, 3, 7, 7), np.array([0, 0.5, 1, 0, 1]), ints(2, 4, 9, 2, 5))
    assert edge.tolist() == [3] * 7 + [7] * 3
    assert share.tolist() == [0, 0.25, 0.5, 0.625, 0.75, 0.875, 1, 0, 0.5, 1]


def test_places_in_order_and_each_once():
    edge, share = tangency._ascending(
        ints(2, 1, 1, 1, 2, 1, 2), np.array([0.5, 1, 0.25, 0.25 + 7e-10, 0.5 + 1.5e-9, 0, 0.5])
    )
    assert edge.tolist() == [1, 1, 1, 2, 2] and edge.dtype == np.int32
    assert share.tolist() == [0, 0.25, 1, 0.5, 0.5 + 1.5e-9]
    # Ends of two edges at one share stand twice.
    assert tangency._ascending(ints(1, 2), np.array([0.5, 0.5]))[1].tolist() == [0.5, 0.5]


def test_where_knots_are_passed():
    knots = np.array([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0])
    parameter = np.array([0.5, 2.5, 0.5, 0.5, 1.0, 2.0])
    edge, share = ints(4, 4, 4, 4, 5, 5), np.array([0, 0.4, 0.8, 1, 0, 1])
    found = tangency._crossings(edge, share, parameter, np.array([0, 1, 2, 4]), knots)
    # Forward past 1 and 2, back past both; nothing where it stands still, nor at a knot where a step begins or ends.
    assert found[0].tolist() == [4, 4, 4, 4]
    assert found[1] == pytest.approx([0.1, 0.3, 0.7, 0.5], abs=1e-15)
    assert tangency._crossings(edge, share, parameter, np.array([4]), knots)[1].tolist() == []


def test_cross_products():
    a, b = np.random.default_rng(1).normal(size=(2, 9, 3))
    np.testing.assert_allclose(tangency._cross(a, b), np.cross(a, b), atol=1e-15)


def test_runs_of_equal_flags():
    flag = np.array([True, True, False, True, False, False])
    assert tangency._runs(flag).tolist() == [0, 0, 1, 2, 3, 3]
    assert tangency._run_sums(flag, np.array([1, 2, 4, 8, 16, 32.0])).tolist() == [3, 3, 4, 8, 48, 48]
    assert tangency._run_peaks(flag, np.array([1, 2, 4, 8, 32, 16.0])).tolist() == [2, 2, 4, 8, 32, 32]


def test_the_change_is_found_between_two_places():
    def closer(share):
        return np.where(share < 0.3, 0.0, 0.5), np.zeros((len(share), 3))

    low, high = np.array([0.25, 0.25]), np.array([0.5, 0.75])
    found = tangency._where_tangent(closer, low, high, np.array([True, True]))
    assert found == pytest.approx([0.3, 0.3], abs=0.5 * 2.0**-24)

    def turned(share):
        return np.where(share < 0.3, 0.5, 0.0), np.zeros((len(share), 3))

    assert tangency._where_tangent(turned, low[:1], high[:1], np.array([False])) == pytest.approx(0.3, abs=1e-7)
    none = np.zeros(0)
    assert len(tangency._where_tangent(closer, none, none, np.zeros(0, bool))) == 0


# Pieces --------------------------------------------------------------------------------------------------------------


SHARE = np.linspace(0.0, 1.0, 101)
"""Of an edge of length 10 along x, whose parameter runs from 20 to 40."""


def pieces(angle, share=SHARE, recorded=False):
    """Of an edge with angle(share) between its faces."""
    edge = tangency.FreeEdge((None, None), (20.0, 40.0), recorded)

    def closer(at):
        return angle(at), np.stack([10.0 * at, 0 * at, 0 * at], axis=1)

    found = tangency._pieces(edge, share, angle(share), closer(share)[1], closer)
    assert found.points.shape == (len(found.smooth) - 1, 3)
    assert found.points[:, 0] == pytest.approx(10 * (found.parameters - 20) / 20, abs=1e-6)
    return found.smooth.tolist(), [round(float(p), 4) for p in found.parameters]


def between(low, high, inside, outside):
    return lambda at: np.where((at > low) & (at < high), inside, outside)


def test_one_class_throughout():
    assert pieces(lambda at: 0.0 * at) == ([True], [])
    # A hundredth of a radian is the limit, where it does not waver.
    assert pieces(lambda at: 0.0099 + 0 * at) == ([True], []) and pieces(lambda at: 0.0101 + 0 * at) == ([False], [])
    assert pieces(lambda at: 0.5 + 0 * at) == ([False], [])


@pytest.mark.parametrize(
    ("low", "high", "expected"),
    [
        (0.4, 0.7, ([True, False, True], [28.0, 34.0])),
        (0.4, 2.0, ([True, False], [28.0])),
        (-1.0, 0.4, ([False, True], [28.0])),
        # Of less than a tenth of the edge no tangent piece is made.
        (0.085, 0.5, ([False, True], [30.0])),
        (0.115, 0.5, ([True, False, True], [22.3, 30.0])),
    ],
)
def test_pieces_of_two_classes(low, high, expected):
    assert pieces(between(low, high, 0.5, 0.001)) == expected


def test_a_short_fold_says_nothing():
    # Less than a fiftieth of the length.
    assert pieces(between(0.495, 0.505, 0.5, 0.001)) == ([True], [])
    assert pieces(between(0.485, 0.515, 0.5, 0.001))[0] == [True, False, True]
    # Three of them, together less than two may have; and five, together more.
    three = np.linspace(0.2, 0.8, 3)
    assert pieces(lambda at: np.where(np.abs(at[:, None] - three).min(axis=1) < 0.005, 0.5, 0.001)) == ([True], [])
    several = np.linspace(0.2, 0.8, 5)
    assert pieces(lambda at: np.where(np.abs(at[:, None] - several).min(axis=1) < 0.005, 0.5, 0.001))[0] != [True]


@pytest.mark.parametrize("end", [0.0, 1.0])
def test_the_last_place_counts_half_a_step(end):
    # Of three places at an end, two and a half steps are more than a fiftieth; of two, less.
    assert pieces(lambda at: np.where(np.abs(at - end) < 0.005, 0.5, 0.001)) == ([True], [])
    assert pieces(lambda at: np.where(np.abs(at - end) < 0.015, 0.5, 0.001)) == ([True], [])
    assert pieces(lambda at: np.where(np.abs(at - end) < 0.025, 0.5, 0.001))[0] in ([False, True], [True, False])


def test_what_waves_is_whole():
    # An angle that is nowhere a clear one makes no piece: all or nothing.
    assert pieces(between(0.3, 0.7, 0.09, 0.001)) == ([False], [])
    assert pieces(between(0.3, 0.7, 0.09, 0.001), recorded=True) == ([True], [])
    assert pieces(between(0.3, 0.7, 0.11, 0.001), recorded=True)[0] == [True, False, True]
    # Up to 0.02 rad it is tangent where the mean square is little: 0.018 on a fifth of the edge, not on a third.
    assert pieces(between(0.4, 0.58, 0.018, 0.001)) == ([True], [])
    assert pieces(between(0.3, 0.7, 0.018, 0.001)) == ([False], [])
    assert pieces(between(0.4, 0.46, 0.021, 0.001)) == ([False], [])
    assert pieces(between(0.4, 0.46, 0.0195, 0.001)) == ([True], [])


def test_a_normal_turned_round_says_nothing_where_the_rest_is_tangent():
    assert pieces(between(0.4, 0.7, np.pi - 0.05, 0.001)) == ([True], [])
    assert pieces(between(0.4, 0.7, np.pi - 0.15, 0.001))[0] == [True, False, True]
    # But not where next to nothing else is.
    assert pieces(between(0.05, 2.0, np.pi - 0.05, 0.001)) == ([False], [])


def test_length_counts_and_not_the_number_of_places():
    crowded = np.unique(np.concatenate([np.linspace(0, 0.09, 200), SHARE]))
    assert pieces(between(-1.0, 0.085, 0.001, 0.5), crowded) == ([False], [])
    assert pieces(between(0.005, 0.0199, 0.5, 0.001), crowded) == ([True], [])
    assert pieces(between(0.005, 0.0299, 0.5, 0.001), crowded)[0] == [False, True]


@pytest.mark.parametrize("size", [0.0, 1e-3, 10.0])
def test_length_is_a_share_whatever_the_size(size):
    edge = tangency.FreeEdge((None, None), (0.0, 1.0), False)

    def smooth(places):
        def closer(at):
            return np.where((at > 0.495) & (at < 0.485 + 0.01 * places + 0.01), 0.5, 0.001), size * np.outer(
                at, [1, 0, 0]
            )

        return tangency._pieces(edge, SHARE, *closer(SHARE), closer).smooth.tolist()

    assert smooth(1) == [True] and smooth(3) == [True, False, True]
    # Where places are crowded it is length that counts, however little there is.
    crowded = np.unique(np.concatenate([np.linspace(0, 0.09, 200), SHARE]))
    angle, point = between(0.005, 0.0199, 0.5, 0.001)(crowded), size * np.outer(crowded, [1, 0, 0])
    found = tangency._pieces(edge, crowded, angle, point, lambda at: (at, np.outer(at, [1, 0, 0])))
    assert (found.smooth.tolist() == [True]) == (size > 0.0)
    # Without a length each place counts alike: two of 101 are less than a fiftieth.
    assert size > 0.0 or smooth(2) == [True]


def test_an_edge_without_length_is_one_class():
    edge = tangency.FreeEdge((None, None), (0.0, 1.0), False)
    here = np.zeros((3, 3))
    for angle, smooth in ((0.001, True), (0.5, False)):
        found = tangency._pieces(edge, np.array([0, 0.5, 1]), np.full(3, angle), here, lambda at: (at, here[:0]))
        assert found.smooth.tolist() == [smooth] and len(found.points) == len(found.parameters) == 0
