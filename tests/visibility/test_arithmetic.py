"""The kinds of arithmetic: alike on easy scenes, and what rounding loses on known ones."""

from __future__ import annotations

import pytest

from support.visibility import adapter, scenes
from support.visibility.adapter import HIDDEN, ONE, VISIBLE
from support.visibility.scenes import Scene

ROUNDED = ("f64", "f32")


def behind(size: int, at: int, deep: float = 4.0) -> Scene:
    """A triangle of `size` units at (at, at), a line behind its middle, and two far points that make the grid."""
    far = 1 << 29
    middle = at + size // 4
    points = [(at, at, 0), (at + size, at, 0), (at, at + size, 0)]
    points += [(middle, middle, deep), (middle + size // 8, middle, deep), (-far, -far, -8), (far, far, 8)]
    return Scene(tuple(points), ((0, 1, 2),), wires=((3, 4), (5, 6)))


@pytest.mark.parametrize("arithmetic", ROUNDED)
def test_an_easy_scene_is_alike(arithmetic: str) -> None:
    scene = behind(1 << 20, 1 << 24)
    exact = adapter.visibility(scene, ONE)
    assert exact.pieces[3, 4] == [(0.0, 1.0, HIDDEN)]
    assert adapter.visibility(scene, ONE, arithmetic=arithmetic).pieces == exact.pieces


def test_doubles_agree_with_integers_on_small_grids() -> None:
    """Where no product is rounded, nothing can differ."""
    decided = {VISIBLE: 0, HIDDEN: 0}
    for seed in range(200):
        scene = scenes.scene(seed)
        exact, double = (adapter.visibility(scene, ONE, arithmetic=kind) for kind in ("exact", "f64"))
        states = [{edge: [state for *_, state in p] for edge, p in found.pieces.items()} for found in (exact, double)]
        assert states[0] == states[1], seed
        assert double.counters["failed_checks"] == 0, seed
        for pieces in states[0].values():
            for state in pieces:
                decided[state] = decided.get(state, 0) + 1
    assert min(decided[VISIBLE], decided[HIDDEN]) > 500


def test_single_precision_loses_a_small_triangle_far_from_the_origin() -> None:
    """At 2^28 single precision knows every 16th unit only: a triangle of 8 has no area there, and hides nothing."""
    scene = behind(8, (1 << 28) + 4)
    assert adapter.visibility(scene, ONE).pieces[3, 4] == [(0.0, 1.0, HIDDEN)]
    assert adapter.visibility(scene, ONE, arithmetic="f64").pieces[3, 4] == [(0.0, 1.0, HIDDEN)]
    lost = adapter.visibility(scene, ONE, arithmetic="f32").pieces.get((3, 4))
    assert lost is None or lost == [(0.0, 1.0, VISIBLE)]


@pytest.mark.parametrize("arithmetic", ROUNDED)
def test_coincidences_neither_panic_nor_hang(arithmetic: str) -> None:
    for seed in range(400):
        found = adapter.visibility(scenes.scene(seed), adapter.Way(parts=True, bias=seed % 3), arithmetic=arithmetic)
        assert found.counters["contradictions"] <= found.counters["failed_checks"]


def test_an_unknown_kind_is_refused() -> None:
    with pytest.raises(ValueError, match="exact, f64 or f32"):
        adapter.visibility(behind(1024, 0), ONE, arithmetic="f16")
