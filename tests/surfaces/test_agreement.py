"""All methods and all their variants give the exact oracle's picture: 200 random scenes of each kind."""

import numpy as np
import pytest
from surfaces.oracle import seen
from surfaces.random_scenes import KINDS, SIZE

from hlr.lab.methods import METHODS, SCREEN, render

COUNT = 80

# Those that assume that no polygon passes through another are tried where that is so.
COHERENT = [("scan line", "naive"), ("scan line", "leaving"), ("scan line", "visible")]
EVERYWHERE = [
    (method, variant)
    for method, variants in METHODS.items()
    for variant in (variants or (None,))
    if (method, variant) not in COHERENT
]


@pytest.mark.slow
@pytest.mark.parametrize("rule", ["even-odd", "non-zero"])
@pytest.mark.parametrize("kind", KINDS)
def test_random_scenes(kind, rule):
    for seed in range(COUNT // 2) if rule == "even-odd" else range(COUNT // 2, COUNT):
        polygons = KINDS[kind](seed)
        ids, depths = seen(polygons, SIZE, rule)
        for method, variant in EVERYWHERE + (COHERENT if kind == "disjoint" else []):
            found = render(polygons, SCREEN, SIZE, method, variant=variant, rule=rule)
            told = f"{kind} {seed}, {rule}: {method}, {variant}"
            assert (found.ids == ids).all(), told
            sign = -1.0 if variant == "larger" else 1.0
            np.testing.assert_allclose(sign * found.depth, depths, rtol=1e-14, atol=1e-12, err_msg=told)


def side_by_side(seed):
    """Two polygons on either side of a wall seen edge-on, at whose foot they end; corners between the grid's steps."""
    rng = np.random.default_rng(seed)
    wide, high = 48, 36
    start, way = rng.uniform((0.4 * wide, 0), (0.6 * wide, 1)), rng.uniform((-0.3, 1.0), (0.3, 1.0))

    def foot(share):
        return start + way * share * high

    def tilted(corners):
        a, b, c = rng.uniform((-9, -9, 0), (9, 9, 50))
        return [(x, y, a * x + b * y + c) for x, y in corners]

    left = tilted([foot(rng.uniform(0, 0.4)), foot(rng.uniform(0.6, 1)), (0, high), (0, 0)])
    right = tilted([foot(rng.uniform(0, 0.4)), (wide, 0), (wide, high), foot(rng.uniform(0.6, 1))])
    (x, y), (u, v) = foot(-1), foot(2)
    wall = [(x, y, -200), (u, v, -200), (u, v, 300), (x, y, 300)]
    return [wall, left, right]


@pytest.mark.slow
def test_rounding_lays_neighbours_over_one_another():
    for seed in range(1500):
        polygons = side_by_side(seed)
        expected = render(polygons, SCREEN, (48, 36), "z-buffer").ids
        assert (render(polygons, SCREEN, (48, 36), "bsp").ids == expected).all(), seed
