"""The kernel against the oracle on scenes full of coincidences."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from visibility import compare

from support.visibility import adapter, oracle, scenes
from support.visibility.scenes import Scene

SEEDS_PER_KIND = 40
WAYS = {
    "one part": adapter.ONE,
    "parts": adapter.PARTS,
    "parts, contact tolerance 1": adapter.Way(parts=True, bias=1),
    "parts, contact tolerance 2": adapter.Way(parts=True, bias=2),
}


@pytest.mark.slow
@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("kind", range(len(scenes.KINDS)), ids=[kind.__name__ for kind in scenes.KINDS])
def test_random_scenes(kind: int, way: str) -> None:
    first = kind + 1000 * len(scenes.KINDS) * list(WAYS).index(way)
    for seed in range(first, first + SEEDS_PER_KIND * len(scenes.KINDS), len(scenes.KINDS)):
        expect_agreement(scenes.scene(seed), WAYS[way])


@pytest.mark.slow
@pytest.mark.parametrize("bias", [0, 1])
def test_trusted_parts(bias: int) -> None:
    """Culling what is turned away, and no search for piercings inside a part, change nothing where they are allowed."""
    closed = [scene for scene in map(scenes.scene, range(8 * 60)) if scene.closed]
    assert len(closed) >= 40
    for scene in closed:
        expect_agreement(scene, replace(adapter.TRUSTED, bias=bias))


def expect_agreement(scene: Scene, way: adapter.Way) -> None:
    problem = compare.difference(scene, way)
    if problem:
        small = compare.shrink(scene, lambda smaller: compare.difference(smaller, way) is not None)
        pytest.fail(f"{problem}\nmade small: {compare.difference(small, way)}\n{small!r}\n{way}")


coordinate = st.integers(0, 3)
point = st.tuples(coordinate, coordinate, coordinate)


@st.composite
def soups(draw: st.DrawFn) -> Scene:
    """Any triangles and lines whatever over a few shared points."""
    points = draw(st.lists(point, min_size=3, max_size=8))
    index = st.integers(0, len(points) - 1)
    faces = draw(st.lists(st.tuples(index, index, index), max_size=6))
    wires = {(min(i, j), max(i, j)) for i, j in draw(st.lists(st.tuples(index, index), max_size=3)) if i != j}
    return Scene(tuple(points), tuple(faces), tuple(sorted(wires)))


@pytest.mark.slow
@settings(max_examples=300, deadline=None)
@given(soups())
def test_any_soup(scene: Scene) -> None:
    assert compare.difference(scene, adapter.ONE) is None


@settings(max_examples=50, deadline=None)
@given(soups(), st.integers(1, 10**6), st.tuples(*[st.integers(-(10**6), 10**6)] * 3))
def test_size_and_place_do_not_matter(scene: Scene, factor: int, offset: tuple[int, int, int]) -> None:
    """Exactness is relative to the scene's own extent: integers up to 2^22 or so are still kept as they are."""
    moved = [tuple(factor * c + o for c, o in zip(p, offset, strict=True)) for p in scene.points]
    there = adapter.visibility(Scene(tuple(moved), scene.faces, scene.wires), adapter.ONE)  # type: ignore[arg-type]
    assert there.pieces == adapter.visibility(scene, adapter.ONE).pieces


@settings(max_examples=60, deadline=None)
@given(soups(), st.randoms(use_true_random=False))
def test_order_of_triangles_does_not_matter(scene: Scene, rng: np.random.Generator) -> None:
    faces = [tuple(face[(i + turn) % 3] for i in range(3)) for face, turn in zip(scene.faces, range(9), strict=False)]
    rng.shuffle(faces)  # type: ignore[arg-type]
    shuffled = Scene(scene.points, tuple(faces), scene.wires)  # type: ignore[arg-type]
    assert adapter.visibility(shuffled, adapter.ONE).pieces == adapter.visibility(scene, adapter.ONE).pieces


def merged(copies: int) -> Scene:
    """Many random scenes side by side and over one another: enough for several bands and threads."""
    points: list[tuple[int, int, int]] = []
    faces: list[tuple[int, int, int]] = []
    wires: list[tuple[int, int]] = []
    for seed in range(copies):
        scene = scenes.scene(seed)
        base = len(points)
        shift = (7 * (seed % 12), 5 * (seed // 12), seed % 5)
        points += [(p[0] + shift[0], p[1] + shift[1], p[2] + shift[2]) for p in scene.points]
        faces += [(i + base, j + base, k + base) for i, j, k in scene.faces]
        wires += [(i + base, j + base) for i, j in scene.wires]
    return Scene(tuple(points), tuple(faces), tuple(wires))


@pytest.mark.slow
def test_a_large_scene_and_any_number_of_threads() -> None:
    scene = merged(60)
    assert len(scene.edges()) > 1000
    expect_agreement(scene, adapter.ONE)
    one = adapter.visibility(scene, adapter.ONE, threads=1)
    for threads in (2, 3, 5):
        assert adapter.visibility(scene, adapter.ONE, threads=threads) == one


def test_edge_table() -> None:
    for seed in range(64):
        scene = scenes.scene(seed)
        edges, offsets, incident = adapter.edge_table(scene)
        listed = [tuple(edge) for edge in edges.tolist()]
        assert listed == sorted(set(listed)) and all(lo < hi for lo, hi in listed)
        assert len(offsets) == len(edges) + 1 and offsets[0] == 0 and offsets[-1] == len(incident)
        assert set(listed) == set(Scene(scene.points, scene.faces).edges())
        for number, (lo, hi) in enumerate(listed):
            around = incident[offsets[number] : offsets[number + 1]].tolist()
            assert sorted(set(around)) == [t for t, face in enumerate(scene.faces) if {lo, hi} <= set(face)]


def test_a_wrong_answer_would_be_noticed() -> None:
    """The comparison can fail: hold the kernel's answer for one scene against another's."""
    behind = Scene(((0, 0, 0), (4, 0, 0), (0, 4, 0), (1, 1, 1), (2, 1, 1)), ((0, 1, 2),), ((3, 4),))
    before = Scene((*behind.points[:3], (1, 1, -1), (2, 1, -1)), behind.faces, behind.wires)
    assert adapter.visibility(behind, adapter.ONE).pieces[3, 4] == [(0.0, 1.0, adapter.HIDDEN)]
    assert adapter.visibility(before, adapter.ONE).pieces[3, 4] == [(0.0, 1.0, adapter.VISIBLE)]
    assert not compare.agree([(0.0, 1.0, adapter.HIDDEN)], [(oracle.ZERO, oracle.ONE, adapter.VISIBLE)])


def test_shrinking_leaves_what_matters() -> None:
    scene = merged(6)
    small = compare.shrink(scene, lambda s: sum(len(set(f)) == 3 and s.points[f[0]][2] > 2 for f in s.faces) >= 2)
    assert len(small.faces) == 2 and not small.wires
