"""All methods, and all their variants, give the picture of the exact oracle: on 200 random scenes of each kind."""

import numpy as np
import pytest
from surfaces.oracle import seen
from surfaces.random_scenes import KINDS, SIZE

from hlr.surfaces import METHODS, SCREEN, render

COUNT = 200

# Those that assume that no polygon passes through another are tried where that is so.
COHERENT = [("scan line", "naive"), ("scan line", "leaving"), ("scan line", "visible")]
EVERYWHERE = [
    (method, variant)
    for method, variants in METHODS.items()
    for variant in (variants or (None,))
    if (method, variant) not in COHERENT
]


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
