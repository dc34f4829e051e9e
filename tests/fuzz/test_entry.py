"""The entry from Python with anything in its arguments: a drawing or an HlrError, in one sentence, and nothing else.

Options and cameras are tried in tests/public/test_errors.py; here it is arrays, objects and several things at once.
"""

from __future__ import annotations

import warnings
from dataclasses import fields
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

import hlr
from hlr import HlrError, Options, Perspective
from support import refusals

KINDS = (
    np.float64,
    np.float32,
    np.float16,
    np.int8,
    np.int64,
    np.uint16,
    np.uint64,
    np.bool_,
    np.complex128,
    "U3",
    "O",
)

any_array = st.sampled_from(KINDS).flatmap(
    lambda kind: (
        st.builds(lambda shape: np.full(shape, None, dtype=object), arrays.array_shapes(max_dims=3, max_side=5))
        if kind == "O"
        else arrays.arrays(np.dtype(kind), arrays.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=5))
    )
)
number = st.one_of(st.floats(-50, 50), st.floats(), st.sampled_from([0.0, 1.0, 1e-300, 1e60, 1e300]))
simple = st.one_of(
    st.none(), st.booleans(), st.integers(), st.floats(), st.text("a1, .-é", max_size=5), st.binary(max_size=5)
)


def nested(leaves: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    """Lists, tuples and dictionaries of these, in one another."""
    return st.recursive(
        leaves,
        lambda inner: st.one_of(
            st.lists(inner, max_size=3),
            st.tuples(inner, inner),
            st.dictionaries(st.text(max_size=2), inner, max_size=2),
        ),
        max_leaves=6,
    )


@st.composite
def meshes(draw: st.DrawFn) -> tuple[np.ndarray, np.ndarray]:
    """Points of any size, or all of them tame, over which any triangles hang, in any memory layout."""
    count = draw(st.integers(3, 12))
    value = draw(st.sampled_from([number, st.floats(-50, 50), st.integers(-50, 50).map(float)]))
    points = np.array(draw(st.lists(st.tuples(value, value, value), min_size=count, max_size=count)))
    corner = st.integers(0, count - 1)
    faces = np.array(draw(st.lists(st.tuples(corner, corner, corner), min_size=1, max_size=12)))
    kind = draw(st.sampled_from([np.int8, np.uint8, np.int64, np.uint64]))
    layout = draw(st.sampled_from(["C", "F", "strided", "frozen", "swapped"]))
    faces = faces.astype(kind)
    if layout == "F":
        points, faces = np.asfortranarray(points), np.asfortranarray(faces)
    elif layout == "strided":
        points, faces = np.repeat(points, 2, axis=0)[::2], np.repeat(faces, 2, axis=1)[:, ::2]
    elif layout == "swapped":
        points = points.astype(points.dtype.newbyteorder())
    points.flags.writeable = layout != "frozen"
    return points, faces


def checked(source: Any, view: Any = "iso", *, right: bool | None = None, **options: Any) -> bool:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        return refusals.checked(source, view, right=right, longest=400, **options)


def right_arrays(vertices: np.ndarray, faces: np.ndarray) -> bool | None:
    """Whether these are a model; None where that is a matter of degree."""
    if vertices.ndim != 2 or vertices.shape[1] != 3 or faces.ndim != 2 or faces.shape[1] not in (3, 4):
        return False
    if vertices.dtype.kind not in "iuf" or faces.dtype.kind not in "iu" or not len(faces):
        return False if vertices.dtype.kind in "cU" or faces.dtype.kind in "cU" or not len(faces) else None
    if int(faces.min()) < 0 or int(faces.max()) >= len(vertices):
        return False
    return refusals.is_a_model(vertices, faces.astype(np.int64)[:, :3])


@pytest.mark.slow
@given(any_array, any_array)
@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_any_arrays(vertices: np.ndarray, faces: np.ndarray) -> None:
    checked((vertices, faces), right=right_arrays(vertices, faces))


def test_arrays_of_each_kind() -> None:
    """Of every kind of number that can hold a model one is drawn; of the others none is."""
    points, corners = [[0, 0, 0], [3, 0, 0], [0, 2, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
    for kind in KINDS:
        for other in KINDS:
            vertices, faces = np.array(points).astype(kind), np.array(corners).astype(other)
            checked((vertices, faces), right=right_arrays(vertices, faces))


@pytest.mark.slow
@given(nested(st.one_of(simple, any_array)))
@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_anything_as_a_source(thing: Any) -> None:
    checked(thing, right=None if isinstance(thing, tuple) and len(thing) == 2 else False)


def test_a_pair_of_lists_as_a_source() -> None:
    checked(([(0, 0, 0), (3, 0, 0), (0, 2, 0)], [(0, 1, 2)]), right=True)


OPTIONS = [field.name for field in fields(Options)]
TETRAHEDRON = (
    np.array([[0, 0, 0], [3, 0, 0], [0, 2, 0], [0, 0, 1]]),
    np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]),
)
# With the usual values, beside one that is tried.
USUAL = {field.name: field.default for field in fields(Options)}
SOUND: dict[str, Any] = {"view": "top", "scale": 2, "fit": (30, 40), "accuracy": 0.1, "crease": 20, "up": (1, 2, 0.5)}
SOUND |= {
    "threads": 1,
    "perspective": Perspective(fov=40.0),
    "within": 5.0,
    "window": (0, 0, 5, 5),
    "only": ("*",),
    "hide": (),
}


def with_option(name: str, thing: Any, right: bool | None = None) -> None:
    if name in ("within", "report"):
        # What takes long: whether it is taken is asked, and not how it is done.
        thing = 2.0 if isinstance(thing, (int, float)) and thing > 2.0 else thing
    checked(TETRAHEDRON, right=right, **{name: thing})


def right_option(name: str, thing: Any) -> bool | None:
    if name == "view":
        return refusals.verdict(thing)
    return refusals.verdict(**{name: thing}) if name in refusals.JUDGED else None


@pytest.mark.slow
@given(st.sampled_from(["view", *OPTIONS]), nested(simple))
@settings(max_examples=300, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_anything_as_an_option(name: str, thing: Any) -> None:
    if name == "threads" and isinstance(thing, int) and thing > 3:
        thing = 3
    with_option(name, thing, right_option(name, thing))


@pytest.mark.parametrize("name", ["view", *OPTIONS])
def test_each_option_with_a_sound_value(name: str) -> None:
    usual = USUAL.get(name)
    with_option(name, SOUND[name] if name in SOUND else not usual if isinstance(usual, bool) else usual, True)


@pytest.mark.parametrize("name", [name for name in ("view", *OPTIONS) if not isinstance(USUAL.get(name), bool)])
def test_an_array_as_an_option(name: str) -> None:
    words = {"eye": "eye"}
    with pytest.raises(HlrError, match=words.get(name, name)):
        hlr.draw(TETRAHEDRON, **{name: np.zeros((4, 1))})
    with_option(name, np.zeros((4, 1)), False)


@pytest.mark.parametrize("size", [0, 2])
def test_an_array_as_a_flag(size: int) -> None:
    with pytest.raises(HlrError, match="hidden is yes or no"):
        hlr.draw(TETRAHEDRON, hidden=np.zeros(size))


def test_a_view_of_two_lines() -> None:
    with pytest.raises(HlrError, match="view"):
        hlr.draw(TETRAHEDRON, "iso\nfront")
    with_option("view", "iso\nfront", False)


@pytest.mark.slow
@given(
    meshes(),
    st.one_of(st.sampled_from(["iso", "front", "top"]), st.tuples(number, number, number)),
    st.sampled_from([None, (100.0, 80.0)]),
    st.sampled_from([None, Perspective(), Perspective(eye=(1.0, 2.0, 3.0)), Perspective(fov=120.0)]),
    st.booleans(),
)
@settings(max_examples=200, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_any_mesh_from_anywhere(mesh: Any, view: Any, fit: Any, perspective: Any, smooth: bool) -> None:
    before = [table.copy() for table in mesh]
    sound = refusals.is_a_model(*mesh) and refusals.verdict(view, fit=fit, perspective=perspective)
    checked(mesh, view, right=True if sound else None, fit=fit, perspective=perspective, smooth=smooth)
    for table, copy in zip(mesh, before, strict=True):
        np.testing.assert_array_equal(table, copy)


@given(meshes())
@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_info_of_any_mesh(mesh: Any) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        try:
            info = hlr.info(mesh)
        except HlrError:
            assert not refusals.is_a_model(*mesh)
            return
    assert info.parts


@pytest.mark.slow
@given(meshes(), st.integers(1, 3))
@settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_the_same_again_on_more_threads(mesh: Any, threads: int) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        try:
            one, more = (hlr.draw_views(mesh, ["iso"], Options(fit=(100.0, 100.0), threads=n))[0] for n in (1, threads))
        except HlrError:
            assert not refusals.is_a_model(*mesh)
            return
    assert [line.points.tolist() for line in one.lines] == [line.points.tolist() for line in more.lines]


def test_another_error_would_be_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(hlr, "draw", lambda *_, **__: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        checked(None)
