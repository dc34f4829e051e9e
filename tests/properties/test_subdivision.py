"""A finer triangulation of the same faces gives the same drawing.

IDENTICAL  of B-rep boxes that stand apart, on a lattice where dividing sides rounds nothing, seen from a direction in
           which no line lies over another: the number, class, visibility and owner of lines; where they are cut,
           within 2^-28 of the whole, for seen askew the new corners lie up to half a step of the grid off their edge.
           In the kernel, on integers: the same pieces, put together; their ends within 1e-15 of the edge.
MAY MOVE   elsewhere the new corners are rounded, lines may begin at other corners and leave out others: ink moves by
           at most the accuracy, stretches up to `ink.LONGEST` change where rounding decides.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from properties import changes, models
from properties.assemblies import Piece, assemblies, assembly, examples, standing_apart, views
from properties.frozen import draw
from properties.identity import identities
from properties.ink import expect_same_ink

from support.visibility import adapter, scenes
from support.visibility.scenes import Scene

ACCURACY = 0.01
few = examples(20)
generators = st.integers(0, 10**6).map(np.random.default_rng)


@pytest.mark.slow
@few
@given(standing_apart(["box"]), generators)
def test_boxes_on_a_lattice_give_the_same_lines(several, rng):
    view = (0.613, -0.371, 0.719)
    model = changes.moved(assembly(several), 4 * np.eye(3))
    before, after = draw(model, view, ACCURACY), draw(changes.split(model, rng), view, ACCURACY)
    assert identities(after) == identities(before)
    step = 2.0**-28 * model.diagonal
    for one, other in zip(before.lines, after.lines, strict=True):
        assert np.abs(one.points - other.points).max() < step


@pytest.mark.slow
@few
@given(assemblies(), st.booleans(), views, generators)
def test_an_assembly(several, brep, view, rng):
    model = assembly(several, brep)
    expect_same_ink(*(draw(each, view, ACCURACY, intersections=False) for each in (model, changes.split(model, rng))))


def test_the_intersection_lines_of_two_boxes():
    """A box, and the same turned about its upright axis: four lines on the sides, whole however fine the triangles."""
    boxes = (Piece("box", (0, 0, 0), (1, 1, 1)), Piece("box", (0, 0, 0), (1, 1, 1), (0, 0, 1), 17))
    model = assembly(boxes, brep=False)
    expect_same_ink(*(draw(m, "front", ACCURACY) for m in (model, changes.split(model, np.random.default_rng(0)))))


def test_the_intersection_lines_of_two_tetrahedra_with_faces_in_one_plane():
    """One face of each crosses the other's from (6, 2, 7.5) to (6.5, 2, 6), however fine the triangles."""
    pair = (Piece("tetrahedron", (6, 0, 6), (1, 4, 3)), Piece("tetrahedron", (6, 2, 6), (1, 4, 3)))
    model = assembly(pair, brep=False)
    for seed in range(5):
        expect_same_ink(
            *(draw(m, (-2, 2, 0), ACCURACY) for m in (model, changes.split(model, np.random.default_rng(seed))))
        )


def test_intersection_lines_of_parts_that_cross_deeply():
    model = assembly((Piece("box", (0, 0, 0), (4, 4, 4)), Piece("cylinder", (2, 2, 2), (4, 4, 4), (1, 1, 0), 30)))
    expect_same_ink(*(draw(m, "iso", ACCURACY) for m in (model, changes.split(model, np.random.default_rng(0)))))


@pytest.mark.slow
@pytest.mark.parametrize("name", models.SOLIDS)
@pytest.mark.parametrize("view", ["front", "iso"])
def test_a_model(name, view):
    model, accuracy = models.model(name), models.accuracy(models.model(name))
    expect_same_ink(draw(model, view, accuracy), draw(changes.split(model, np.random.default_rng(1)), view, accuracy))


def halved(scene: Scene) -> tuple[Scene, dict[tuple[int, int], int]]:
    """Twice as large, every triangle in four; and of every edge the number of its middle."""
    points = [(2 * x, 2 * y, 2 * z) for x, y, z in scene.points]
    middle: dict[tuple[int, int], int] = {}
    for i, j in scene.edges():
        middle[i, j] = middle[j, i] = len(points)
        a, b = scene.points[i], scene.points[j]
        points.append((a[0] + b[0], a[1] + b[1], a[2] + b[2]))
    faces: list[tuple[int, int, int]] = []
    for i, j, k in scene.faces:
        ij, jk, ki = (middle.get(side, side[0]) for side in ((i, j), (j, k), (k, i)))
        faces += [(i, ij, ki), (ij, j, jk), (ki, jk, k), (ij, jk, ki)]
    wires = [(end, middle[i, j]) for i, j in scene.wires for end in (i, j)]
    parts = tuple(part for part in scene.parts for _ in range(4))
    return replace(scene, points=tuple(points), faces=tuple(faces), wires=tuple(sorted(wires)), parts=parts), middle


@examples(60)
@given(st.integers(0, 10**6), st.booleans())
def test_in_the_kernel(seed, parts):
    scene = scenes.scene(seed)
    if parts:
        scene = scene.apart()
    way = adapter.ONE if not parts else adapter.TRUSTED if scene.closed else adapter.PARTS
    fine, middle = halved(scene)
    whole, halves = adapter.visibility(scene, way).pieces, adapter.visibility(fine, way).pieces
    for (i, j), found in whole.items():
        m = middle[i, j]
        first = [(t0 / 2, t1 / 2, state) for t0, t1, state in halves[i, m]]
        last = [(1 - t1 / 2, 1 - t0 / 2, state) for t0, t1, state in halves[j, m][::-1]]
        if first[-1][2] == last[0][2]:
            first[-1:], last = [(first[-1][0], last[0][1], last[0][2])], last[1:]
        joined = first + last
        assert [state for *_, state in joined] == [state for *_, state in found]
        assert np.abs(np.array(joined) - found).max() <= 1e-15
