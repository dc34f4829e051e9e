"""Which comparisons fail: any difference, or only one in which hlr's own drawing of the model is wrong."""

from dataclasses import replace

import pytest

import hlr
from hlr.compare import compare
from hlr.compare.compared_view import ComparedView
from hlr.compare.failing import fails, who_is_wrong
from support.drawings import drawing, line
from support.fragments import fragment
from support.models import box, parts


def model():
    return parts(box((30, 20, 4)), box((5, 12, 6), (10, -3, 8)))


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    """A line is missing in the other program's drawing, and one is too many: the model's side, the second, is right."""
    drawn = hlr.draw(model(), view="front", scale=2, hidden=True)
    x, y = drawn.bounds.width / 2, drawn.bounds.height / 2
    extra = line([[x - 20, y - 9], [x - 15, y - 4]])
    lost = max(drawn.visible, key=lambda one: abs(one.points[-1] - one.points[0]).sum())
    lines = tuple(one for one in (*drawn.lines, extra) if one is not lost)
    path = tmp_path_factory.mktemp("failing") / "other.svg"
    path.write_text(fragment(replace(drawn, lines=lines)))
    return compare(path, model(), view="front", register="translation")


def judged(found, *verdicts):
    """The comparison with these verdicts on differences of 5 mm each."""
    one = found.differences[0]
    return replace(found, differences=tuple(replace(one, length_mm=5.0, verdict=each) for each in verdicts))


def test_where_the_other_drawing_is_wrong_only_any_fails(found):
    assert {each.verdict for each in found.differences} == {"second right"} and found.model_side == "second"
    assert [fails(found, on) for on in ("any", "ours", "never")] == [True, False, False]
    assert who_is_wrong(found) == "hlr's own drawing is nowhere found to be wrong"


@pytest.mark.parametrize(
    ("verdicts", "wrong_mm", "unjudged_mm", "failing"),
    [
        (["second right", "both right"], 0.0, 0.0, False),
        (["second right", "first right"], 5.0, 0.0, True),
        (["neither right"], 5.0, 0.0, True),
        (["undecided", "undecided", ""], 0.0, 15.0, False),
        (["first right", "undecided"], 5.0, 5.0, True),
        (["", ""], 0.0, 10.0, True),
    ],
)
def test_verdicts_against_the_side_of_the_model_fail(verdicts, wrong_mm, unjudged_mm, failing, found):
    some = judged(found, *verdicts)
    assert (some.wrong_mm, some.unjudged_mm, fails(some, "ours")) == (wrong_mm, unjudged_mm, failing)
    known = some.to_dict()
    assert (known["wrong_mm"], known["unjudged_mm"], known["model_side"]) == (wrong_mm, unjudged_mm, "second")
    assert fails(some, "any") and not fails(some, "never")


def test_the_model_may_be_the_first(found):
    some = replace(judged(found, "second right"), model_side="first")
    assert some.wrong_mm == 5.0 and fails(some, "ours")
    assert who_is_wrong(some) == "hlr's own drawing is wrong in 5 mm"
    assert who_is_wrong(judged(found, "first right", "undecided")) == (
        "hlr's own drawing is wrong in 5 mm; undecided or not judged: 5 mm"
    )
    assert who_is_wrong(judged(found, "")).startswith("nothing of it was judged")


def test_what_cannot_be_seen_counts_nowhere(found):
    some = replace(found, differences=(replace(found.differences[0], kind="doubled", verdict=""),))
    assert some.same and some.unjudged_mm == 0.0 and not fails(some, "ours") and who_is_wrong(some) == ""


@pytest.mark.parametrize(("side", "lacking"), [("first", False), ("second", True)])
def test_a_view_that_our_page_lacks_fails(side, lacking, found):
    view = ComparedView("Front", before=True, after=False, shift=None, displaced=False, same_mm=0.0, mm={})
    right = judged(found, f"{side} right", "")
    some = replace(right, views=(view,), model_side=side)
    assert fails(some, "ours") == lacking
    assert ("lacks Front" in who_is_wrong(some)) == lacking


def test_drawings_so_different_that_nothing_is_judged_fail(tmp_path):
    other = drawing([line([[0, y], [3 + 7 * y, 40 - y]]) for y in range(1, 20)])
    (tmp_path / "other.svg").write_text(fragment(other))
    found = compare(tmp_path / "other.svg", model(), view="front")
    assert found.badly_laid is not None and fails(found, "ours") and not fails(found, "never")


def test_without_one_model_there_is_no_side_of_one():
    drawn = hlr.draw(model(), view="front")
    assert compare(drawn, drawn).model_side is None
    assert compare(model(), model(), view="front").model_side is None
    assert compare(model(), drawn, view="front").model_side == "first"
