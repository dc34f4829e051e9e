"""A model as a side: drawn as the other side shows it, in the view that is said or found."""

import numpy as np
import pytest

import hlr
from hlr.compare import compare
from hlr.errors import OptionError, SourceError
from support.fragments import fragment
from support.models import box, parts


def step():
    """No view of it looks like another one, mirrored or not."""
    return parts(box((30, 20, 4)), box((8, 6, 10), (-9, 5, 7)), box((5, 12, 3), (10, -3, 3.5)))


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    path = tmp_path_factory.mktemp("model") / "step.stl"
    step().export(path)
    return path


VIEWS = ("front", "back", "right", "bottom", "iso-nw")


@pytest.mark.parametrize("view", VIEWS)
def test_the_view_is_found(view, model, tmp_path):
    drawn = hlr.draw(model, view=view)
    found = compare(drawn.save(tmp_path / "a.json"), model)
    assert (found.view_found, found.same) == (view, True), found
    assert found.summary.endswith(f"; the view is {view}") and found.to_dict()["view_found"] == view


@pytest.mark.parametrize("view", ["left", "iso-ne"])
def test_the_view_and_the_scale_of_another_program_are_found(view, model, tmp_path):
    path = tmp_path / "a.svg"
    path.write_text(fragment(hlr.draw(model, view=view, scale=1, hidden=True), shift=(7, -31), scale=2.0))
    found = compare(path, model)
    assert (found.view_found, found.same) == (view, True), found
    assert found.motion.scale == pytest.approx(1.0, abs=1e-4)  # it was drawn at 2:1
    assert found.after == f"step.stl, {view}"


def test_the_view_that_is_said_is_drawn(model, tmp_path):
    drawn = hlr.draw(model, view=(1, 2, 3)).save(tmp_path / "a.svg")
    assert compare(drawn, model, view=(1, 2, 3)).summary.startswith("same: ")
    assert compare(model, drawn, view=(1, 2, 3)).view_found is None
    assert not compare(drawn, model, view="front").same


def test_objects_are_models_too(model):
    assert compare(hlr.draw(step(), view="top"), step(), view="top").same
    assert compare(step(), step(), view="top").same


@pytest.mark.parametrize("hidden", [True, False])
def test_sorts_of_lines_that_the_other_has_none_of_are_left_out(hidden, model, tmp_path):
    drawn = hlr.draw(model, view="iso", scale=1, hidden=True)
    lost = drawn.hidden[0] if hidden else drawn.visible[0]
    path = tmp_path / "a.svg"
    path.write_text(fragment(drawn, keep=lambda line: line is not lost and (line.visible or hidden)))
    found = compare(path, model, view="iso")
    (one,) = found.differences
    assert (one.kind, one.visible) == ("new", lost.visible)
    assert one.length_mm == pytest.approx(np.hypot(*(lost.points[-1] - lost.points[0])), abs=1e-3)


def test_what_cannot_be_compared_is_refused(model, tmp_path):
    drawn = hlr.draw(model, view="top").save(tmp_path / "a.svg")
    with pytest.raises(OptionError, match="both sides are drawings"):
        compare(drawn, drawn, view="top")
    with pytest.raises(SourceError):
        compare(drawn, tmp_path / "none.stl")
    with pytest.raises(SourceError):
        compare(drawn, object())


def test_hidden_lines_that_were_left_out_by_mistake_are_differences(model, tmp_path):
    """A drawing that has one hidden line draws hidden lines: those that it lacks are missing."""
    drawn = hlr.draw(model, view="iso", scale=1, hidden=True)
    path = tmp_path / "a.svg"
    path.write_text(fragment(drawn, keep=lambda line: line.visible or line is drawn.hidden[0]))
    found = compare(path, model, view="iso")
    assert {(each.kind, each.visible) for each in found.differences} == {("new", False)}
    assert len(found.differences) == len(drawn.hidden) - 1
