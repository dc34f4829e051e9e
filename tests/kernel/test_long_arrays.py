"""Long arrays are checked on all threads: what is out of range is found wherever it stands."""

from __future__ import annotations

import numpy as np
import pytest

from hlr import _kernel
from hlr.common.threads import at_most

TRIANGLES = 400_000
"""Their corners are more numbers than one thread checks alone."""


def mesh(triangles: np.ndarray) -> _kernel.Mesh:
    return _kernel.Mesh(
        np.zeros((3, 3)), triangles, np.zeros((0, 2), np.int32), np.zeros(1, np.int32), np.zeros(0, np.int32)
    )


@pytest.mark.parametrize("threads", [1, 2, 5])
@pytest.mark.parametrize("place", [0, 3 * TRIANGLES // 2, 3 * TRIANGLES - 1])
@pytest.mark.parametrize("wrong", [3, -1, 2**31 - 1, -(2**31)])
def test_one_number_out_of_range(threads, place, wrong):
    triangles = np.tile(np.array([0, 1, 2], np.int32), (TRIANGLES, 1))
    with at_most(threads):
        mesh(triangles)
        triangles.reshape(-1)[place] = wrong
        with pytest.raises(ValueError, match=f"triangles holds {wrong}, allowed are 0..3"):
            mesh(triangles)
