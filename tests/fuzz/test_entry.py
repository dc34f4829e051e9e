"""The entry from Python with anything in its arguments: a drawing or an HlrError, in one sentence, and nothing else.

Options and cameras are tried in tests/test_errors.py; here it is arrays, objects and several things at once.
"""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest
import refusals
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

import hlr
from hlr import HlrError, Options, Perspective

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
    """Points of any size over which any triangles hang, in any memory layout."""
    count = draw(st.integers(1, 12))
    points = np.array(draw(st.lists(st.tuples(number, number, number), min_size=count, max_size=count)))
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


def drawn_or_refused(source: Any, view: Any = "iso", **options: Any) -> bool:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        return refusals.drawn_or_refused(source, view, longest=400, **options)


@given(any_array, any_array)
@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_any_arrays(vertices: np.ndarray, faces: np.ndarray) -> None:
    drawn_or_refused((vertices, faces))


@given(nested(st.one_of(simple, any_array)))
@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_anything_as_a_source(thing: Any) -> None:
    drawn_or_refused(thing)


OPTIONS = ["view", "scale", "fit", "accuracy", "crease", "up", "threads", "hidden", "perspective"]


def with_option(name: str, thing: Any) -> None:
    if name == "threads" and isinstance(thing, int):
        thing %= 4
    points = np.array([[0, 0, 0], [3, 0, 0], [0, 2, 0], [0, 0, 1]])
    drawn_or_refused((points, np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])), **{name: thing})


@given(st.sampled_from(OPTIONS), nested(simple))
@settings(max_examples=200, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_anything_as_an_option(name: str, thing: Any) -> None:
    with_option(name, thing)


@pytest.mark.parametrize("name", [name for name in OPTIONS if name != "hidden"])
def test_an_array_as_an_option(name: str) -> None:
    with_option(name, np.zeros((4, 1)))


@pytest.mark.parametrize("size", [0, 2])
def test_an_array_as_a_flag(size: int) -> None:
    with_option("hidden", np.zeros(size))


def test_a_view_of_two_lines() -> None:
    with_option("view", "iso\nfront")


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
    drawn_or_refused(mesh, view, fit=fit, perspective=perspective, smooth=smooth)
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
            return
    assert info.parts


@given(meshes(), st.integers(1, 3))
@settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_the_same_again_on_more_threads(mesh: Any, threads: int) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        try:
            one, more = (hlr.draw_views(mesh, ["iso"], Options(fit=(100.0, 100.0), threads=n))[0] for n in (1, threads))
        except HlrError:
            return
    assert [line.points.tolist() for line in one.lines] == [line.points.tolist() for line in more.lines]


def test_another_error_would_be_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(hlr, "draw", lambda *_, **__: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        drawn_or_refused(None)
