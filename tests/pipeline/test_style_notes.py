"""A style's rules for parts that the model does not have."""

from __future__ import annotations

import cadquery as cq
import pytest

import hlr
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
