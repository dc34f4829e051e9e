"""Whatever is asked, the answer is a drawing or an HlrError in one sentence, never another exception."""

import math

import numpy as np
import pytest
import trimesh
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from linework.models import box
from refusals import drawn_or_refused

import hlr
from hlr import HlrError, Options, Perspective

BOX = box((10, 20, 30))


def test_every_error_is_an_hlr_error():
    for name in hlr.__all__:
        thing = getattr(hlr, name)
        if isinstance(thing, type) and issubclass(thing, Exception):
            assert issubclass(thing, HlrError)


any_float = st.one_of(
    st.floats(), st.sampled_from([0.0, -0.0, 1.0, 1e-300, 1e300, 5e-324, math.inf, -math.inf, math.nan, 30.0, 180.0])
)
vector = st.tuples(any_float, any_float, any_float)
near = st.tuples(*[st.floats(-60, 60)] * 3)


@given(
    view=st.one_of(st.sampled_from(["front", "iso", "nowhere", ""]), vector, near, st.lists(any_float, max_size=4)),
    scale=st.one_of(st.just(1.0), any_float),
    fit=st.one_of(st.none(), st.tuples(any_float, any_float)),
    accuracy=st.one_of(st.none(), any_float),
    crease=st.one_of(st.just(30.0), any_float),
    up=st.one_of(st.none(), vector, near),
    threads=st.integers(-2, 3),
    strict=st.booleans(),
)
@settings(max_examples=250, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_any_numbers_as_options(**options):
    view = options.pop("view")
    # So small a size that the scale becomes zero has a test of its own.
    assume(options["fit"] is None or not any(0 < f < 1e-290 for f in options["fit"]))
    drawn_or_refused(BOX, view, **options)


def test_a_size_so_small_that_the_scale_is_zero():
    drawn_or_refused(BOX, "front", fit=(1.0, 5e-324))


# A corner exactly in the plane of the eye has a test of its own.
off = st.tuples(*[st.floats(-60, 60).map(lambda x: x + 0.123456789)] * 3)


@given(
    eye=st.one_of(st.none(), off),
    target=st.one_of(st.none(), off),
    fov=st.one_of(st.none(), st.floats(-10, 200), st.just(math.nan)),
    fit=st.sampled_from([None, (100.0, 80.0)]),
)
@settings(max_examples=100, deadline=None)
def test_any_camera_among_the_parts(eye, target, fov, fit):
    drawn_or_refused(BOX, "iso", fit=fit, perspective=Perspective(eye=eye, target=target, fov=fov))


@given(eye=st.one_of(st.none(), vector), target=st.one_of(st.none(), vector), fov=st.one_of(st.none(), any_float))
@settings(max_examples=150, deadline=None)
def test_any_numbers_as_a_camera(eye, target, fov):
    if eye is not None:
        way = [e - t for e, t in zip(eye, target or (0.0, 0.0, 0.0), strict=True)]
        assume(1e-3 < math.hypot(*way) < 1e6)
        way = np.asarray(way) / math.hypot(*way)
        assume((np.abs((BOX.vertices - eye) @ way) > 1e-6).all())
    drawn_or_refused(BOX, "front", perspective=Perspective(eye=eye, target=target, fov=fov))


def test_an_eye_almost_at_its_target():
    drawn_or_refused(BOX, "front", perspective=Perspective(eye=(0, 0, 0), target=(0, 1e-300, 0)))


@given(
    st.lists(st.lists(any_float, min_size=3, max_size=3), min_size=1, max_size=5),
    st.lists(st.lists(st.integers(-1, 5), min_size=3, max_size=4), min_size=1, max_size=5),
)
@settings(max_examples=150, deadline=None)
def test_any_numbers_as_a_mesh(points, faces):
    with np.errstate(all="ignore"):
        drawn_or_refused((points, faces), "iso")


@pytest.mark.parametrize(
    "source",
    [
        None,
        5,
        b"part.step",
        "",
        "no such file.step",
        "/",
        "a\0b.step",
        [],
        (),
        {},
        ([], []),
        (np.zeros((0, 3)), np.zeros((0, 3), int)),
        (np.zeros((3, 2)), np.array([[0, 1, 2]])),
        (np.zeros((3, 3)), np.array([[0, 1, 2]])),
        (np.eye(3), np.array([[0, 1, 9]])),
        (np.eye(3), np.array([[0.5, 1, 2]])),
        ([["a", "b", "c"]], [[0, 0, 0]]),
        object(),
        trimesh.Trimesh(),
        trimesh.Scene(),
        trimesh.PointCloud([[0, 0, 0]]),
        [BOX, BOX],
        hlr,
        lambda: None,
    ],
    ids=lambda s: repr(s)[:24],
)
def test_what_is_no_model(source):
    assert not drawn_or_refused(source)
    with pytest.raises(HlrError):
        hlr.info(source)


WRONG = [
    {"scale": "1:2"},
    {"scale": None},
    {"fit": 5},
    {"fit": (1.0,)},
    {"fit": (100.0, 100.0, 100.0)},
    {"fit": ("a", "b")},
    {"accuracy": "fine"},
    {"crease": None},
    {"up": 5},
    {"up": ("a", 0, 0)},
    {"threads": 1.5},
    {"threads": 10**30},
    {"hidden": "no"},
    {"perspective": True},
    {"perspective": Perspective(eye=(1.0, 2.0))},
    {"perspective": Perspective(eye=(1.0, 2.0, "a"))},
    {"perspective": Perspective(fov="wide")},
    {"view": None},
    {"view": 5},
    {"view": ("a", 0, 0)},
    {"colour": "red"},
]


@pytest.mark.parametrize("wish", WRONG, ids=str)
def test_an_option_of_the_wrong_type_is_refused_in_one_sentence(wish):
    assert not drawn_or_refused(BOX, **wish)


def test_no_views_at_all():
    try:
        assert hlr.draw_views(BOX, []) == []
    except HlrError:
        return


@pytest.mark.parametrize("views", ["iso", (1, -1, 1)], ids=str)
def test_one_view_where_several_are_asked_for_is_understood_or_said(views):
    try:
        hlr.draw_views(BOX, views)
    except HlrError as error:
        assert "'i'" not in str(error)


@pytest.mark.parametrize("crease", [math.nan, -1.0, 500.0, "x"])
def test_info_refuses_the_creases_that_draw_refuses(crease):
    with pytest.raises(HlrError):
        hlr.info(BOX, crease=crease)


@pytest.mark.parametrize("crease", [math.nan, -1.0, 500.0])
def test_draw_refuses_a_crease_out_of_range(crease):
    with pytest.raises(HlrError, match="crease"):
        hlr.draw(BOX, crease=crease)


def test_a_refusal_comes_before_the_file_is_opened():
    with pytest.raises(hlr.OptionError):
        hlr.draw_views("no such file.step", ["iso"], Options(scale=-1.0))
