"""A finer triangulation of the same faces gives the same drawing.

IDENTICAL  of B-rep parts on a lattice of multiples of four, where dividing sides rounds nothing: the number, class,
           visibility and owner of lines; their ends within 1e-9, for a quotient is taken along a part of the edge.
           In the kernel, on integers: the same pieces, put together; their ends within 1e-15 of the edge.
MAY MOVE   elsewhere the new corners are rounded, lines may begin at other corners and leave out others: ink moves by
           at most the accuracy, stretches up to `ink.LONGEST` change where rounding decides.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from properties import changes, models
from properties.assemblies import assemblies, assembly, upright, views
from properties.frozen import draw
from properties.identity import identities
from properties.ink import expect_same_ink
from visibility import adapter, scenes
from visibility.scenes import Scene

ACCURACY = 0.01
few = settings(max_examples=20)
generators = st.integers(0, 10**6).map(np.random.default_rng)
FLAT = ("box", "wedge", "tetrahedron")


@few
@given(assemblies(upright), st.sampled_from(["front", "left", "top", "iso"]), generators)
def test_flat_solids_on_a_lattice_give_the_same_lines(several, view, rng):
    flat = [piece for piece in several if piece.kind in FLAT]
    if not flat:
        return
    model = changes.moved(assembly(flat), 4 * np.eye(3))
    before, after = draw(model, view, ACCURACY), draw(changes.split(model, rng), view, ACCURACY)
    assert identities(after) == identities(before)
    for one, other in zip(before.lines, after.lines, strict=True):
        assert np.abs(one.points - other.points).max() < 1e-9


@few
@given(assemblies(), st.booleans(), views, generators)
def test_an_assembly(several, brep, view, rng):
    model = assembly(several, brep)
    expect_same_ink(draw(model, view, ACCURACY), draw(changes.split(model, rng), view, ACCURACY))


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


@settings(max_examples=60)
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
