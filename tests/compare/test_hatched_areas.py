"""Hatches are compared by the areas that they fill: which lines a part is hatched with depends on what else is on the
sheet."""

from dataclasses import replace

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.compare import compare
from hlr.compare.failing import fails
from hlr.compare.matching.sections import likeness
from hlr.compare.reading.sides import side_of
from hlr.linework.hatching import Pattern, hatched
from hlr.request.style_file import style_of
from support.drawings import drawing, line, part

PATTERNS = [
    Pattern(45.0, 2.0),
    Pattern(135.0, 2.0),
    Pattern(45.0, 1.0),
    Pattern(45.0, 1.5),
    Pattern(135.0, 0.7),
    Pattern(30.0, 3.0),
    Pattern(120.0, 2.0),
]

WHOLE, LEFT = (0, 0, 40, 30), (0, 0, 20, 30)


def rectangle(x0, y0, x1, y1):
    return np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], float)


def section(faces, outlines=(WHOLE, LEFT), parts=("plate", "pin")):
    """A drawing of rectangles, some of them hatched. faces: of each the number of its part, rectangle and pattern"""
    lines = []
    for corners in map(rectangle, *zip(*outlines, strict=True)):
        lines += [line([a, b]) for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)]
    for number, face, pattern in faces:
        lines += [line(ends, "hatch", part=number) for ends in hatched([rectangle(*face)], pattern, 0.05)]
    return drawing(lines, parts=[part(name) for name in parts])


def hatch_mm(found):
    """Of each kind of difference, all of hatches."""
    assert {each.line_class for each in found.differences} <= {"hatch"}
    return {kind: length for kind, length in found.lengths_mm.items() if length}


@pytest.mark.parametrize("one", PATTERNS)
@pytest.mark.parametrize("other", PATTERNS)
def test_other_lines_in_the_same_area_are_a_remark(one, other):
    found = compare(section([(0, WHOLE, one)]), section([(0, WHOLE, other)]))
    assert found.same and not found.differences
    assert found.rehatched == (() if one == other else ("plate",)) == tuple(found.to_dict()["rehatched"])
    assert ("hatched with other lines: plate" in found.summary) == (one != other)


@pytest.mark.parametrize("one", PATTERNS)
@pytest.mark.parametrize("other", PATTERNS)
@pytest.mark.parametrize("outlines", [(WHOLE, LEFT), (WHOLE,)])
def test_a_larger_area_is_a_difference_about_as_large(one, other, outlines):
    """With all lines of the edges the same."""
    large, small = section([(0, WHOLE, one)], outlines), section([(0, LEFT, other)], outlines)
    bare = sum(np.hypot(*(b - a)) for a, b in hatched([rectangle(20, 0, 40, 30)], one, 0.05))
    assert hatch_mm(compare(large, small)) == {"gone": pytest.approx(bare, rel=0.2)}
    assert hatch_mm(compare(small, large)) == {"new": pytest.approx(bare, rel=0.2)}


@pytest.mark.parametrize("other", PATTERNS)
def test_a_part_without_a_hatch_is_a_difference(other):
    hatches = [(0, LEFT, PATTERNS[0]), (1, (20, 0, 40, 30), PATTERNS[1])]
    found = compare(section(hatches), section([(0, LEFT, other)]))
    assert hatch_mm(found).keys() == {"gone"} and {each.part for each in found.differences} == {"pin"}


def test_a_hatch_of_another_part_is_a_difference():
    one = section([(0, LEFT, PATTERNS[0]), (1, (30, 0, 40, 30), PATTERNS[1])])
    other = section([(1, LEFT, PATTERNS[1]), (1, (30, 0, 40, 30), PATTERNS[1])])
    assert hatch_mm(compare(one, other)).keys() == {"gone", "new"}


def test_parts_of_other_names_are_looked_for_in_all_hatches():
    faces = [(0, LEFT, PATTERNS[0]), (1, (20, 0, 40, 30), PATTERNS[1])]
    turned = [(0, LEFT, PATTERNS[1]), (1, (20, 0, 40, 30), PATTERNS[0])]
    names = ("NAUO1", "NAUO2")
    found = compare(section(faces), section(turned, parts=names))
    assert found.same and found.rehatched == ("NAUO1", "NAUO2", "pin", "plate")
    assert hatch_mm(compare(section(faces), section(turned[:1], parts=names))).keys() == {"gone"}


def test_a_face_between_two_lines_of_the_other_hatch_is_the_same():
    small = (1.0, 1.3, 1.3, 1.6)
    one, other = section([(0, small, Pattern(45.0, 0.7))]), section([])
    assert sum(each.kind == "hatch" for each in one.lines) > 0
    assert compare(one, other).same and compare(other, one).same


@pytest.mark.parametrize("ending", ["pdf", "dxf"])
def test_hatches_without_the_names_of_parts_are_told_apart_by_their_lines(ending, tmp_path):
    """A PDF whose layers are classes does not say them, and an old DXF has the layer in their place."""
    right = (20, 0, 40, 30)
    style = {"dxf": "R12"} if ending == "dxf" else None
    one, turned, less = (
        replace(section(faces), style=style_of(style)).save(tmp_path / f"{name}.{ending}")
        for name, faces in {
            "one": [(0, LEFT, PATTERNS[0]), (1, right, PATTERNS[2])],
            "turned": [(0, LEFT, PATTERNS[1]), (1, right, PATTERNS[0])],
            "less": [(0, LEFT, PATTERNS[1])],
        }.items()
    )
    assert compare(one, turned).same
    bare = sum(np.hypot(*(b - a)) for a, b in hatched([rectangle(*right)], PATTERNS[2], 0.05))
    assert hatch_mm(compare(one, less)) == {"gone": pytest.approx(bare, rel=0.2)}


def test_sections_with_the_same_edges_are_told_apart_by_their_areas():
    left, right = (side_of(section([(0, face, PATTERNS[0])]), 0.1).pieces for face in (LEFT, (20, 0, 40, 30)))
    again = side_of(section([(0, LEFT, PATTERNS[1])]), 0.1).pieces
    assert likeness(left, again, 0.1) == pytest.approx(1.0, abs=0.01)
    assert likeness(left, right, 0.1) < 0.6


def test_a_hatch_of_small_spacing_does_not_hide_that_a_view_was_moved():
    one, other = section([(0, WHOLE, PATTERNS[0])]), section([(0, (3, 4, 43, 34), PATTERNS[1])], [(3, 4, 43, 34)])
    found = compare(section([(0, WHOLE, PATTERNS[0])], [WHOLE]), other, register="translation")
    assert found.same and found.shift == pytest.approx((-3.0, -4.0), abs=1e-3)
    assert not compare(one, other).same


@pytest.fixture(scope="module")
def pump():
    """A pin in a body; in the left view both are cut small."""
    made = cq.Assembly()
    made.add(cq.Workplane().box(60, 12, 40).faces(">Z").workplane().hole(8), name="body")
    made.add(cq.Workplane().circle(4).extrude(24, both=True), name="pin")
    return made


@pytest.fixture(scope="module")
def page(pump):
    return hlr.draw_arranged(pump, section={"front": 0.0, "left": 0.0}, scale=1, page="A3")


@pytest.mark.parametrize("ending", ["svg", "json", "pdf", "dxf"])
@pytest.mark.parametrize("view", ["front", "left"])
def test_a_section_of_an_assembly_by_itself_is_the_same_as_on_its_page(pump, page, view, ending, tmp_path):
    file = hlr.draw(pump, view, section=0.0, scale=1).save(tmp_path / f"one.{ending}")
    for found in (compare(page, file), compare(file, page)):
        assert found.same, found.summary


def test_the_page_in_another_format_is_the_same(page, tmp_path):
    for ending in ("svg", "json", "pdf", "dxf"):
        found = compare(page, page.save(tmp_path / f"page.{ending}"))
        assert found.same and not found.rehatched, (ending, found.summary)


@pytest.mark.parametrize("view", ["front", "left"])
def test_a_section_that_leaves_a_part_whole_differs_by_its_area(pump, page, view):
    """The pin has no hatch, and outlines in place of edges."""
    whole = hlr.draw(pump, view, section=0.0, scale=1, uncut=["pin"])
    for found, kind in ((compare(page, whole), "gone"), (compare(whole, page), "new")):
        assert not found.same
        assert {each.part.removeprefix(f"{view}/") for each in found.differences if each.line_class == "hatch"} == {
            "pin"
        }
        assert {each.kind for each in found.differences if each.line_class == "hatch"} == {kind}


@pytest.mark.parametrize("view", ["front", "left"])
def test_a_section_at_another_place_differs(pump, page, view):
    for other in (hlr.draw(pump, view, section=2.5, scale=1), hlr.draw(pump, view, section=-2.5, scale=1)):
        found = compare(page, other)
        assert not found.same and any(each.line_class != "hatch" for each in found.differences)


def test_rays_do_not_judge_hatches(pump):
    """They run across faces, where a model has no line: the drawing that has them would be wrong."""
    whole = hlr.draw(pump, "front", section=0.0, scale=1)
    bare = [each for each in whole.lines if each.kind != "hatch" or whole.parts[each.part].name != "pin"]
    found = compare(replace(whole, lines=tuple(bare)), pump)
    assert hatch_mm(found).keys() == {"new"} and found.wrong_mm == 0.0 and found.unjudged_mm > 50.0
    assert fails(found, "ours")  # nothing of it was judged


def test_a_part_of_one_drawing_alone_is_not_said_to_have_other_lines(pump):
    """The ends of its strokes lie at the border of the body, which is hatched in both."""
    body = cq.Assembly()
    body.add(pump.objects["body"].obj, name="body")
    one, other = (hlr.draw(model, "front", section=0.0, scale=1) for model in (pump, body))
    for found in (compare(one, other), compare(other, one)):
        assert not found.same and "pin" not in found.rehatched, found.summary
