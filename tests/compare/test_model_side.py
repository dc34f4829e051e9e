"""A model as a side: drawn as the other side shows it, in the view that is said or found."""

import re

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


STATED = {
    "a direction": {"view": (1, 2, 0.5)},
    "turned on paper": {"view": "front", "up": (1, 0, 1)},
    "in perspective": {"view": "iso", "perspective": hlr.Perspective()},
    "toward the origin": {"perspective": hlr.Perspective(eye=(60, 90, 50), target=(0, 0, 0))},
    "from an eye": {"perspective": hlr.Perspective(eye=(60, 90, 50), target=(3, 2, 1))},
    "cut at a window": {"view": "iso", "window": (12, 10, 40, 30)},
}


@pytest.mark.parametrize("ending", ["svg", "json"])
@pytest.mark.parametrize("how", STATED)
def test_the_view_that_a_drawing_states_is_drawn(how, ending, model, tmp_path):
    """Also one that has no name, which nothing but the drawing tells."""
    drawn = hlr.draw(model, **STATED[how], scale=1.5)
    path = drawn.save(tmp_path / f"a.{ending}")
    found = compare(path, model)
    assert found.same and found.view_found == drawn.view.name
    assert not compare(path, step().apply_scale(1.1)).same


@pytest.mark.parametrize("ending", ["pdf", "dxf"])
def test_a_named_view_that_is_turned_is_stated(ending, model, tmp_path):
    turned = hlr.draw(model, view="top", up=(1, 0, 0), scale=1.5).save(tmp_path / f"turned.{ending}")
    assert compare(turned, model).same
    assert b"direction=" in turned.read_bytes()
    usual = hlr.draw(model, view="top", up=(0, 2, 0), scale=1.5).save(tmp_path / f"usual.{ending}")
    assert b"direction=" not in usual.read_bytes()


def test_a_view_is_stated_in_the_axes_of_the_model(tmp_path):
    """glTF is in metres, and y is up."""
    path = tmp_path / "step.glb"
    step().apply_transform(np.diag([1e-3, 1e-3, 1e-3, 1])).export(path)
    for number, options in enumerate(STATED.values()):
        drawn = hlr.draw(path, **options, scale=1)
        assert compare(drawn.save(tmp_path / f"{number}.svg"), path).same


@pytest.mark.parametrize("wrong", ["0 0 0", "nan 0 1", "1 2", "a b c"])
def test_a_view_that_is_none_is_refused(wrong, model, tmp_path):
    path = hlr.draw(model, view=(1, 2, 3)).save(tmp_path / "a.svg")
    text = path.read_text()
    path.write_text(re.sub(r' direction="[^"]*"', f' direction="{wrong}"', text, count=1))
    with pytest.raises(SourceError, match="damaged"):
        compare(path, model)


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


def test_two_models_are_seen_in_the_usual_view_and_it_is_named(model):
    found = compare(model, model)
    assert found.same and found.view_found == "iso" and found.summary.endswith("; the view is iso")
    assert compare(model, model, view="top").view_found is None


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
