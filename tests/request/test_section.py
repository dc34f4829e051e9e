"""Where sections may be: their values in one form, and those that are refused."""

import numpy as np
import pytest

import hlr
from hlr.request.check import checked
from hlr.request.section import check_sections, place_of


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


@pytest.mark.parametrize("view", ["frnt", "1,2", "1,x,2", (0, 0, 0), 7])
def test_a_section_of_no_view_is_refused(view):
    with pytest.raises(hlr.OptionError, match=r"^section: "):
        form({view: True})


@pytest.mark.parametrize(
    ("other", "message"),
    [
        ({"perspective": hlr.Perspective()}, "a section has no perspective: leave out perspective, or section"),
        ({"report": True}, "a section has no report: leave out report, or section"),
        ({"uncut": "bolt"}, "uncut needs a list of names or patterns of parts"),
    ],
)
def test_what_a_section_cannot_have_is_refused(other, message):
    with pytest.raises(hlr.OptionError, match=message):
        checked(hlr.Options(section=True, **other))


def test_parts_are_left_whole_in_sections_only():
    with pytest.raises(hlr.OptionError, match="uncut is for parts of a section: give section as well"):
        checked(hlr.Options(uncut=("bolt",)))


def test_one_place_is_for_all_views_and_a_mapping_for_those_that_it_names():
    assert place_of(3.0, "front") == place_of({"front": 3.0}, "front") == 3.0
    assert place_of({"front": 3.0}, "top") is None
    assert place_of({"0,0,2": True}, (0, 0, 2)) is True


@pytest.mark.parametrize(
    ("section", "views", "by_name", "message"),
    [
        ({"left": True}, ["front", "top"], False, "section left is none of the views, front and top: add it to them"),
        (3.0, ["front", "iso"], False, "section iso at 3: the view looks along no axis, so give a point on its plane"),
        ({"1,1,0": 3.0}, [(1, 1, 0)], False, "section 1,1,0 at 3: the view looks along no axis"),
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
