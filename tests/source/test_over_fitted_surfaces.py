"""Surfaces that a program fitted to points or to a border: they overshoot, and turn within a fraction of a face.

Two faces whose chord error once could not be proved, so that OpenCASCADE meshed them. Of the first, only triangles
beside two chords of its border were too coarse, and all chords of the border were divided. The other is a ripple that
was fitted to a net of points; beside its border it runs out into spikes fifty times as long, in which the points of a
mesh come to lie one after another.
"""

from __future__ import annotations

import numpy as np
import pytest

from hlr.source import open_source
from support.over_fitted import filled, ripple

ANGLE = 0.5
"""Radians."""


@pytest.mark.parametrize(("make", "deflection", "chords"), [(filled, 0.0025, 260), (ripple, 1.25, 1000)])
def test_they_are_meshed_with_few_chords(make, deflection, chords):
    meshed = open_source(make()).mesh(deflection, ANGLE)
    assert (meshed.rescued, meshed.lost) == (0, 0)
    (part,) = meshed.parts
    sides = np.sort(part.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    _, times = np.unique(sides, axis=0, return_counts=True)
    assert 50 < np.count_nonzero(times == 1) < chords
