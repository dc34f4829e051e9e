"""Warnock's subdivision, area by area: how each ends, and where the sorted list need not be read to its end."""

import numpy as np
import pytest
from surfaces.random_scenes import KINDS, SIZE

from hlr.lab.methods import SCREEN, Area, areas_table, render, trace_svg


def box(x0, y0, x1, y1, z):
    depth = z if callable(z) else lambda x, y: z
    return [(x, y, depth(x, y)) for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))]


SCENE = [
    box(-1, -1, 9, 4, 50),  # 0 fills the upper half
    box(0, 0, 4, 4, 10),  # 1 fills the first quarter
    box(1, 1, 3, 3, 20),  # 2 is behind 1
    box(6, 0, 8, 2, 30),  # 3 in the corner, before 0
    [(5, 5, 5), (8, 5, 5), (5, 8, 5)],  # 4 alone
]
"""By nearest depth: 4, 1, 2, 3, 0."""

AREAS = [
    # columns, rows, level, polygons, passed over, ending, seen
    ((0, 8), (0, 8), 0, 5, 0, "quartered", -1),
    ((0, 4), (0, 4), 1, 1, 3, "d", 1),  # 1 surrounds: 2, 3 and 0 begin behind it
    ((4, 8), (0, 4), 1, 2, 0, "quartered", -1),
    ((4, 6), (0, 2), 2, 1, 0, "c", 0),
    ((6, 8), (0, 2), 2, 1, 1, "d", 3),  # 3 surrounds: 0 begins behind it
    ((4, 6), (2, 4), 2, 1, 0, "c", 0),
    ((6, 8), (2, 4), 2, 1, 0, "c", 0),
    ((0, 4), (4, 8), 1, 0, 0, "a", -1),
    ((4, 8), (4, 8), 1, 1, 0, "b", 4),
]


def test_areas_of_a_worked_example():
    found = render(SCENE, SCREEN, (8, 8), "warnock", trace=True)
    assert found.areas == tuple(Area(*area) for area in AREAS)
    counted = found.statistics
    assert (counted.recursion, counted.deepest) == (len(AREAS), 2)
    assert (counted.early_stops, counted.passed_over) == (2, 4)
    assert (found.ids == render(SCENE, SCREEN, (8, 8)).ids).all()


def test_areas_as_a_table_and_as_a_picture():
    found = render(SCENE, SCREEN, (8, 8), "warnock", trace=True)
    table = areas_table(found.areas).splitlines()
    assert len(table) == 2 + len(AREAS)
    assert table[3] == "| &nbsp;&nbsp;0-3 | 0-3 | 1 | 3 | d | 1 |"
    drawn = trace_svg(SCENE, SCREEN, (8, 8), "warnock")
    areas = drawn[drawn.index('class="areas"') :].partition("</g>")[0]
    assert areas.count("<rect") == len(AREAS)
    assert [areas.count(f">{ending}</text>") for ending in "abcd"] == [1, 1, 3, 2]
    assert 'class="areas"' not in trace_svg(SCENE, SCREEN, (8, 8))
    assert render(SCENE, SCREEN, (8, 8), "warnock").areas == ()


def ends(scene, size=(8, 8)):
    first = render(scene, SCREEN, size, "warnock", trace=True).areas[0]
    return first.ending, first.polygons, first.passed_over, first.id


def rising(start):
    return box(-1, -1, 9, 9, lambda x, y: start + 2 * x - y)


def test_the_farthest_corner_of_what_surrounds_ends_the_list():
    # In front 2 x - y: 15 - 0.5 at the farthest centre, upper right.
    assert ends([rising(0), box(2, 2, 3, 3, 15)]) == ("d", 1, 1, 0)
    assert ends([rising(0), box(2, 2, 3, 3, 14.75)]) == ("d", 1, 1, 0)
    # As near as that it is read. It is hidden all the same: at all corners its plane is not before the other one.
    assert ends([rising(0), box(2, 2, 3, 3, 14.5)]) == ("d", 2, 0, 0)
    # What rises alike begins before that, and is found behind at all four corners.
    assert ends([rising(0), box(2, 2, 3, 3, lambda x, y: 4 + 2 * x - y)]) == ("d", 2, 0, 0)
    # And this one is behind there only, where it is.
    assert ends([rising(0), box(1, 1, 3, 3, 12)])[0] == "quartered"


@pytest.mark.parametrize(
    ("turn", "far"), [((1, 1), 14), ((1, -1), 7), ((-1, 1), 7), ((-1, -1), 0)], ids=["right", "up", "left", "back"]
)
def test_the_farthest_corner_may_be_any(turn, far):
    a, b = turn
    slope = box(-1, -1, 9, 9, lambda x, y: a * (x - 0.5) + b * (y - 0.5))
    assert ends([slope, box(2, 2, 3, 3, far + 0.25)]) == ("d", 1, 1, 0)
    assert ends([slope, box(2, 2, 3, 3, far)])[1:3] == (2, 0)


def test_a_tie_is_read_and_the_lower_id_wins():
    behind = [box(2, 2, 3, 3, 10), box(-1, -1, 9, 9, 10)]
    found = render(behind, SCREEN, (8, 8), "warnock", trace=True)
    assert found.areas[0].passed_over == 0
    assert (found.ids == render(behind, SCREEN, (8, 8)).ids).all() and found.ids[2, 2] == 0


def test_a_polygon_as_large_as_the_area_surrounds_it():
    assert ends([box(0, 0, 8, 8, 1), box(1, 1, 3, 3, 2)]) == ("d", 1, 1, 0)
    # But for one that misses a centre.
    corner = [(0, 0, 1), (8, 0, 1), (8, 8, 1), (1.5, 8, 1)]
    assert ends([corner, box(1, 1, 3, 3, 2)])[0] == "quartered"


@pytest.mark.parametrize("kind", KINDS)
def test_every_pixel_is_in_one_area_that_is_not_quartered(kind):
    stops = 0
    for seed in range(40):
        found = render(KINDS[kind](seed), SCREEN, SIZE, "warnock", trace=True)
        stops += found.statistics.early_stops
        counted = np.zeros(SIZE[::-1], int)
        for area in found.areas:
            counted[slice(*area.rows), slice(*area.columns)] += area.ending != "quartered"
        assert (counted == 1).all()
        assert len(found.areas) == found.statistics.recursion
        assert sum(area.passed_over for area in found.areas) == found.statistics.passed_over
    assert stops > 0
