"""Where sections may be: their values in one form, and those that are refused."""

import numpy as np
import pytest

import hlr
from hlr.request.check import checked
from hlr.request.section import by_view, check_sections, with_sections
from hlr.request.shown_views import shown_views


def form(section):
    return checked(hlr.Options(section=section)).section


@pytest.mark.parametrize(
    ("given", "found"),
    [
        (None, None),
        (False, None),
        (True, True),
        (12, 12.0),
        (np.float64(-3.5), -3.5),
        ([0, 12, 0], (0.0, 12.0, 0.0)),
        (np.array([1.0, 2.0, 3.0]), (1.0, 2.0, 3.0)),
        ((5, (30, 40)), (5.0, (30.0, 40.0))),
        ([5, [30, 40], np.array([50, 8])], (5.0, (30.0, 40.0), (50.0, 8.0))),
        ({"Front ": True, "left": 3}, {"front": True, "left": 3.0}),
        ({"front": False}, None),
        ({"1,-1,0": (1, 2, 3), (0, 0, 2): True}, {"1,-1,0": (1.0, 2.0, 3.0), "0,0,2": True}),
        ([("Front", 3), ["left", True], ("top", None)], {"front": 3.0, "left": True}),
        (
            [["left", 3], ["front", [5, [30, 40]]], ["left", 1]],
            (("left", 3.0), ("front", (5.0, (30.0, 40.0))), ("left", 1.0)),
        ),
        ((((0, 0, 2), 1), ((0, 0, 2), True)), (("0,0,2", 1.0), ("0,0,2", True))),
        ([("left", None)], None),
    ],
)
def test_a_section_has_one_form(given, found):
    assert form(given) == found


@pytest.mark.parametrize(
    "section",
    [
        "middle",
        (1, 2),
        (1, (2,)),
        (1, (2, 3, 4)),
        ((2, 3),),
        (1, (2, "x")),
        (1,),
        (),
        ("front", 3),
        (1, 2, "x"),
        float("nan"),
        1e13,
        (0, 0, float("inf")),
        b"123",
    ],
)
def test_what_names_no_plane_is_refused_with_what_would(section):
    with pytest.raises(hlr.OptionError, match="section needs True for the middle of the model, a coordinate such as"):
        form(section)


@pytest.mark.parametrize("other", [4, ("front", 3, 4), (), "front", None])
def test_what_is_no_pair_is_refused_among_pairs(other):
    with pytest.raises(
        hlr.OptionError, match=r'section needs pairs of a view and its place, such as \("left", 12.5\), '
    ):
        form([("front", 3), other])


@pytest.mark.parametrize("view", ["frnt", "1,2", "1,x,2", (0, 0, 0), 7])
def test_a_section_of_no_view_is_refused(view):
    with pytest.raises(hlr.OptionError, match=r"^`section`: "):
        form({view: True})


@pytest.mark.parametrize(
    ("other", "message"),
    [
        ({"perspective": hlr.Perspective()}, "a section has no perspective: leave out `perspective`, or `section`"),
        ({"report": True}, "a section has no report: leave out `report`, or `section`"),
        ({"uncut": "bolt"}, "uncut needs a list of names or patterns of parts"),
    ],
)
def test_what_a_section_cannot_have_is_refused(other, message):
    with pytest.raises(hlr.OptionError, match=message):
        checked(hlr.Options(section=True, **other))


def test_parts_are_left_whole_in_sections_only():
    with pytest.raises(hlr.OptionError, match="`uncut` is for parts of a section: give `section` as well"):
        checked(hlr.Options(uncut=("bolt",)))


def test_one_place_is_for_all_views_and_a_mapping_for_those_that_it_names():
    def places(section, *views):
        return [each.place for each in shown_views(views, section)]

    assert places(3.0, "front", "top") == [3.0, 3.0]
    assert places({"front": 3.0}, "front", "top") == [3.0, None]
    assert places({"0,0,2": True}, (0, 0, 2)) == [True]
    assert places(None, "front") == [None]


def test_a_view_is_drawn_once_for_each_of_its_planes_and_each_has_a_name_and_a_letter():
    section = form([("left", 3), ("front", 1), ("left", 5), ("top", 0), ("left", True)])
    shown = shown_views(["front", "left", "iso", "top"], section)
    assert [(each.name, each.view, each.place, each.letter) for each in shown] == [
        ("front", "front", 1.0, "B"),
        ("left", "left", 3.0, "A"),
        ("left-C", "left", 5.0, "C"),
        ("left-E", "left", True, "E"),
        ("iso", "iso", None, ""),
        ("top", "top", 0.0, "D"),
    ]
    assert [each.is_further for each in shown] == [False, False, True, True, False, False]


def test_a_view_that_is_drawn_whole_comes_before_its_sections_which_all_have_letters():
    section = form([("left", 3), ("front", 1), ("left", 5)])
    shown = shown_views(["front", "left"], section, ("left",))
    assert [(each.name, each.place, each.letter, each.which, each.others) for each in shown] == [
        ("front", 1.0, "B", 0, 0),
        ("left", None, "", 0, 2),
        ("left-A", 3.0, "A", 1, 2),
        ("left-C", 5.0, "C", 2, 2),
    ]


def test_views_that_are_cut_twice_are_added_once():
    places = by_view(form([("left", 3), ((1, -1, 0), (0, 0, 0)), ("left", 5)]))
    assert with_sections(["front"], places) == ("front", "left", (1.0, -1.0, 0.0))


@pytest.mark.parametrize(
    ("section", "told"),
    [
        ([("front", 3), ("left", 3), ("front", 3.0)], "front@3"),
        ([("front", True), ("FRONT", True)], "front"),
        ([("iso", (0, 1, 2.5))] * 2, "iso@0,1,2.5"),
        ([("front", (3, (4, 5), (6, 7)))] * 2, "front@3,4:5,6:7"),
    ],
)
def test_a_plane_is_given_once(section, told):
    with pytest.raises(hlr.OptionError, match=rf"^`section` {told} is asked for twice: give each plane once"):
        form(section)


@pytest.mark.parametrize(
    ("section", "views", "by_name", "message"),
    [
        ({"left": True}, ["front", "top"], False, "section left is none of the views, front and top: add it to them"),
        (3.0, ["front", "iso"], False, "section iso at 3: the view looks along no axis, so give a point on its plane"),
        ({"1,1,0": 3.0}, [(1, 1, 0)], False, "section 1,1,0 at 3: the view looks along no axis"),
        ((("iso", (0.0, 0.0, 0.0)), ("iso", 3.0)), ["iso"], True, "section iso at 3: the view looks along no axis"),
        ((("left", 1.0), ("left", 3.0)), ["front"], True, "section left is none of the views, front: add it to them"),
        (True, ["front", "top"], True, "a page of several views has sections by name"),
    ],
)
def test_sections_fit_their_views(section, views, by_name, message):
    with pytest.raises(hlr.OptionError, match=message):
        check_sections(section, views, by_name=by_name)


def test_sections_that_fit_are_let_through():
    check_sections(None, ["iso"], by_name=True)
    check_sections({"front": 1.0, "iso": (1.0, 2.0, 3.0), "0,0,2": 4.0}, ["front", "iso", (0, 0, 2)], by_name=True)
    check_sections(True, ["front", "iso"])
