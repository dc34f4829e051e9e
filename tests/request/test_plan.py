"""Requests are checked before any work, and the plan says what is drawn and with which tolerances."""

import math
import re
from dataclasses import FrozenInstanceError, fields, replace

import cadquery as cq
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hlr.drawing.pens import WIDE_MM
from hlr.errors import OptionError, ViewError
from hlr.image.camera import resolve
from hlr.image.image import image_of
from hlr.image.placement import Placement
from hlr.request.accuracy import DEFAULT_ACCURACY, FINEST_BREP, FINEST_MESH, choose, derive, under
from hlr.request.check import checked, checked_views
from hlr.request.drawing_effects import drawing_effects
from hlr.request.effect import Planner
from hlr.request.options import Options, Perspective
from hlr.scene.build import build
from hlr.source import open_source
from hlr.tables.line_classes import INTERIOR, EdgeClass
from hlr.visibility.plan import DRAWN, OUTLINE, decide
from support.models import box, parts


def test_options_are_frozen_and_their_defaults_pass():
    options = Options()
    assert checked(options) is options
    with pytest.raises(FrozenInstanceError):
        options.scale = 2.0
    for field in fields(Options):
        assert re.search(rf"\b{field.name}\b", Options.__doc__ or ""), f"{field.name} is not explained"


@pytest.mark.parametrize(
    ("written", "scale"), [("1:50", 0.02), ("5:2", 2.5), (" 2 ", 2.0), (0.5, 0.5), (np.float64(3.0), 3.0)]
)
def test_a_scale_is_a_number_or_a_ratio(written, scale):
    assert checked(Options(scale=written)).scale == scale


@pytest.mark.parametrize(
    ("wish", "words"),
    [
        ({"scale": 0.0}, r"scale 0.* give a positive number"),
        ({"scale": -1.0}, "scale -1"),
        ({"scale": math.nan}, "scale nan"),
        ({"scale": math.inf}, "scale inf"),
        ({"scale": "1:0"}, "scale '1:0'"),
        ({"scale": "half"}, "scale 'half'"),
        ({"scale": "1:1e40"}, "scale '1:1e40'"),
        ({"fit": (0.0, 10.0)}, "`fit` needs a positive width and height"),
        ({"fit": (10.0, math.nan)}, "`fit` needs"),
        ({"fit": (-1.0, 10.0)}, "`fit` needs"),
        ({"accuracy": 0.0}, "accuracy 0"),
        ({"accuracy": math.nan}, "accuracy nan"),
        ({"accuracy": -0.1}, "accuracy -0.1"),
        ({"crease": -1.0}, "crease -1"),
        ({"crease": 180.5}, "crease 180.5"),
        ({"crease": math.nan}, "crease nan"),
        ({"threads": -1}, "-1 threads"),
        ({"threads": True}, "True threads"),
        ({"threads": 1025}, "1025 threads.* up to 1024"),
        ({"within": 0.0}, "within needs a positive number of seconds, not 0"),
        ({"within": math.inf}, "within needs a positive number of seconds, not inf"),
        ({"within": "2s"}, "within needs a positive number of seconds, not '2s'"),
    ],
)
def test_options_out_of_range(wish, words):
    with pytest.raises(OptionError, match=words) as caught:
        checked(replace(Options(), **wish))
    assert "\n" not in str(caught.value)


@given(st.floats(1e-6, 10), st.floats(1e-3, 1e3), st.floats(1, 1e4))
def test_the_shares_of_the_accuracy_add_up_to_less(accuracy, per_model, diagonal):
    if diagonal * 1e-7 <= accuracy <= diagonal / 4:
        t = derive(accuracy, per_model, diagonal, brep=True)
        assert t.accuracy == accuracy
        assert t.deflection * per_model + t.thin_paper <= 0.75 * accuracy * (1 + 1e-12)
        assert t.thin_model * per_model <= t.thin_paper * (1 + 1e-12)
        # Two tessellations, both off, at a slant.
        assert t.contact >= 2 * t.deflection
        assert t.rounding < t.contact_planar / 10 < t.contact / 10
        assert t.width < t.accuracy <= t.short < t.stub


def test_the_accuracy_of_those_who_do_not_ask():
    assert choose(0.3, 10.0) == 0.3
    assert choose(None, 1e6) == DEFAULT_ACCURACY
    assert choose(None, 10.0) == 10.0 / 2000
    assert choose(None, 0.0) == DEFAULT_ACCURACY


@pytest.mark.parametrize("wish", [{"within": 2.5}, {"within": 1}, {"threads": 1024}, {"up": (0, 0, 1)}])
def test_options_within_range_pass(wish):
    asked = replace(Options(), **wish)
    assert checked(asked) is asked


@pytest.mark.parametrize("views", [["iso", (0.0, 0.0, 0.0)], [(0, 0, 0)], [(math.nan, 0, 1)], ["sideways"]])
def test_a_view_from_nowhere_is_refused_before_the_model_is_read(views):
    with pytest.raises(ViewError):
        checked_views(views, Options())


@pytest.mark.parametrize("diagonal", [1e-3, 0.5, 1.0, 300.0])
@pytest.mark.parametrize("brep", [False, True])
def test_an_accuracy_that_the_drawing_cannot_show_is_refused(diagonal, brep):
    """However small the drawing is: coarser than a quarter of it, or finer than its grid."""
    with pytest.raises(OptionError, match="too coarse"):
        derive(0.26 * diagonal, 1.0, diagonal, brep=brep)
    derive(0.24 * diagonal, 1.0, diagonal, brep=brep)
    with pytest.raises(OptionError, match="too fine"):
        derive(1e-9 * diagonal, 1.0, diagonal, brep=brep)


def test_the_finest_accuracies_are_four_and_a_hundred_steps_of_the_grid():
    assert 4.0 <= FINEST_MESH * 2.0**30 < 5.0
    assert 100.0 <= FINEST_BREP * 2.0**30 < 125.0


def test_what_lies_under_ink_is_no_farther_than_half_a_wide_line():
    for accuracy in (1e-4, 0.01, 0.05, 0.2, 3.0):
        assert accuracy <= under(accuracy) <= max(accuracy, WIDE_MM / 2)
    assert under(0.2) == WIDE_MM / 2


def planned(thing, view="iso", **options):
    source = open_source(thing)
    scene = build(source.mesh(0.05, 0.5), 30.0, 0.05)
    asked = Options(**options)
    camera = resolve(view, asked, source.frame, source.bounds())
    tolerances = derive(0.05, 1.0, 100.0, brep=True)
    placement = Placement(1.0, 1.0, tolerances, 1.0, True, 1.0, 1.0)
    return scene, decide(image_of(scene, camera, placement), asked, Planner(drawing_effects(), asked)), tolerances


@pytest.mark.parametrize("smooth", [False, True])
@pytest.mark.parametrize("seam", [False, True])
def test_which_edges_are_drawn(smooth, seam):
    model = cq.Workplane().cylinder(20, 5).faces(">Z").edges().fillet(1)
    scene, plan, _ = planned(model, smooth=smooth, seam=seam)
    drawn = {k: bool((plan.visibility_input.role[scene.edge_kind == k] & DRAWN).all()) for k in (0, 1, 2)}
    assert drawn == {EdgeClass.SHARP: True, EdgeClass.SMOOTH: smooth, EdgeClass.SEAM: seam}
    assert not (plan.visibility_input.role[scene.edge_kind == INTERIOR] & DRAWN).any()
    # A sharp edge is drawn anyway; anything else on a curved face may turn out to be an outline.
    assert not (plan.visibility_input.role[scene.edge_kind == EdgeClass.SHARP] & OUTLINE).any()
    may = scene.edge_curved & (scene.edge_kind != EdgeClass.SHARP)
    assert ((plan.visibility_input.role & OUTLINE != 0) == may).all()


def test_contact_tolerances():
    model = cq.Assembly().add(cq.Workplane().box(20, 20, 20)).add(cq.Workplane().cylinder(20, 5))
    _, plan, tolerances = planned(model)
    assert plan.visibility_input.delta.tolist() == [tolerances.contact_planar, tolerances.contact]
    # A thin part: no more than half its thickness.
    thin, plan, _ = planned(cq.Workplane().cylinder(0.01, 5))
    assert plan.visibility_input.cap == pytest.approx(0.5 * thin.groups.extent)
    assert plan.visibility_input.cap[0] < 0.0051
    # Meshes bring the tolerance of whoever made them: a share of the whole model's size.
    _, plan, _ = planned(parts(box((3000, 4000, 1)), box((1, 1, 1))))
    # At most half the plate's thickness; of the cube, by its volume and area, 0.3 of a side.
    assert np.minimum(plan.visibility_input.delta, plan.visibility_input.cap) == pytest.approx([0.5, 0.3])
    _, plan, _ = planned(parts(box((3000, 4000, 100)), box((100, 100, 100))))
    assert plan.visibility_input.delta == pytest.approx([np.sqrt(3000**2 + 4000**2 + 100**2) / 8000] * 2)
    counts = plan.visibility_input.counts()
    assert (counts.faced, counts.culled, counts.edges) == (2, 2, 36)
    assert (counts.unsound, counts.unsound_not_culled) == (2, 0)


def test_depth_is_steeper_close_to_the_eye():
    near_far = parts(box((20, 20, 20), (0, 0, 0)), box((20, 20, 20), (0, 200, 0)))
    eye = Perspective(eye=(0, -100, 0), target=(0, 0, 0), fov=60.0)
    _, flat, _ = planned(near_far, "front")
    _, plan, _ = planned(near_far, "front", perspective=eye)
    assert plan.visibility_input.delta / flat.visibility_input.delta == pytest.approx([1, (100 / 300) ** 2])
