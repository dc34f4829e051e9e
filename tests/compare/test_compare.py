"""What is changed in a drawing is found and named, with its exact length; nothing is invented where nothing is."""

import math
import random
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from hlr.compare import compare
from hlr.drawing.curve import Arc, Bezier
from hlr.errors import OptionError
from support.drawings import arc, bezier, drawing, line

TURN = 2.0 * math.pi


def plate():
    """Straight lines that meet and cross, arcs, a Bezier curve; visible and hidden, of several classes."""
    return [
        line([[0, 0], [60, 0]], edge=0),
        line([[60, 0], [60, 40]], edge=1),
        line([[60, 40], [0, 40]], edge=2),
        line([[0, 40], [0, 0]], edge=3),
        line([[0, 0], [60, 40]], "smooth", edge=4),
        line([[10, 10], [10, 30], [25, 30]], visible=False, edge=5),
        arc((40, 15), 8, 8, (0, TURN), edge=6),
        arc((20, 20), 12, 5, (0.3, 2.9), 0.4, kind="outline", face=1),
        bezier(3, [[5, 5], [15, 25], [35, -10], [50, 30]], kind="intersection"),
        arc((40, 15), 8, 8, (0, TURN), visible=False, edge=9),
    ]


def scaled(one, by):
    points, curve = one.points * by, one.curve
    if isinstance(curve, Arc):
        curve = Arc(curve.centre * by, curve.axes * by, curve.angles)
    elif curve is not None:
        curve = Bezier(curve.degree, curve.points * by)
    return replace(one, points=points, curve=curve)


def lengths(found):
    return {kind: length for kind, length in found.lengths_mm.items() if length}


def shifted(lines, x, y):
    return [moved(each, x, y) for each in lines]


def moved(each, x, y):
    by, curve = np.array([x, y]), each.curve
    if curve is not None:
        where = "centre" if hasattr(curve, "centre") else "points"
        curve = replace(curve, **{where: getattr(curve, where) + by})
    return replace(each, points=each.points + by, curve=curve)


@pytest.mark.parametrize("register", ["off", "translation"])
def test_a_drawing_is_the_same_as_itself(register):
    found = compare(drawing(plate()), drawing(plate()), register=register)
    assert found.same and found.differences == () and found.summary.startswith("same: ")


@pytest.mark.parametrize("number", range(9))
def test_a_line_that_is_deleted_is_gone(number):
    lines = plate()
    lost = lines[number]
    found = compare(drawing(lines), drawing(lines[:number] + lines[number + 1 :]))
    (one,) = found.differences
    assert (one.kind, one.line_class, one.visible, one.edge) == ("gone", lost.kind, lost.visible, lost.edge)
    assert one.length_mm == pytest.approx(length(lost), abs=0.02)
    if lost.curve is None:
        assert one.length_mm == pytest.approx(length(lost), abs=1e-5)
    assert (one.part, one.side) == ("part 0", "before")
    back = compare(drawing(lines[:number] + lines[number + 1 :]), drawing(lines))
    assert [(each.kind, each.side) for each in back.differences] == [("new", "after")]
    assert back.differences[0].length_mm == one.length_mm


def length(of):
    points = of.points if of.curve is None else fine(of.curve)
    return float(np.hypot(*np.diff(points, axis=0).T).sum())


def fine(curve):
    ends = curve.angles if hasattr(curve, "angles") else (0.0, 1.0)
    return curve.at(np.linspace(*ends, 20_001))


@pytest.mark.parametrize(("number", "x", "y"), [(4, 0.14, -0.14), (6, 0.2, 0.0), (5, 0.15, 0.15), (8, 0.2, -0.2)])
def test_a_line_that_is_moved_has_moved(number, x, y):
    lines = plate()
    lines[number] = replace(lines[number], part=0)
    changed = [moved(each, x, y) if n == number else each for n, each in enumerate(lines)]
    found = compare(drawing(lines), drawing(changed))
    assert {each.kind for each in found.differences} == {"moved"}
    assert all(each.line_class == lines[number].kind for each in found.differences)
    assert 0.1 < max(each.moved_mm for each in found.differences) < 0.3


@pytest.mark.parametrize("ending", ["svg", "pdf", "dxf", "json"])
def test_an_edge_that_was_moved_by_a_millimetre_has_moved_whatever_its_file_rounds(ending, tmp_path):
    """Ten tolerances: half of such lines lay a hundred-thousandth farther off, and were gone and new."""
    heights = 7.123456789 + 5.0 * np.arange(12.0)

    def posts(by):
        return drawing([line([[x + by, 0.0], [x + by, 20.0]]) for x in np.sqrt(heights) * 20.0])

    posts(0.0).save(tmp_path / f"old.{ending}")
    for by in (1.0, -1.0):
        found = compare(tmp_path / f"old.{ending}", posts(by), tolerance_mm=0.1, register="off")
        assert set(lengths(found)) == {"moved"}, (by, found)


def test_how_far_and_how_much_has_moved_is_exact():
    lines = plate()
    found = compare(drawing(lines), drawing([moved(lines[0], 0.0, 0.2), *lines[1:]]))
    (one,) = found.differences
    assert (one.kind, one.length_mm, one.moved_mm) == ("moved", pytest.approx(60.0), pytest.approx(0.2))
    assert one.place == (30.0, 0.0)


def test_visible_and_hidden_swapped():
    lines = plate()
    changed = [replace(each, visible=not each.visible) for each in lines]
    found = compare(drawing(lines[:9]), drawing(changed[:9]))
    assert set(lengths(found)) == {"visibility changed"}
    assert lengths(found)["visibility changed"] == pytest.approx(sum(map(length, lines[:9])), abs=0.1)
    assert {each.became for each in found.differences} == {"visible", "hidden"}
    # The circle is both, before and after.
    assert compare(drawing([lines[6], lines[9]]), drawing([changed[6], changed[9]])).same


def test_a_class_that_has_changed():
    lines = plate()
    changed = [replace(each, kind="seam") if each.kind == "smooth" else each for each in lines]
    (one,) = compare(drawing(lines), drawing(changed)).differences
    assert (one.kind, one.line_class, one.became) == ("class changed", "smooth", "seam")
    assert one.length_mm == pytest.approx(math.hypot(60, 40))


@pytest.mark.parametrize(("x", "y"), [(0.2, 0.0), (37.123, -12.7), (-500.0, 250.25)])
def test_the_shift_of_a_whole_drawing_is_found_and_told(x, y):
    before, after = drawing(plate()), drawing(shifted(plate(), x, y))
    assert not compare(before, after).same
    found = compare(before, after, register="translation")
    assert found.same
    assert found.shift == (pytest.approx(-x, abs=2e-3), pytest.approx(-y, abs=2e-3))
    assert "moved by (" in found.summary


@pytest.mark.slow
def test_a_drawing_that_has_moved_and_changed_is_registered_by_what_is_the_same():
    lines = plate()
    after = drawing([*shifted(lines[1:], 13.0, 7.5), line([[100, 90], [140, 90]]), line([[100, 95], [100, 120]])])
    found = compare(drawing(lines), after, register="translation")
    assert found.shift == (pytest.approx(-13.0, abs=2e-3), pytest.approx(-7.5, abs=2e-3))
    assert lengths(found) == {"gone": pytest.approx(60.0, abs=0.01), "new": pytest.approx(65.0, abs=0.01)}


def test_drawings_at_other_scales_differ_and_are_compared_at_the_scale_of_the_first(tmp_path):
    half = [scaled(one, 0.5) for one in plate()]
    before, after = drawing(plate(), scale=2.0), drawing(half, scale=1.0)
    for other in (after, after.save(tmp_path / "after.svg"), after.save(tmp_path / "after.json")):
        found = compare(before, other)
        assert not found.same and not found.differences and found.scales == (2.0, 1.0)
        assert found.summary.startswith("scale 2:1, now 1:1; at the scale of the first: same: ")
        assert found.to_dict()["scales"] == [2.0, 1.0]
    (one,) = compare(before, drawing(half[1:], scale=1.0)).differences
    assert (one.kind, one.length_mm) == ("gone", 60.0)
    assert compare(before, drawing(plate(), scale=2.0 + 1e-6)).same


def test_order_direction_and_where_lines_are_split_make_no_difference():
    mixed = random.Random(1)
    pieces = []
    for each in plate():
        points = each.points if each.curve is None else fine(each.curve)[::50]
        points = np.concatenate(
            [[a + (b - a) * t for t in (0.0, 0.31, 0.8)] for a, b in pairwise(points)] + [points[-1:]]
        )
        at = 0
        while at < len(points) - 1:
            step = mixed.randint(1, 9)
            part = points[at : at + step + 1]
            pieces.append(replace(line(part[:: mixed.choice((1, -1))]), kind=each.kind, visible=each.visible))
            at += step
    pieces += pieces[::7]
    mixed.shuffle(pieces)
    for a, b in ((plate(), pieces), (pieces, plate())):
        found = compare(drawing(a), drawing(b))
        assert found.same, found.summary


def test_lines_on_top_of_one_another_count_once():
    lines = plate()
    halves = [line([[45, 30], [60, 40]], "smooth"), line([[50, 100 / 3], [30, 20]], "smooth")]
    circle = replace(line(fine(lines[6].curve)[::-100]), kind=lines[6].kind)
    twice = [*lines, lines[4], *halves, circle]
    rest = [each for n, each in enumerate(lines) if n not in (4, 6)]
    expected = {"gone": pytest.approx(math.hypot(60, 40) + 16 * math.pi, abs=0.02)}
    assert lengths(compare(drawing(twice), drawing(rest))) == expected
    assert lengths(compare(drawing(rest), drawing(twice))) == {"new": expected["gone"]}
    seams = [replace(each, kind="seam") for each in twice]
    assert lengths(compare(drawing([lines[4], *halves]), drawing(seams)))["class changed"] == pytest.approx(
        math.hypot(60, 40), abs=0.001
    )
    # Lines a tolerance apart are two.
    assert lengths(compare(drawing([]), drawing([lines[0], moved(lines[0], 0.0, 0.1)]))) == {"new": 120.0}


def test_a_longer_line_differs_by_what_it_is_longer():
    found = compare(drawing([line([[0, 0], [10, 0]])]), drawing([line([[-0.05, 0], [10.3, 0]])]))
    assert lengths(found) == {"new": pytest.approx(0.3)}


def test_lines_that_cross_cover_nothing_of_one_another():
    crossing = [line([[x, -5], [x + 3, 5]]) for x in range(30)]
    found = compare(drawing([line([[0, 0], [30, 0]]), *crossing]), drawing(crossing))
    assert lengths(found) == {"gone": pytest.approx(30.0)}


def test_a_line_that_specks_lie_on_is_gone_as_one():
    crossing = [line([[x, -0.05], [x + 0.3, 0.05]]) for x in range(0, 24, 8)]
    (one,) = compare(drawing([line([[-10, 0], [40, 0]]), *crossing]), drawing(crossing)).differences
    assert (one.kind, one.length_mm) == ("gone", pytest.approx(50.0))


def test_less_than_the_tolerance_is_no_difference():
    lines = plate()
    assert compare(drawing(lines), drawing(shifted(lines, 0.04, 0.05))).same
    assert not compare(drawing(lines), drawing(shifted(lines, 0.04, 0.05)), tolerance_mm=0.01).same


def test_a_speck_far_from_all_lines_is_found():
    found = compare(drawing(plate()), drawing([*plate(), line([[80, 80], [80.03, 80]])]))
    assert lengths(found) == {"new": pytest.approx(0.03)}


def test_empty_drawings():
    assert compare(drawing([]), drawing([])).same
    assert compare(drawing([]), drawing([]), register="translation").same
    found = compare(drawing([]), drawing([line([[0, 0], [10, 0]])]), register="translation")
    assert lengths(found) == {"new": 10.0}
    assert found.to_svg() and found.to_png()


@pytest.mark.parametrize(
    "changes", [{"tolerance_mm": t} for t in (0.0, math.nan, "0.1", None, True)] + [{"register": "turn"}]
)
def test_options_out_of_range_are_refused(changes):
    with pytest.raises(OptionError, match=next(iter(changes)).partition("_")[0]):
        compare(drawing([]), drawing([]), **changes)


@pytest.mark.slow
def test_a_hundred_thousand_lines_take_seconds():
    # Quick enough for a test: a tenth of them. The time grows with their number.
    made = np.random.default_rng(1)
    start = made.uniform(0, 200, (10_000, 2))
    lines = [line([a, a + d]) for a, d in zip(start, made.normal(0, 1.5, (10_000, 2)), strict=True)]
    found = compare(drawing(lines), drawing(lines[::-1]))
    assert found.same
