"""Hatches: which lines each part gets, and where they begin and end."""

import numpy as np
import pytest

from hlr.linework import hatching
from hlr.linework.hatching import Pattern, hatched, patterns_on_sheet

A4 = 210.0


def rectangle(x, y, width, height, hole=False):
    corners = np.array([[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]]) + [x, y]
    return corners[::-1] if hole else corners


def patterns_of(parts, paper):
    """Of one section."""
    return patterns_on_sheet([parts], paper)


def lengths(lines):
    return np.hypot(*(lines[:, 1] - lines[:, 0]).T)


def test_lines_are_at_45_degrees_a_spacing_apart_from_border_to_border():
    lines = hatched([rectangle(0, 0, 60, 40)], Pattern(45.0, 2.0), 0.01)
    way = lines[:, 1] - lines[:, 0]
    assert way[:, 0] == pytest.approx(way[:, 1])
    # Where they cross the left or the lower side: half a spacing from the corner, then each spacing.
    across = (lines[:, 0] @ [-1.0, 1.0]) / np.sqrt(2.0)
    first, last = -60 / np.sqrt(2.0), 40 / np.sqrt(2.0)
    expected = np.arange(-100.0, 100.0) * 2.0 + 1.0
    assert np.sort(across) == pytest.approx(expected[(expected > first) & (expected < last)])
    for ends in lines:
        for x, y in ends:
            assert min(abs(x), abs(x - 60), abs(y), abs(y - 40)) < 1e-9


def test_no_line_is_in_a_hole():
    face = [rectangle(0, 0, 60, 40), rectangle(20, 10, 20, 20, hole=True)]
    lines = hatched(face, Pattern(45.0, 1.0), 0.01)
    assert lengths(lines).sum() * 1.0 == pytest.approx(60 * 40 - 20 * 20, rel=0.01)
    middle = lines.mean(axis=1)
    assert not ((np.abs(middle - [30, 20]) < 10 - 1e-9).all(axis=1)).any()
    borders = np.concatenate([lines[:, 0], lines[:, 1]])
    on_hole = np.isclose(np.abs(borders - [30, 20]).max(axis=1), 10)
    assert on_hole.sum() == pytest.approx(2 * 20 * np.sqrt(2.0), abs=2)


def test_lines_go_through_where_two_faces_overlap():
    """As those of a mesh that passes through itself."""
    one, other = rectangle(0, 0, 30, 30), rectangle(20, 10, 30, 30)
    lines = hatched([one, other], Pattern(45.0, 1.0), 0.01)
    assert lengths(lines).sum() == pytest.approx(2 * 900 - 10 * 20, rel=0.01)
    alone = [hatched([loop], Pattern(45.0, 1.0), 0.01) for loop in (one, other)]
    assert len(lines) < sum(map(len, alone))


def test_lines_shorter_than_asked_for_are_left_out():
    face = [rectangle(0, 0, 10, 10)]
    every, some = (hatched(face, Pattern(45.0, 1.0), least) for least in (0.0, 3.0))
    assert lengths(every).min() < 3.0 <= lengths(some).min()
    assert len(some) == (lengths(every) >= 3.0).sum()


@pytest.mark.parametrize(
    ("side", "paper", "spacing"), [(1, A4, 0.7), (10, A4, 1.0), (20, A4, 2.0), (200, A4, 3.0), (200, 841, 7.0)]
)
def test_large_faces_on_large_sheets_have_wide_spacings(side, paper, spacing):
    assert patterns_of({"a": [rectangle(0, 0, side, side)]}, paper) == {"a": Pattern(45.0, spacing)}


def test_parts_that_touch_differ_and_others_are_alike():
    parts = {
        "left": [rectangle(0, 0, 30, 30)],
        "right": [rectangle(30, 0, 30, 29)],
        "pin": [rectangle(25, 10, 10, 5)],
        "far": [rectangle(0, 100, 30, 28)],
    }
    found = patterns_of(parts, A4)
    assert found["left"] == found["far"] == Pattern(45.0, 3.0)
    assert found["right"] == Pattern(135.0, 3.0)
    assert not any(found["pin"].like(found[other]) for other in ("left", "right"))


def test_a_part_in_the_hole_of_another_touches_it_only_where_the_border_is_near():
    ring = [rectangle(0, 0, 60, 60), rectangle(20, 20, 20, 20, hole=True)]
    close, apart = ([rectangle(20 + gap, 20 + gap, 20 - 2 * gap, 20 - 2 * gap)] for gap in (0.2, 4.0))
    assert patterns_of({"ring": ring, "core": close}, A4)["core"].angle == 135.0
    assert patterns_of({"ring": ring, "core": apart}, A4)["core"].angle == 45.0


@pytest.mark.parametrize(
    "other",
    [
        rectangle(20, 30, 20, 40),
        rectangle(10, 5, 40, 30),
        rectangle(40, 20, 60, 60),
        rectangle(-20, 10, 140, 5),
        rectangle(-20, -20, 140, 100),
    ],
    ids=["through one side", "inside", "over a corner", "across", "around"],
)
def test_parts_that_pass_through_one_another_differ(other):
    """As a stud in the hole of its core diameter does: no corner of the one lies at a side of the other."""
    found = patterns_of({"a": [rectangle(0, 0, 60, 40)], "b": [other]}, A4)
    assert not found["a"].like(found["b"])


def test_a_part_in_a_hole_of_another_does_not_pass_through_it():
    plate = [rectangle(0, 0, 60, 40), rectangle(10, 10, 40, 20, hole=True)]
    inside, beside = [rectangle(20, 15, 10, 10)], [rectangle(70, 0, 60, 40)]
    found = patterns_of({"plate": plate, "inside": inside, "beside": beside}, A4)
    assert found["plate"] == found["beside"]
    assert found["plate"].angle == found["inside"].angle


def test_ten_parts_in_a_fan_that_all_touch_get_patterns_without_end():
    parts = {f"{k}": [np.array([[0, 0], [50.0, 10.0 * k], [50.0, 10.0 * k + 10]])] for k in range(10)}
    found = list(patterns_of(parts, A4).values())
    assert len(set(found)) >= 6


def fan(number: int, length: float):
    """Wedges that meet at their tips."""
    return {f"{k}": [np.array([[0, 0], [length, 10.0 * k], [length, 10.0 * k + 10]])] for k in range(number)}


@pytest.mark.parametrize("length", [1.5, 8.0, 50.0, 300.0])
def test_eighteen_parts_that_all_touch_have_hatches_that_differ(length):
    found = list(patterns_of(fan(18, length), 841.0).values())
    assert not any(one.like(other) for k, one in enumerate(found) for other in found[:k])


def test_more_parts_share_hatches_evenly():
    """A part is like as few of those that it touches as can be."""
    found = list(patterns_of(fan(40, 50.0), A4).values())
    assert max(sum(map(one.like, found)) for one in found) <= 3


def test_comparing_a_few_corners_at_a_time_changes_nothing(monkeypatch):
    parts = {"a": [rectangle(0, 0, 30, 30)], "b": [rectangle(30, 0, 30, 30)], "c": [rectangle(61, 0, 30, 30)]}
    whole = patterns_of(parts, A4)
    monkeypatch.setattr(hatching, "PAIRS", 5)
    assert patterns_of(parts, A4) == whole


def test_huge_drawings_have_a_bounded_number_of_lines():
    face = [rectangle(0, 0, 1e6, 1e6)]
    (pattern,) = patterns_of({"a": face}, 1e6).values()
    assert len(hatched(face, pattern, 0.05)) < 2.0 * hatching.MOST_ACROSS


def test_the_order_of_the_parts_changes_nothing():
    parts = {"b": [rectangle(0, 0, 30, 30)], "a": [rectangle(30, 0, 30, 30)]}
    assert patterns_of(parts, A4) == patterns_of(dict(reversed(parts.items())), A4)


def test_a_part_has_one_hatch_in_all_sections_of_a_sheet():
    left, right = [rectangle(0, 0, 40, 40)], [rectangle(40, 0, 20, 20)]
    one, other = {"a": left, "b": right}, {"a": right, "b": left}
    assert patterns_of(one, A4) != patterns_of(other, A4)
    found = patterns_on_sheet([one, other], A4)
    assert found["a"] == Pattern(45.0, 3.0)
    assert found["b"] == Pattern(135.0, 3.0)


def test_parts_differ_that_touch_in_any_section():
    parts = {name: [rectangle(50 * k, 0, 40, 40 - k)] for k, name in enumerate("abc")}
    close = {"b": [rectangle(0, 0, 9, 9)], "c": [rectangle(9, 0, 8, 8)]}
    assert len({pattern.angle for pattern in patterns_of(parts, A4).values()}) == 1
    found = patterns_on_sheet([parts, close], A4)
    assert found["a"].angle == found["b"].angle != found["c"].angle


def test_the_smallest_section_has_a_few_lines():
    large, small = {"a": [rectangle(0, 0, 90, 90)]}, {"a": [rectangle(0, 0, 4, 4)]}
    found = patterns_on_sheet([large, small], A4)["a"]
    assert found == Pattern(45.0, 1.0)
    assert len(hatched(small["a"], found, 0.1)) >= 3


def test_small_parts_that_all_touch_have_lines_that_do_not_miss_them():
    wheel = {}
    for k in range(18):
        ends = [np.pi / 9.0 * (k + j) for j in (0, 1)]
        wheel[f"{k:02}"] = [np.array([(0.0, 0.0), *((3.0 * np.cos(end), 3.0 * np.sin(end)) for end in ends)])]
    found = patterns_of(wheel, A4)
    assert all(len(hatched(wheel[name], pattern, 0.1)) for name, pattern in found.items())


@pytest.mark.parametrize("turn", [0.0, 0.3, 1.1])
@pytest.mark.parametrize("place", [(0.0, 0.0), (1234.56, -987.6), (-54321.1, 77777.7)])
def test_rounding_does_not_choose_between_equal_parts(turn, place):
    """Three faces of one size in a row: their names decide, and not the last bit of an area, nor that of a length."""
    cosine, sine = np.cos(turn), np.sin(turn)
    matrix = np.array([[cosine, -sine], [sine, cosine]])
    # A side of 8 mm asks for exactly 1 mm from line to line, and what is half a millimetre apart just touches.
    row = {name: [rectangle(8.5 * k, 0, 8, 8) @ matrix.T + place] for k, name in enumerate("bca")}
    found = patterns_of(row, A4)
    assert [(found[name].angle, found[name].spacing) for name in "abc"] == [(45.0, 1.0), (45.0, 1.0), (135.0, 1.0)]
