"""Move model and camera together, or scale or mirror the model: the drawing moves along, and nothing else changes.

IDENTICAL  by a power of two: every coordinate on paper, every line's class, owner and order, every counter; only
           `points3` and the tolerances in model units are scaled, exactly. On a lattice of integers moved by integers
           and seen along an axis: the same.
           In the kernel, on integers: every piece of every edge under any change of depth that keeps what is in front
           of what (depth times k, plus a x + b y + c); and under the eight symmetries of the image plane every piece of
           every edge that lies over no other edge in the image. One that does is decided as if moved to one fixed
           side, so there a mirror may change what is hidden; in drawings one of the two lines covers the other.
MAY MOVE   otherwise coordinates are rounded anew, so ink may move by the accuracy (it moves by far less), and what
           rounding decides (contacts, lines over one another) may differ: stretches up to `ink.LONGEST`.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from properties import changes, models
from properties.assemblies import Piece, assemblies, assembly, axes, examples, rotation, upright, views
from properties.frozen import draw
from properties.identity import identities
from properties.ink import expect_same_ink

from hlr import Perspective
from hlr.request.accuracy import under
from support.visibility import adapter, scenes
from support.visibility.scenes import Edge, Scene

ACCURACY = 0.01
degrees = st.integers(1, 359)
kinds = st.booleans()
PLAIN = {"intersections": False}
"""Random assemblies often touch all along a face; where the line of such an intersection ends, rounding decides."""
CROSSING = (Piece("box", (0, 0, 0), (4, 4, 4)), Piece("cylinder", (2, 2, 2), (4, 4, 4), (1, 1, 0), 30))
few = examples(20)


def moved_camera(before, matrix):
    view = before.view
    return tuple(matrix @ view.direction), tuple(matrix @ view.up)


def expect_turned(model, view, turn, accuracy, **options):
    before = draw(model, view, accuracy, **options)
    direction, up = moved_camera(before, turn)
    expect_same_ink(before, draw(changes.moved(model, turn), direction, accuracy, up=up, **options))


@pytest.mark.slow
@few
@given(assemblies(), kinds, views, axes, degrees)
def test_an_assembly_turned_with_the_camera(pieces, brep, view, axis, angle):
    expect_turned(assembly(pieces, brep), view, rotation(axis, angle), ACCURACY, **PLAIN)


@pytest.mark.slow
@pytest.mark.parametrize("name", models.SOLIDS)
@pytest.mark.parametrize("view", ["front", "iso"])
def test_a_model_turned_with_the_camera(name, view):
    model = models.model(name)
    expect_turned(model, view, rotation((1, 2, 3), 37), models.accuracy(model))


@pytest.mark.parametrize("brep", [True, False])
def test_a_thin_sheet_turned_with_the_camera(brep):
    """It hides the cylinder under it whichever way both stand: the contact tolerance stays below half its thickness."""
    model = changes.moved(assembly([Piece("cylinder", (20, 20, -5), (50, 50, 5)), SHEET], brep), np.eye(3))
    sheet = model.parts[1]
    thin = replace(sheet, points=sheet.points * [1.0, 1.0, 0.1])
    expect_turned(replace(model, parts=(model.parts[0], thin)), "top", rotation((1, 0, 0), 45), 0.05)


SHEET = Piece("box", (0, 0, 0), (90, 90, 1))


def expect_shifted(model, view, offset, accuracy, **options):
    before = draw(model, view, accuracy, **options)
    v = before.view
    paper = np.array([np.dot(offset, v.right), np.dot(offset, v.up)]) * before.unit * before.scale
    after = draw(changes.moved(model, np.eye(3), offset), v.direction, accuracy, up=v.up, **options)
    expect_same_ink(before, after, back=lambda p: p - paper)
    assert np.abs(np.array(after.origin) - before.origin - paper).max() < accuracy


far = st.tuples(*[st.floats(-1e6, 1e6)] * 3)


@pytest.mark.slow
@few
@given(assemblies(), kinds, views, far)
def test_an_assembly_moved_by_a_million_times_its_size(pieces, brep, view, offset):
    model = assembly(pieces, brep)
    expect_shifted(model, view, np.array(offset) * model.diagonal, ACCURACY, **PLAIN)


@pytest.mark.slow
@pytest.mark.parametrize("name", models.SOLIDS)
def test_a_model_moved_by_a_million_times_its_size(name):
    model = models.model(name)
    expect_shifted(model, "iso", 1e6 * model.diagonal * np.array([1.0, 0.7, -0.3]), models.accuracy(model))


@pytest.mark.slow
@few
@given(
    assemblies(upright),
    kinds,
    st.sampled_from(["front", "left", "top"]),
    st.tuples(*[st.integers(-(10**6), 10**6)] * 3),
)
def test_integers_moved_by_integers_are_the_same_lines(pieces, brep, view, offset):
    straight = tuple(p for p in pieces if p.kind in ("box", "wedge", "tetrahedron")) or (
        Piece("box", (0, 0, 0), (1, 1, 1)),
    )
    model = assembly(straight, brep)
    before, after = draw(model, view, ACCURACY), draw(changes.moved(model, np.eye(3), offset), view, ACCURACY)
    assert identities(before) == identities(after)
    assert before.counters == after.counters
    for one, other in zip(before.lines, after.lines, strict=True):
        # A line cut between two integers ends at a quotient, which is rounded at another size.
        assert np.abs(one.points - other.points).max() < 1e-8
        assert np.abs(one.points3 + offset - other.points3).max() < 1e-8


def expect_doubled(model, view, power, accuracy, **options):
    """Twice as large at half the scale: the same paper; and at the same scale: paper twice as large, as long as what
    lies under the ink of a line grows along: its width has no scale."""
    factor = 2.0**power
    before = draw(model, view, accuracy, **options)
    larger = changes.moved(model, factor * np.eye(3))
    for scale, wide in ((1.0 / factor, 1.0), (1.0, factor)):
        if under(wide * accuracy) != wide * under(accuracy):
            continue
        eye = options.get("perspective")
        more = {"perspective": _scaled(eye, factor)} if eye else {}
        after = draw(larger, view, accuracy * wide, **{**options, **more, "scale": scale})
        assert identities(before) == identities(after)
        assert before.counters == after.counters
        assert tuple(wide * c for c in before.origin) == after.origin
        for one, other in zip(before.lines, after.lines, strict=True):
            assert (wide * one.points == other.points).all()
            assert (factor * one.points3 == other.points3).all()
        assert factor * before.accuracy.contact == after.accuracy.contact


def _scaled(perspective, factor):
    eye = perspective.eye and tuple(factor * c for c in perspective.eye)
    return replace(perspective, eye=eye, target=perspective.target and tuple(factor * c for c in perspective.target))


@pytest.mark.slow
@few
@given(assemblies(), kinds, views, st.integers(-29, 29))
def test_an_assembly_scaled_by_a_power_of_two(pieces, brep, view, power):
    expect_doubled(assembly(pieces, brep), view, power, ACCURACY)


@pytest.mark.slow
@few
@given(assemblies(), kinds, st.integers(-29, 29))
def test_in_perspective_too(pieces, brep, power):
    camera = Perspective(eye=(31.0, -42.0, 23.0), target=(5.0, 5.0, 5.0), fov=40.0)
    expect_doubled(assembly(pieces, brep), "iso", power, ACCURACY, perspective=camera)


@pytest.mark.slow
@pytest.mark.parametrize("name", models.EVERY)
def test_a_model_scaled_by_a_power_of_two(name):
    model = models.model(name)
    for power in (20, -20):
        expect_doubled(model, "iso", power, models.accuracy(model), smooth=True)


def expect_scaled(model, view, factor, accuracy, **options):
    before = draw(model, view, accuracy, **options)
    after = draw(changes.moved(model, factor * np.eye(3)), view, accuracy, scale=1.0 / factor, **options)
    expect_same_ink(before, after)


@pytest.mark.slow
@few
@given(assemblies(), kinds, views, st.floats(1e-4, 1e4))
def test_an_assembly_scaled_by_any_factor(pieces, brep, view, factor):
    expect_scaled(assembly(pieces, brep), view, factor, ACCURACY, **PLAIN)


@pytest.mark.parametrize("name", models.SOLIDS)
@pytest.mark.parametrize("factor", [1.0 / 3.0, 25.4])
def test_a_model_scaled_by_any_factor(name, factor):
    model = models.model(name)
    expect_scaled(model, "iso", factor, models.accuracy(model))


def expect_mirrored(model, view, accuracy, **options):
    """Left and right change sides: reflected in the plane of the view direction and up, seen by the same camera."""
    before = draw(model, view, accuracy, **options)
    right = np.array(before.view.right)
    glass = np.eye(3) - 2.0 * np.outer(right, right)
    after = draw(changes.moved(model, glass), before.view.direction, accuracy, up=before.view.up, **options)
    expect_same_ink(before, after, back=lambda p: p * [-1.0, 1.0])


@pytest.mark.slow
@few
@given(assemblies(), kinds, views)
def test_an_assembly_in_a_mirror(pieces, brep, view):
    expect_mirrored(assembly(pieces, brep), view, ACCURACY, **PLAIN)


@pytest.mark.slow
@pytest.mark.parametrize("name", models.SOLIDS)
@pytest.mark.parametrize("view", ["front", "iso"])
def test_a_model_in_a_mirror(name, view):
    model = models.model(name)
    expect_mirrored(model, view, models.accuracy(model))


@pytest.mark.parametrize("brep", [True, False])
def test_parts_that_cross_with_their_intersection_lines(brep):
    model = assembly(CROSSING, brep)
    assert any(line.kind == "intersection" for line in draw(model, "iso", ACCURACY).lines)
    expect_turned(model, "iso", rotation((1, 2, 3), 37), ACCURACY)
    expect_shifted(model, "iso", np.array([1e7, -3e6, 2e6]), ACCURACY)
    expect_scaled(model, "iso", 0.3, ACCURACY)
    expect_mirrored(model, "iso", ACCURACY)


SYMMETRIES = [((a, 0), (0, b)) for a in (1, -1) for b in (1, -1)] + [((0, a), (b, 0)) for a in (1, -1) for b in (1, -1)]
seeds = st.integers(0, 10**6)
ways = st.sampled_from([adapter.ONE, adapter.PARTS, adapter.TRUSTED])


def prepared(seed: int, way: adapter.Way) -> tuple[Scene, adapter.Way]:
    """A scene as the kernel asks for it, and how to put it: only sound solids can be trusted."""
    scene = scenes.scene(seed)
    return (scene.apart() if way.parts else scene), adapter.PARTS if way.trusted and not scene.closed else way


def over_another(scene: Scene, edge: Edge) -> bool:
    """Whether some other edge runs along the same line of the image and shares a stretch with it."""
    (ax, ay, _), (bx, by, _) = scene.segment(edge)
    ux, uy = bx - ax, by - ay
    for other in scene.edges():
        ends = [(x - ax, y - ay) for x, y, _ in scene.segment(other)]
        if other != edge and all(ux * y - uy * x == 0 for x, y in ends):
            at = sorted(ux * x + uy * y for x, y in ends)
            if at[0] < ux * ux + uy * uy and at[1] > 0 and at[0] < at[1]:
                return True
    return False


@examples(60)
@given(seeds, ways, st.sampled_from(SYMMETRIES))
def test_pieces_under_the_symmetries_of_the_image(seed, way, matrix):
    scene, way = prepared(seed, way)
    (a, b), (c, d) = matrix
    points = tuple((a * x + b * y, c * x + d * y, z) for x, y, z in scene.points)
    flip = a * d - b * c < 0
    faces = tuple((i, k, j) if flip else (i, j, k) for i, j, k in scene.faces)
    mirrored = replace(scene, points=points, faces=faces)
    before, after = adapter.visibility(scene, way).pieces, adapter.visibility(mirrored, way).pieces
    for edge in scene.edges():
        if not over_another(scene, edge):
            assert before.get(edge) == after.get(edge)


@examples(60)
@given(seeds, ways, st.integers(1, 50), st.tuples(*[st.integers(-50, 50)] * 3))
def test_pieces_under_a_change_of_depth(seed, way, k, shear):
    scene, way = prepared(seed, way)
    a, b, c = shear
    points = tuple((x, y, k * z + a * x + b * y + c) for x, y, z in scene.points)
    sheared = replace(scene, points=points)
    assert adapter.visibility(sheared, way).pieces == adapter.visibility(scene, way).pieces
