"""Strokes of a hatch inside a face: against points sampled along them, also through corners and in holes."""

import numpy as np
import pytest

from hlr.drawing.hatch_pattern import Row
from hlr.linework import hatch_strokes
from hlr.linework.hatch_strokes import inside, strokes_within, uncovered

SQUARE = np.array([(0, 0), (10, 0), (10, 10), (0, 10)], float)
HOLE = np.array([(3, 3), (3, 7), (7, 7), (7, 3)], float)
STAR = np.array(
    [(5 + r * np.cos(t), 5 + r * np.sin(t)) for t, r in zip(np.arange(10) * 0.2 * np.pi, [5, 2] * 5, strict=True)]
)


def sides(*loops):
    return np.concatenate([np.stack([loop, np.roll(loop, -1, axis=0)], axis=1) for loop in loops])


def holds(points, own):
    """By the even-odd rule, along a ray to the right."""
    (x0, y0), (x1, y1) = own[:, 0].T, own[:, 1].T
    up = (y0[None] > points[:, 1:]) != (y1[None] > points[:, 1:])
    with np.errstate(divide="ignore", invalid="ignore"):
        x = x0 + (points[:, 1:] - y0) / (y1 - y0) * (x1 - x0)
    return (up & (x > points[:, :1])).sum(axis=1) % 2 == 1


@pytest.mark.parametrize("rows", [1, 10**6])
@pytest.mark.parametrize("own", [sides(SQUARE), sides(SQUARE, HOLE), sides(STAR)])
def test_what_is_kept_is_what_lies_inside(own, rows, monkeypatch):
    monkeypatch.setattr(hatch_strokes, "CROSSINGS", rows)
    rng = np.random.default_rng(3)
    strokes = rng.uniform(-4, 14, (60, 2, 2))
    strokes[:3] = [[(-1, -1), (11, 11)], [(3.5, -1), (3.5, 11)], [(5, 5), (5.5, 5.0)]]
    kept = inside(strokes, own)
    share = (np.arange(4000) + 0.5) / 4000
    places = strokes[:, None, 0] + share[None, :, None] * (strokes[:, None, 1] - strokes[:, None, 0])
    lengths = np.hypot(*(strokes[:, 1] - strokes[:, 0]).T)
    expected = holds(places.reshape(-1, 2), own).reshape(-1, 4000).mean(axis=1) * lengths
    assert np.hypot(*(kept[:, 1] - kept[:, 0]).T).sum() == pytest.approx(expected.sum(), abs=0.2)
    assert holds(kept.mean(axis=1), own).all()


def test_a_stroke_along_a_side_is_inside_or_not_as_a_whole():
    for stroke in ([(-1, 0), (11, 0)], [(-1, 10), (11, 10)], [(3, -1), (3, 11)]):
        kept = inside(np.array([stroke], float), sides(SQUARE, HOLE))
        length = np.hypot(*(kept[:, 1] - kept[:, 0]).T).sum()
        assert round(float(length), 9) in (0.0, 10.0, 6.0)


def test_rows_cover_the_box_and_no_more():
    row = Row(np.zeros(2), np.array([0.6, 0.8]), np.array([-1.6, 1.2]), ())
    found = strokes_within((row,), np.array([10.0, -3.0]), np.array([14.0, 9.0]))
    across = found[:, 0] @ [-0.8, 0.6]
    assert np.diff(np.sort(across)) == pytest.approx(2.0)
    corners = np.array([[x, y] for x in (10.0, 14.0) for y in (-3.0, 9.0)]) @ [-0.8, 0.6]
    assert across.min() - corners.min() < 2.0 and corners.max() - across.max() < 2.0


def test_too_many_are_none():
    row = Row(np.zeros(2), np.array([1.0, 0.0]), np.array([0.0, 1e-4]), ())
    assert strokes_within((row,), np.zeros(2), np.array([1.0, 100.0])) is None
    dots = Row(np.zeros(2), np.array([1.0, 0.0]), np.array([0.0, 1.0]), (1e-4, -1e-4))
    assert strokes_within((dots,), np.zeros(2), np.array([100.0, 100.0])) is None


def test_what_is_uncovered_is_all_that_is_not_inside(monkeypatch):
    rng = np.random.default_rng(7)
    strokes = rng.uniform(-4.0, 14.0, (40, 2, 2))
    # Two squares that overlap, the second of them with a hole.
    own = np.concatenate([sides(SQUARE, HOLE), sides(SQUARE) + [6.0, 5.0]])
    whole, covered, left = (
        np.hypot(*(some[:, 1] - some[:, 0]).T).sum()
        for some in (strokes, inside(strokes, own, winding=True), uncovered(strokes, own))
    )
    assert covered + left == pytest.approx(whole)
    again = np.concatenate([inside(uncovered(strokes, own), own, winding=True)])
    assert np.hypot(*(again[:, 1] - again[:, 0]).T).sum() == pytest.approx(0.0, abs=1e-9)
    assert len(uncovered(strokes, np.zeros((0, 2, 2)))) == len(strokes)
    expected = uncovered(strokes, own)
    monkeypatch.setattr(hatch_strokes, "CROSSINGS", 20)
    assert uncovered(strokes, own) == pytest.approx(expected)
