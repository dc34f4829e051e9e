"""Two fine meshes of one surface, as scans are, whose corners are off by less than the accuracy.

Their facets are so small that noise tilts them by any angle. The plane of such a facet runs right through the other
surface. Measured from this plane that one went as deep as one liked, and lines were drawn all over the two.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.meshes import as_parts, grid, moved, sphere


def waves(count):
    x, y = np.meshgrid(*2 * [np.linspace(-20, 20, count)], indexing="ij")
    return grid(np.stack([x, y, 0.3 * np.sin(0.5 * x) * np.cos(0.5 * y)], axis=-1))


def meetings(*meshes, accuracy):
    drawing = hlr.draw(as_parts(*meshes), "iso", accuracy=accuracy, **AT_SIZE)
    lines = [line.points3 for line in drawing.lines if line.kind == "intersection"]
    return sum(np.linalg.norm(np.diff(points, axis=0), axis=1).sum() for points in lines)


def scans(mesh, off):
    chance = np.random.default_rng(5)
    return [moved(mesh, lambda p: p + chance.uniform(-off, off, p.shape)) for _ in range(2)]


@pytest.mark.parametrize(("count", "accuracy"), [(40, 0.3), (100, 0.1), (100, 0.3)])
@pytest.mark.parametrize("shape", [lambda n: sphere(10.0, n, n // 2), waves], ids=["balls", "sheets"])
def test_they_have_no_line_in_common(shape, count, accuracy):
    assert meetings(*scans(shape(count), 0.5 * accuracy), accuracy=accuracy) == 0.0
