"""A thread in a section: where the lines of two hatches run alike with other spacings, a tooth may have strokes in
one drawing and none in the other. The lines of the other then run in the gaps on both sides: that is no difference.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.compare import compare
from hlr.linework.hatching import Pattern, hatched
from support.drawings import drawing, line, part

TEETH = 12


def screw_in_nut() -> cq.Assembly:
    corners = [(0.0, 0.0), (5.0, 0.0)]
    for k in range(TEETH):
        corners += [(5, 1.5 * k + 0.2), (6, 1.5 * k + 0.6), (6, 1.5 * k + 0.9), (5, 1.5 * k + 1.3)]
    corners += [(5, 1.5 * TEETH), (0, 1.5 * TEETH)]
    screw = cq.Workplane("XZ").polyline(corners).close().revolve(360, (0, 0, 0), (0, 1, 0))
    nut = cq.Workplane().box(30, 20, 12, centered=(True, True, False)).translate((0, 0, 3)).cut(screw)
    washer = cq.Workplane().circle(9).circle(6.2).extrude(2).translate((0, 0, 15))
    made = cq.Assembly()
    for name, shape in {"screw": screw, "nut": nut, "washer": washer}.items():
        made.add(shape, name=name)
    return made


@pytest.fixture(scope="module")
def page() -> hlr.Drawing:
    return hlr.draw_arranged(screw_in_nut(), section={"front": 0.0, "left": 9.0, "top": 8.0}, scale=5, page="A0")


@pytest.fixture(scope="module")
def alone() -> hlr.Drawing:
    return hlr.draw(screw_in_nut(), "front", section=0.0, scale=5)


def test_a_section_by_itself_is_the_same_as_on_its_page(page, alone):
    for found in (compare(page, alone), compare(alone, page)):
        assert found.same and found.rehatched == ("nut", "screw"), found.summary


def test_a_screw_that_is_left_whole_is_a_difference(alone):
    whole = hlr.draw(screw_in_nut(), "front", section=0.0, scale=5, uncut=["screw"])
    gone = [each for each in compare(alone, whole).differences if each.line_class == "hatch"]
    assert {each.part for each in gone} == {"screw"}
    assert sum(each.length_mm for each in gone) > 1000.0


def comb(pattern: Pattern, teeth: int = TEETH) -> hlr.Drawing:
    """Teeth along a bar. teeth: so many of the twelve are hatched, and with them the bar below"""
    bar = [np.array([(0, 0), (48, 0), (48, 5), (0, 5)], float)]
    every = [np.array([(4 * k, 5), (4 * k + 1.5, 5), (4 * k + 1.5, 25), (4 * k, 25)], float) for k in range(TEETH)]
    lines = [line([a, b]) for loop in (*bar, *every) for a, b in zip(loop, np.roll(loop, -1, axis=0), strict=True)]
    lines += [line(ends, "hatch", part=0) for ends in hatched([*bar, *every[:teeth]], pattern, 0.05)]
    return drawing(lines, parts=[part("comb")])


@pytest.mark.parametrize("angle", [45.0, 135.0])
@pytest.mark.parametrize("spacings", [(2.0, 4.0), (7.0, 4.0), (1.0, 1.5), (0.7, 7.0)])
def test_teeth_have_the_same_area_with_any_spacing(angle, spacings):
    one, other = (comb(Pattern(angle, spacing)) for spacing in spacings)
    for found in (compare(one, other), compare(other, one)):
        assert found.same, found.summary


@pytest.mark.parametrize("angle", [45.0, 135.0])
def test_teeth_without_a_hatch_differ_where_the_lines_are_the_same_or_cross(angle):
    few = comb(Pattern(45.0, 1.0), teeth=6)
    found = compare(comb(Pattern(angle, 1.0)), few)
    assert {each.kind for each in found.differences} == {"gone"} and found.lengths_mm["gone"] > 60.0
