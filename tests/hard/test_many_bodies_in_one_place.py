"""Many equal bodies in one place, as a pattern gone wrong leaves them: they take as long as two, and it is said.

Each surface was tried with each copy of it and of its neighbours: 144 balls in one place took 4 times as long as 72.
"""

from __future__ import annotations

import cadquery as cq
import pytest
from hard.brep import same

import hlr
from support.at_size import AT_SIZE

RED, BLUE = cq.Color(1, 0, 0), cq.Color(0, 0, 1)
GLASS = cq.Color(1, 0, 0, 0.3)


def ball():
    return cq.Workplane().sphere(10).val()


def bolt():
    head = cq.Workplane().polygon(6, 16).extrude(6).faces(">Z").workplane()
    return head.circle(4).extrude(30).faces(">Z").chamfer(0.8).val()


def beside_a_plate(*parts):
    """The parts, given as (shape, place along x, colour), and a plate that they go through."""
    assembly = cq.Assembly()
    for i, (shape, x, color) in enumerate(parts):
        assembly.add(shape, loc=cq.Location((x, 0, 0)), name=f"copy{i}", color=color)
    return assembly.add(cq.Workplane().box(40, 30, 3).val(), name="plate")


def copies(count, shape, apart=0.0):
    return beside_a_plate(*[(shape, apart * i / count, None) for i in range(count)])


def drawn(model, view="iso", **options):
    return hlr.draw(model, view, **{**AT_SIZE, **options})


def told(drawing):
    return [note.text for note in drawing.notes if note.code == "parts-repeated"]


def work(drawing):
    """What grew with the square of the number of bodies, and what it grew from."""
    (search,) = [decision for decision in drawing.plan if decision.name == "intersection search"]
    return search.counts["clash_tests"], drawing.counters["crossing_tests"], drawing.counters["triangles"]


@pytest.mark.parametrize("shape", [ball, bolt])
def test_they_take_the_work_of_two(picture, shape):
    one, two, many = (drawn(copies(count, shape())) for count in (1, 2, 40))
    # Of one alone, faces that do not touch the plate are meshed less finely.
    assert work(many) == work(two)
    same(one, many)
    assert not told(one)
    assert told(many) == ['40 equal parts lie in one place: "copy0", "copy1" and 38 more.']
    assert len(many.parts) == 41
    if shape is bolt:
        picture(many)


def test_those_off_by_less_than_an_eighth_of_the_accuracy_count_as_one():
    little = hlr.draw(copies(1, bolt()), **AT_SIZE).accuracy.used / 8
    two, near = drawn(copies(2, bolt())), drawn(copies(40, bolt(), 0.99 * little))
    assert work(near) == work(two) and not told(near)
    assert work(drawn(copies(2, bolt(), 4 * little))) > work(two)


@pytest.mark.parametrize("thickness", [3, 5])
def test_no_sheet_of_a_pile_is_left_out(thickness):
    """Sheets thinner than an eighth of the accuracy, which lie on one another: the pile hides a post behind it."""
    pile = cq.Assembly()
    for k in range(40):
        pile.add(cq.Workplane().box(1000, 1000, thickness), loc=cq.Location((0, 0, k * thickness)))
    pile.add(cq.Workplane().box(50, 50, 3000), loc=cq.Location((0, 600, 0)))
    drawing = hlr.draw(pile, "front", scale="1:100", hidden=True, accuracy=0.5)
    behind = [line.points[[0, -1], 1] for line in drawing.lines if line.part == 40 and not line.visible]
    low, high = 15 - thickness / 200, 15 - thickness / 200 + 40 * thickness / 100
    assert [pytest.approx((low, high), abs=0.01)] * 2 == [sorted(ends) for ends in behind]


def test_those_of_other_colours_stay_and_are_told():
    model = beside_a_plate(*[(bolt(), 0, (RED, BLUE)[i % 2]) for i in range(6)])
    found, two = drawn(model), drawn(beside_a_plate((bolt(), 0, RED), (bolt(), 0, BLUE)))
    assert work(found) == work(two)
    assert told(two) == ['2 equal parts lie in one place: "copy0" and "copy1".']
    assert told(found) == ['6 equal parts lie in one place: "copy0", "copy1" and 4 more.']


@pytest.mark.parametrize("looks", [(GLASS, RED), (RED, GLASS)])
def test_one_of_glass_is_not_taken_for_one_that_hides(looks):
    both = drawn(beside_a_plate(*[(bolt(), 0, color) for color in looks]), see_through=True)
    same(drawn(beside_a_plate((bolt(), 0, RED))), both)


def test_a_section_has_the_hatch_of_one():
    one, many = (drawn(copies(count, bolt()), view="front", section=True) for count in (1, 20))
    assert many.counters["hatch_lines"] == one.counters["hatch_lines"] > 0
    same(one, many)


def test_of_each_is_known_what_is_known_of_one():
    opened = cq.Workplane().box(10, 10, 40).faces("<Z or >X or <Y").vals()
    shell = cq.Compound.makeCompound(opened)
    model = beside_a_plate(*[(shell, 0, None)] * 3)
    first, *others, plate = hlr.info(model).parts
    assert first.triangles == 6 and [(p.triangles, p.closed, p.defects) for p in others] == [
        (first.triangles, first.closed, first.defects)
    ] * (len(others))
    assert plate.closed
    lines = drawn(model).notes
    assert len({note.text for note in lines if note.code != "parts-repeated"}) == len(others) + 1
