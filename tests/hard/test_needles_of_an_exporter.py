"""Needles along the edges of a prism, as low as its coordinates are exact: their normals are noise, and no edges.

An exporter splits the faces on one side of an edge and fills the gap with a triangle whose third corner lies on the
edge but for the rounding of its single-precision numbers. A shaft of 36 sides has two rims and no other creases; a box
has its twelve edges.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from hlr import _kernel
from hlr.scene import build
from hlr.source.precision import coordinate_precision
from support.at_size import ALL_LINES
from support.needles import HEIGHT, RADIUS, prism


@pytest.fixture(params=["turned out", "left"], autouse=True)
def needles(request, monkeypatch):
    """Needles that can be turned out of a mesh are; what is said of the others must hold for these as well."""
    if request.param == "left":
        monkeypatch.setattr(_kernel, "without_needles", lambda *_: None)
    return request.param


def creases(drawing):
    return [line for line in drawing.lines if line.kind == "sharp"]


def length(lines):
    return sum(float(np.sqrt((np.diff(line.points3, axis=0) ** 2).sum(axis=1)).sum()) for line in lines)


@pytest.mark.parametrize("size", [0.01, 1.0, 1000.0])
@pytest.mark.parametrize("off", [0.5, 3.0, 12.0])
def test_a_shaft_has_its_two_rims(size, off):
    drawing = hlr.draw(prism(36, size, off=off), "iso", fit=(150, 150), **ALL_LINES)
    rim = 36 * 2 * RADIUS * np.sin(np.pi / 36)
    assert length(creases(drawing)) <= 2 * rim * size * 1.001


@pytest.mark.parametrize("sides", [4, 36])
def test_triangles_turned_over_have_the_same_folds(sides):
    points, triangles = prism(sides)
    turned = triangles.copy()
    turned[::5] = turned[::5, ::-1]
    one, other = (
        length(creases(hlr.draw((points, t), "iso", fit=(150, 150), **ALL_LINES))) for t in (triangles, turned)
    )
    # Every upright edge has a needle, and a line too many or too few there is as long as the prism is high.
    assert abs(other - one) < HEIGHT / 4


@pytest.mark.parametrize("size", [0.01, 1.0, 1000.0])
@pytest.mark.parametrize("off", [0.0, 0.5, 3.0, 12.0])
def test_a_box_keeps_its_twelve_edges(size, off):
    drawing = hlr.draw(prism(4, size, off=off), "iso", fit=(150, 150), accuracy=0.05, **ALL_LINES)
    whole = 8 * RADIUS * np.sqrt(2.0) + 4 * HEIGHT
    assert length(creases(drawing)) == pytest.approx(whole * size, rel=2e-3)


def test_without_the_look_at_heights_there_are_stray_lines(monkeypatch, needles):
    monkeypatch.setattr(build, "reliable_normals", lambda mesh, *_: mesh)
    rim = 36 * 2 * RADIUS * np.sin(np.pi / 36)
    found = length(creases(hlr.draw(prism(36), "iso", fit=(150, 150), **ALL_LINES)))
    assert found > 2.5 * rim if needles == "left" else found <= 2.001 * rim


def test_precision_of_coordinates():
    rng = np.random.default_rng(3)
    points = rng.uniform(-50, 50, (40, 3))
    points[0, 0] = 64.0
    single = 2.0**-24 * 64.0
    assert coordinate_precision(points.astype(np.float32).astype(float)) == single
    assert coordinate_precision(np.round(points, 4)) == 0.5e-4
    assert coordinate_precision(np.round(points, 7)) == single
    written = np.array([[float(f"{c:.7e}") for c in row] for row in points])
    assert coordinate_precision(written) == single
    # Nine digits tell a single number, nine decimals are still rounded ones; what has more is exact.
    for digits, expected in [(9, single), (10, 2.0**-53 * 64.0)]:
        written = np.array([[float(f"{c:.{digits - 1}e}") for c in row] for row in points])
        assert coordinate_precision(written) == expected
    # Small numbers have more decimals, and no more digits.
    small = points * 10.0 ** rng.uniform(-6, 0, points.shape)
    written = np.array([[float(f"{c:.8e}") for c in row] for row in small])
    assert coordinate_precision(written) == 2.0**-24 * np.abs(written).max()
    assert coordinate_precision(np.round(points * 1e-4, 9)) == 0.5e-9
    assert coordinate_precision(np.round(points, 10)) < 1e-13
    assert coordinate_precision(points) < 1e-13
    assert coordinate_precision(np.zeros((0, 3))) == 0.0


def test_differences_that_overflow_tell_no_step() -> None:
    assert coordinate_precision(np.array([[0, 0, 1e300], [0, 0, 0], [0, 0, -1.79769312e308]])) == 0.0
