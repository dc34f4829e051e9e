"""A session opens and meshes once, and whoever needs less than a drawing stops where it has what it needs."""

import numpy as np
import pytest
import trimesh

import hlr
from hlr import Options, StrictError
from hlr.drawing.notes import Note
from hlr.image.image import Image
from hlr.pipeline import session as sessions
from hlr.pipeline.session import Session, refuse_warnings
from hlr.scene.scene import Scene
from support.at_size import ALL_LINES, AT_SIZE


def box():
    return trimesh.creation.box((10.0, 20.0, 30.0))


def cylinder():
    import cadquery as cq

    return cq.Workplane().cylinder(30.0, 10.0)


@pytest.fixture
def stages(monkeypatch):
    """Which of the stages that a session calls were gone through, in their order."""
    called = []
    for name in ("open_selected", "build", "outlined", "clipped", "decide", "solve", "draw_lines", "finished"):
        real = getattr(sessions, name)

        def counted(*arguments, _name=name, _real=real, **keywords):
            called.append(_name)
            return _real(*arguments, **keywords)

        monkeypatch.setattr(sessions, name, counted)
    return called


def test_no_stage_runs_before_it_is_needed(stages):
    session = Session(box(), ["front"], Options(**AT_SIZE))
    assert stages == ["open_selected"]
    assert session.bounds.tolist() == [[-5.0, -10.0, -15.0], [5.0, 10.0, 15.0]]
    (draft,) = session.drafts()
    assert stages == ["open_selected", "build"]
    image = session.shown(draft)
    session.plan(draft, image)
    assert stages == ["open_selected", "build", "outlined", "clipped", "decide"]
    del stages[:]
    session.drawing(draft)
    assert stages == ["outlined", "clipped", "decide", "solve", "draw_lines", "finished"]


@pytest.mark.parametrize(
    ("call", "last"),
    [
        (hlr.info, "build"),
        (lambda thing: hlr.plan_views(thing, ["iso", "top"], hlr.Options(**AT_SIZE)), "decide"),
        (lambda thing: hlr.preview(thing, edges=False, size=(40, 30)), "outlined"),
        (lambda thing: hlr.draw_views(thing, ["iso", "top"], hlr.Options(**AT_SIZE)), "finished"),
        (lambda thing: hlr.methods(thing, limit=0.01, methods=["z-buffer"], size=(40, 30)), "build"),
    ],
    ids=["info", "plan", "preview", "draw", "methods"],
)
def test_each_use_opens_and_builds_once_and_stops_where_it_likes(stages, call, last):
    call(box())
    assert stages.count("open_selected") == stages.count("build") == 1
    assert stages[-1] == last


def test_progress_tells_the_stages_in_order():
    told = []
    session = Session(box(), ["front"], Options(**AT_SIZE), lambda stage, done: told.append(stage))
    session.drafts()
    assert list(dict.fromkeys(told)) == ["source", "tessellate", "scene"]


def test_an_image_is_no_scene_and_leaves_its_scene_as_it_was():
    session = Session(cylinder(), ["front", "top"], Options(**AT_SIZE))
    front, top = session.drafts()
    points = session.scene.points.copy()
    shown = session.shown(front)
    assert isinstance(shown, Image) and not isinstance(shown, Scene)
    # The outline of the mantle is added to the image alone: seen from above there is none.
    assert len(shown.walks.kind) == len(session.scene.walks.kind) + 2
    assert len(session.shown(top).walks.kind) == len(session.scene.walks.kind)
    assert np.array_equal(session.scene.points, points)


def test_outlines_that_the_scale_had_to_know_are_not_traced_again(monkeypatch):
    from hlr import _kernel

    traced, real = [], _kernel.silhouettes
    monkeypatch.setattr(_kernel, "silhouettes", lambda *given, **named: traced.append(1) or real(*given, **named))
    hlr.draw(cylinder(), "front", **AT_SIZE)
    assert len(traced) == 1
    # Seen from the front its outlines do not reach beyond its rims: the first scale was the true one.
    session = Session(cylinder(), ["front"], Options(fit=(100.0, 100.0), accuracy=0.05, **ALL_LINES))
    first = session.placements[0].tolerances.deflection
    (draft,) = session.drafts()
    before = len(traced)
    session.drawing(draft)
    same = draft.image.placement.tolerances.deflection == first
    assert len(traced) == before + (not same)


def test_the_first_warning_is_refused_where_warnings_are():
    remark, warning = Note("glass-hides", "a remark"), Note("defects", "a warning")
    assert warning.is_warning and not remark.is_warning
    refuse_warnings([remark])
    with pytest.raises(StrictError, match="a warning"):
        refuse_warnings([remark, warning])
