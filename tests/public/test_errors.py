"""Whatever is asked, the answer is a drawing or an HlrError in one sentence, never another exception."""

import ast
import math
from pathlib import Path

import numpy as np
import pytest
import trimesh
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

import hlr
from hlr import HlrError, Options, Perspective
from hlr.errors import SourceError
from support.models import box
from support.refusals import checked, drawn_or_refused, is_a_model, verdict

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


@pytest.mark.slow
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
    checked(BOX, view, right=verdict(view, **options), **options)


def test_a_size_so_small_that_the_scale_is_zero():
    with pytest.raises(HlrError, match="`fit` needs"):
        hlr.draw(BOX, "front", fit=(1.0, 5e-324))


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
    camera = Perspective(eye=eye, target=target, fov=fov)
    checked(BOX, "iso", right=verdict("iso", perspective=camera), fit=fit, perspective=camera)


@pytest.mark.slow
@given(eye=st.one_of(st.none(), vector), target=st.one_of(st.none(), vector), fov=st.one_of(st.none(), any_float))
@settings(max_examples=150, deadline=None)
def test_any_numbers_as_a_camera(eye, target, fov):
    if eye is not None:
        way = [e - t for e, t in zip(eye, target or (0.0, 0.0, 0.0), strict=True)]
        assume(1e-3 < math.hypot(*way) < 1e6)
        way = np.asarray(way) / math.hypot(*way)
        assume((np.abs((BOX.vertices - eye) @ way) > 1e-6).all())
    camera = Perspective(eye=eye, target=target, fov=fov)
    checked(BOX, "front", right=verdict("front", perspective=camera), perspective=camera)


def test_an_eye_almost_at_its_target():
    with pytest.raises(HlrError, match="eye"):
        hlr.draw(BOX, "front", perspective=Perspective(eye=(0, 0, 0), target=(0, 1e-300, 0)))


@given(
    st.one_of(
        st.lists(st.lists(any_float, min_size=3, max_size=3), min_size=1, max_size=5),
        st.lists(st.lists(st.integers(-60, 60), min_size=3, max_size=3), min_size=6, max_size=6),
    ),
    st.lists(st.lists(st.integers(-1, 5), min_size=3, max_size=4), min_size=1, max_size=5),
)
@settings(max_examples=150, deadline=None)
def test_any_numbers_as_a_mesh(points, faces):
    with np.errstate(all="ignore"):
        corners, ragged = [i for face in faces for i in face], len({len(face) for face in faces}) > 1
        if ragged or min(corners) < 0 or max(corners) >= len(points):
            checked((points, faces), right=False)
        else:
            triangles = [[face[0], *face[k : k + 2]] for face in faces for k in range(1, len(face) - 1)]
            checked((points, faces), right=is_a_model(points, triangles))


NO_OBJECT = "of type {} cannot be drawn"


@pytest.mark.parametrize(
    ("source", "reason"),
    [
        (None, NO_OBJECT.format("NoneType")),
        (5, NO_OBJECT.format("int")),
        (b"part.step", NO_OBJECT.format("bytes")),
        ("", "the name of the source is empty: name a model file"),
        ("no such file.step", "no such file.step does not exist"),
        ("/", "is a folder"),
        ("a\0b.step", "does not exist"),
        ([], NO_OBJECT.format("list")),
        ((), NO_OBJECT.format("tuple")),
        ({}, NO_OBJECT.format("dict")),
        (([], []), NO_OBJECT.format("tuple")),
        ((np.zeros((0, 3)), np.zeros((0, 3), int)), "no triangles"),
        ((np.zeros((3, 2)), np.array([[0, 1, 2]])), r"shape \(n, 3\), not \(3, 2\)"),
        ((np.zeros((3, 3)), np.array([[0, 1, 2]])), "only degenerate triangles"),
        ((np.eye(3), np.array([[0, 1, 9]])), "name 1 vertices that do not exist"),
        ((np.eye(3), np.array([[0.5, 1, 2]])), "whole numbers"),
        (([["a", "b", "c"]], [[0, 0, 0]]), "arrays of numbers"),
        (object(), NO_OBJECT.format("object")),
        (trimesh.Trimesh(), "no triangles"),
        (trimesh.Scene(), "no triangles"),
        (trimesh.PointCloud([[0, 0, 0]]), "no triangles"),
        ([BOX, BOX, 5], NO_OBJECT.format("list")),
        (hlr, NO_OBJECT.format("module")),
        (lambda: None, NO_OBJECT.format("function")),
    ],
    ids=lambda s: s if isinstance(s, str) else type(s).__name__,
)
def test_what_is_no_model(source, reason):
    assert not drawn_or_refused(source)
    for asked in (hlr.draw, hlr.info):
        with pytest.raises(HlrError, match=reason):
            asked(source)


WRONG = [
    ({"scale": "half"}, "scale 'half'"),
    ({"scale": True}, "scale True"),
    ({"page": "A9"}, "no page is called 'A9': use A0, "),
    ({"page": "A4-upright"}, "'A4-upright' lies neither landscape nor portrait"),
    ({"page": 5}, "page needs the name of a sheet"),
    ({"page": (15.0, 300.0)}, "a page of 15x300 mm cannot be drawn on"),
    ({"fit": "B4"}, "no page is called 'B4'"),
    ({"fit": "A4", "page": "A3"}, "`page` and `fit` both name a sheet"),
    ({"fit": 5}, "`fit` needs .* not 5"),
    ({"fit": (1.0,)}, "`fit` needs"),
    ({"fit": (100.0, 100.0, 100.0)}, "`fit` needs"),
    ({"fit": ("a", "b")}, "`fit` needs"),
    ({"accuracy": "fine"}, "accuracy 'fine'"),
    ({"crease": None}, "crease None"),
    ({"up": 5}, "up needs"),
    ({"up": ("a", 0, 0)}, "up needs"),
    ({"threads": 1.5}, "1.5 threads"),
    ({"threads": 10**30}, "1000000 threads|0 threads"),
    ({"hidden": "no"}, "hidden is yes or no"),
    ({"perspective": True}, "perspective needs"),
    ({"perspective": Perspective(eye=(1.0, 2.0))}, "`eye` needs"),
    ({"perspective": Perspective(eye=(1.0, 2.0, "a"))}, "`eye` needs"),
    ({"perspective": Perspective(fov="wide")}, "field of view of 'wide'"),
    ({"view": None}, "None is no view"),
    ({"view": 5}, "5 is no view"),
    ({"view": ("a", 0, 0)}, "is no view"),
    ({"colour": "red"}, "colour"),
]


@pytest.mark.parametrize(("wish", "reason"), WRONG, ids=str)
def test_an_option_of_the_wrong_type_is_refused_in_one_sentence(wish, reason):
    assert not drawn_or_refused(BOX, **wish)
    with pytest.raises(HlrError, match=reason):
        hlr.draw(BOX, **{"view": "iso", **wish})


def test_no_views_at_all():
    assert hlr.draw_views(BOX, []) == []


@pytest.mark.parametrize("views", ["iso", (1, -1, 1)], ids=str)
def test_one_view_where_several_are_asked_for_is_understood_or_said(views):
    assert len(hlr.draw_views(BOX, views)) == 1


@pytest.mark.parametrize("crease", [math.nan, -1.0, 500.0, "x"])
def test_info_refuses_the_creases_that_draw_refuses(crease):
    with pytest.raises(HlrError, match="crease"):
        hlr.info(BOX, crease=crease)


@pytest.mark.parametrize("crease", [math.nan, -1.0, 500.0])
def test_draw_refuses_a_crease_out_of_range(crease):
    with pytest.raises(HlrError, match="crease"):
        hlr.draw(BOX, crease=crease)


def test_a_refusal_comes_before_the_file_is_opened():
    with pytest.raises(hlr.OptionError, match="scale"):
        hlr.draw_views("no such file.step", ["iso"], Options(scale=-1.0))


def test_every_error_is_a_sentence():
    for words, told in (
        ("no view: give one", "no view: give one."),
        ("Why?", "Why?"),
        ("It ends here.", "It ends here."),
    ):
        assert str(SourceError(words)) == told


def test_every_note_in_the_source_is_a_sentence():
    """As far as its text stands there; what is put together ends with what stands last."""
    found = 0
    for path in [p for folder in ("hlr", "cli") for p in (Path(__file__).parents[2] / folder).rglob("*.py")]:
        for call in ast.walk(ast.parse(path.read_text())):
            if isinstance(call, ast.Call) and getattr(call.func, "id", "") == "Note" and len(call.args) == 2:
                last = call.args[1].values[-1] if isinstance(call.args[1], ast.JoinedStr) else call.args[1]
                if isinstance(last, ast.Constant):
                    found += 1
                    assert last.value.endswith("."), f"{path.name}:{call.lineno}: {last.value!r}"
    assert found > 10
