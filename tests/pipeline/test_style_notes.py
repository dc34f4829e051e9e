"""A style's rules for parts that the model does not have."""

from __future__ import annotations

from pathlib import Path

import cadquery as cq
import pytest

import hlr
from hlr.drawing.pens import by_part, pens_of, usual_pens_of
from support.at_size import AT_SIZE


def model():
    whole = cq.Assembly()
    for i, name in enumerate(("bolt", "bolt:2", "plate")):
        whole.add(cq.Workplane().box(5, 5, 5), name=name, loc=cq.Location((10 * i, 0, 0)))
    return whole


def notes(style, **options):
    return [
        n for n in hlr.draw(model(), "front", style=style, strict=True, **AT_SIZE, **options).notes if "style" in n.text
    ]


def test_a_rule_that_matches_no_part_is_a_remark_with_the_nearest_names():
    (note,) = notes({"parts": {"bolts": {"color": "red", "hidden": {"color": "pink"}}, "pl*": {"color": "blue"}}})
    assert (note.code, note.is_warning) == ("style-unused", False)
    assert note.text == 'the style\'s rule for parts "bolts" matches no part: perhaps "bolt".'


def test_rules_that_match_are_told_nothing():
    assert not notes({"parts": {"BOLT": {"color": "red"}, "bolt:2": {"color": "pink"}}})


def test_of_parts_that_were_chosen_a_rule_may_be_for_others():
    assert not notes({"parts": {"plate": {"color": "red"}}}, only=["bolt"])


@pytest.mark.parametrize(
    ("count", "more"),
    [
        (4, "1 more of the style's rules for parts matches no part."),
        (5, "2 more of the style's rules for parts match no part."),
    ],
)
def test_of_many_some_are_named(count, more):
    found = notes({"parts": {f"zz{i}": {"color": "red"} for i in range(count)}})
    assert len(found) == 4 and found[-1].text == more
    assert found[0].text == 'the style\'s rule for parts "zz0" matches no part: there are "bolt", "plate".'


def test_arranged_views_say_it_once():
    drawing = hlr.draw_arranged(model(), options=hlr.Options(style={"parts": {"bolts": {"color": "red"}}}))
    assert [note.code for note in drawing.notes].count("style-unused") == 1


AS1 = Path(__file__).parents[1] / "data/as1-oc-214.stp"
RED, BLUE = "#c00000", "#0000c0"
RODS = {"parts": {"rod-assembly": {"color": RED}, "L-bracket-assembly_2": {"color": BLUE}}}


def colours(drawing):
    """By the names of parts, without the view, the colour of their visible lines."""
    pens = by_part(pens_of(drawing, usual_pens_of(drawing)))
    return {drawing.parts[k].name.rpartition("/")[2]: pen.pen("sharp", True).color for k, pen in pens.items()}


@pytest.mark.parametrize("drawn", ["alone", "from JSON", "arranged", "cut"])
def test_a_rule_may_name_an_assembly_or_its_place(drawn, tmp_path):
    if drawn == "arranged":
        drawing = hlr.draw_arranged(AS1, views=["front", "top"], style=RODS, strict=True)
    else:
        drawing = hlr.draw(AS1, "front", style=RODS, strict=True, section=True if drawn == "cut" else None)
    assert not [note for note in drawing.notes if note.code == "style-unused"]
    if drawn == "from JSON":
        drawing = hlr.load(drawing.save(tmp_path / "as1.json")).with_style(RODS)
    found = colours(drawing)
    assert found["rod"] == found["nut"] == RED and found["plate"] not in (RED, BLUE)
    # The cut takes two bolts away.
    assert len([name for name, color in found.items() if color == BLUE]) == (5 if drawn == "cut" else 7)


def test_a_rule_for_an_assembly_that_is_not_there_is_told_its_name():
    (note,) = hlr.draw(AS1, "front", style={"parts": {"rod-asembly": {"color": RED}}}).notes[-1:]
    assert note.text.startswith('the style\'s rule for parts "rod-asembly" matches no part: perhaps "rod-assembly" or ')
