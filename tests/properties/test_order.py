"""Parts, triangles, faces, edges and points may be listed in any order.

IDENTICAL  the bytes of SVG, PDF and JSON (but for the timings), counters among them:
           under any order of the triangles and of their corners, and of the edges of a B-rep; but intersection lines,
           though the same in every coordinate, may be listed in another order;
           under any order of faces and of parts, once they are numbered as before. What belongs to two parts has the
           lower numbered one as its owner, so the following are compared without owners, and else as exactly: lines
           where two parts intersect, and all lines where two parts have one in common in every coordinate. Equal
           parts in one place count as one while they are listed alike: there the counters may differ, and no line.
           In the kernel, on integers, under any order of the points: the same pieces, their ends within one unit in
           the last place of 1 (an edge is walked from its lower point, so a parameter t may become 1 - t).
MAY MOVE   under any order of the points lines begin elsewhere, and so leave out other vertices: ink moves by at most
           the accuracy, and stretches up to `ink.LONGEST` change where rounding decides.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import cadquery as cq
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from properties import changes, models
from properties.assemblies import Piece, assemblies, assembly, corners, drilled, examples, pieces, upright, views
from properties.frozen import draw, freeze
from properties.identity import everything, ownerless, renumbered, without
from properties.ink import expect_same_ink

from support.visibility import adapter, scenes
from support.visibility.scenes import Scene

ACCURACY = 0.01
few = examples(25)
kinds = st.booleans()
seeds = st.integers(0, 10**6)
generators = seeds.map(np.random.default_rng)
BLOCK = Piece("box", (0, 0, 0), (6, 6, 6))
holes = st.lists(pieces(st.sampled_from((0, 30, 45, 90))), min_size=1, max_size=3)


def expect_same_files(before, after):
    """All bytes, but for the place of intersection lines, and for notes, which name the first parts with defects.

    Equal parts in one place count as one while their triangles and faces are listed alike: that changes how much there
    is to do, and no line.
    """
    assert ownerless(after) == ownerless(before)
    if any(note.code == "parts-repeated" for note in before.notes):
        after = replace(after, counters=before.counters, plan=before.plan)
    assert after.counters == before.counters
    one, other = (replace(without(each, "intersection"), notes=()) for each in (before, after))
    assert everything(other) == everything(one)


def expect_any_order_of_triangles(model, view, accuracy, rng):
    before = draw(model, view, accuracy, smooth=True, seam=True)
    for shuffled in (changes.shuffled_triangles(model, rng), changes.shuffled_edges(model, rng)):
        expect_same_files(before, draw(shuffled, view, accuracy, smooth=True, seam=True))


def test_triangles_and_the_place_of_intersection_lines():
    model, rng = models.model(models.SOUP), np.random.default_rng(1)
    accuracy = models.accuracy(model)
    shuffled = changes.shuffled_triangles(model, rng)
    assert everything(draw(shuffled, "iso", accuracy)) == everything(draw(model, "iso", accuracy))


def test_triangles_of_a_box_drawn_from_both_sides():
    box = assembly([BLOCK], brep=False)
    part = box.parts[0]
    both = np.concatenate([part.triangles, part.triangles[:, ::-1]])
    doubled = replace(part, triangles=both, triangle_face=np.zeros(len(both), np.int32))
    expect_any_order_of_triangles(replace(box, parts=(doubled,)), "iso", ACCURACY, np.random.default_rng(1))


@pytest.mark.slow
@few
@given(assemblies(), kinds, views, generators)
def test_triangles_and_edges_of_an_assembly(several, brep, view, rng):
    expect_any_order_of_triangles(assembly(several, brep), view, ACCURACY, rng)


@pytest.mark.slow
@few
@given(holes, views, generators)
def test_triangles_of_a_drilled_block(several, view, rng):
    expect_any_order_of_triangles(drilled((BLOCK, *several)), view, ACCURACY, rng)


@pytest.mark.slow
@pytest.mark.parametrize("name", models.EVERY)
def test_triangles_and_edges_of_a_model(name):
    model = models.model(name)
    expect_any_order_of_triangles(model, "iso", models.accuracy(model), np.random.default_rng(1))


@pytest.mark.slow
def test_triangles_where_an_outline_goes_on_from_face_to_face():
    """Both faces at an edge find the place where the outline crosses it, each with its own rounding."""
    ring = cq.Workplane(obj=cq.Solid.makeTorus(20, 6)).union(cq.Workplane().sphere(15))
    model = freeze(ring, 200)
    expect_any_order_of_triangles(model, "iso", models.accuracy(model), np.random.default_rng(1))


def expect_any_order_of_faces(model, view, accuracy, rng):
    shuffled, old = changes.shuffled_faces(model, rng)
    before, after = draw(model, view, accuracy, smooth=True), draw(shuffled, view, accuracy, smooth=True)
    expect_same_files(before, renumbered(after, range(len(model.parts)), old))


@pytest.mark.slow
@few
@given(assemblies(), views, generators)
def test_faces_of_an_assembly(several, view, rng):
    expect_any_order_of_faces(assembly(several), view, ACCURACY, rng)


@pytest.mark.parametrize("name", models.SOLIDS)
def test_faces_of_a_model(name):
    model = models.model(name)
    expect_any_order_of_faces(model, "iso", models.accuracy(model), np.random.default_rng(1))


def expect_any_order_of_parts(model, view, accuracy, order, owners=True):
    before, after = (
        draw(model, view, accuracy, smooth=True),
        draw(changes.reordered(model, order), view, accuracy, smooth=True),
    )
    if owners:
        expect_same_files(before, renumbered(after, order))
    assert ownerless(after) == ownerless(before)
    assert after.counters == before.counters


def share_a_line(several) -> bool:
    """Whether two pieces have two corners in common."""
    points = [set(map(tuple, corners(piece).tolist())) for piece in several]
    return any(len(one & other) > 1 for one, other in combinations(points, 2))


@pytest.mark.slow
@few
@given(assemblies(), kinds, views, st.randoms(use_true_random=False))
def test_parts_of_an_assembly(several, brep, view, random):
    order = random.sample(range(len(several)), len(several))
    expect_any_order_of_parts(assembly(several, brep), view, ACCURACY, order, owners=not share_a_line(several))


@pytest.mark.slow
@few
@given(assemblies(upright), kinds, views, st.randoms(use_true_random=False))
def test_parts_that_have_lines_in_common(several, brep, view, random):
    twins = (*several, several[0])
    assume(share_a_line(twins))
    order = random.sample(range(len(twins)), len(twins))
    expect_any_order_of_parts(assembly(twins, brep), view, ACCURACY, order, owners=False)


@pytest.mark.slow
@pytest.mark.parametrize("name", [models.ASSEMBLY, models.GEARS])
@pytest.mark.parametrize("view", ["front", "iso"])
def test_parts_of_a_model(name, view):
    model = models.model(name)
    order = np.random.default_rng(1).permutation(len(model.parts)).tolist()
    expect_any_order_of_parts(model, view, models.accuracy(model), order)


def expect_any_order_of_points(model, view, accuracy, rng):
    expect_same_ink(draw(model, view, accuracy), draw(changes.shuffled_points(model, rng), view, accuracy))


@pytest.mark.slow
@few
@given(assemblies(), kinds, views, generators)
def test_points_of_an_assembly(several, brep, view, rng):
    expect_any_order_of_points(assembly(several, brep), view, ACCURACY, rng)


@pytest.mark.slow
@pytest.mark.parametrize("name", models.SOLIDS)
def test_points_of_a_model(name):
    model = models.model(name)
    expect_any_order_of_points(model, "iso", models.accuracy(model), np.random.default_rng(1))


@examples(60)
@given(seeds, st.booleans(), generators)
def test_points_in_the_kernel(seed, parts, rng):
    scene = scenes.scene(seed)
    if parts:
        scene = scene.apart()
    old = rng.permutation(len(scene.points)).tolist()
    new = np.argsort(old).tolist()
    faces = tuple((new[i], new[j], new[k]) for i, j, k in scene.faces)
    wires = tuple(sorted((min(new[i], new[j]), max(new[i], new[j])) for i, j in scene.wires))
    other = Scene(tuple(scene.points[i] for i in old), faces, wires, scene.parts, scene.closed)
    # The parts are kept apart already.
    way = adapter.PARTS if parts else adapter.ONE
    before, after = adapter.visibility(scene, way).pieces, adapter.visibility(other, way).pieces
    assert len(before) == len(after)
    for (i, j), found in before.items():
        a, b = new[i], new[j]
        same = after[a, b] if a < b else [(1.0 - t1, 1.0 - t0, state) for t0, t1, state in after[b, a][::-1]]
        assert [state for *_, state in same] == [state for *_, state in found]
        assert np.abs(np.array(same) - found).max() <= 2.0**-52


@examples(60)
@given(seeds, st.randoms(use_true_random=False))
def test_parts_in_the_kernel(seed, random):
    scene = scenes.scene(seed).apart()
    way = adapter.TRUSTED if scene.closed else adapter.PARTS
    count = max(scene.parts, default=-1) + 1
    new = random.sample(range(count), count)
    other = Scene(scene.points, scene.faces, scene.wires, tuple(new[part] for part in scene.parts), scene.closed)
    assert adapter.visibility(other, way) == adapter.visibility(scene, way)
