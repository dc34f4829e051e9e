"""Creases of meshes near the crease angle: lines that neither come and go, nor begin and end in smooth surfaces."""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.meshes import rotation


def prism(sides: int) -> tuple[np.ndarray, np.ndarray]:
    """A prism, turned, in single precision; each of its upright edges is three long."""
    angle = 2 * np.pi * np.arange(sides) / sides
    ring = np.stack([20 * np.cos(angle), 20 * np.sin(angle)], axis=1)
    points = np.concatenate([np.column_stack([ring, np.full(sides, z)]) for z in (0, 20, 40, 60)])
    points = np.concatenate([points, [(0, 0, 0), (0, 0, 60)]]) @ rotation((1, 2, 3), 0.7).T
    faces = []
    for i in range(sides):
        j = (i + 1) % sides
        for k in range(3):
            p, s, q, t = k * sides + i, k * sides + j, (k + 1) * sides + i, (k + 1) * sides + j
            faces += [(p, s, q), (s, t, q)]
        faces += [(4 * sides, j, i), (4 * sides + 1, 3 * sides + i, 3 * sides + j)]
    return points.astype(np.float32).astype(float), np.array(faces)


def ridge(folds: list[float], y: list[float] | None = None, facets: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """A sheet with a ridge along the middle, that folds by so many degrees at each of its places; y: where they are.

    The outer strips level out gently. facets: they fall away instead, by more than half the fold of the ridge, as the
    facets of a round face do.
    """
    x = np.array([-40.0, -20.0, 0.0, 20.0, 40.0])
    y = 10.0 * np.arange(len(folds)) if y is None else np.array(y)
    slope = np.tan(np.radians(np.array(folds) / 2))
    outer = 3.4 if facets else 1.4
    z = np.stack([-outer * 20 * slope, -20 * slope, 0 * slope, -20 * slope, -outer * 20 * slope], axis=0)
    points = np.stack([np.repeat(x, len(y)), np.tile(y, 5), z.ravel()], axis=1)
    at = np.arange(len(points)).reshape(5, len(y))
    a, b, c, d = at[:-1, :-1].ravel(), at[1:, :-1].ravel(), at[1:, 1:].ravel(), at[:-1, 1:].ravel()
    return points, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


def sharp(source: object, within: float = np.inf, **options: object) -> float:
    """Millimetres of creases; within: of those at most so far from x = 0."""
    drawing = hlr.draw(source, "iso", **AT_SIZE | options)
    lines = [
        line.points3 for line in drawing.lines if line.kind == "sharp" and (abs(line.points3[:, 0]) <= within).all()
    ]
    return sum(float(np.sqrt((np.diff(line, axis=0) ** 2).sum(axis=1)).sum()) for line in lines)


def rims(sides: int) -> float:
    return 2 * sides * 2 * 20 * np.sin(np.pi / sides)


@pytest.mark.parametrize("sides", [6, 8, 12])
def test_a_nut_keeps_all_its_edges(sides: int) -> None:
    assert sharp(prism(sides)) == pytest.approx(rims(sides) + sides * 60, rel=1e-3)


@pytest.mark.parametrize("sides", [13, 14, 15, 16])
def test_near_the_limit_a_cylinder_is_still_smooth(sides: int) -> None:
    assert sharp(prism(sides)) == pytest.approx(rims(sides), rel=1e-3)


def test_a_crease_near_the_limit_goes_on() -> None:
    waver = [60, 60, 45, 31, 28, 31, 28, 27, 32, 28, 31, 29, 45, 60, 60]
    assert sharp(ridge(waver)) == pytest.approx(10.0 * (len(waver) - 1), rel=0.01)


def test_what_is_hardly_a_crease_and_ends_in_smooth_surfaces_is_none() -> None:
    assert sharp(ridge([0, 0, 10, 28, 33, 36, 35, 36, 33, 35, 28, 10, 0, 0])) == 0.0


def test_a_faint_crease_is_drawn_where_it_is_long() -> None:
    assert sharp(ridge([0, 0, 10, 28, *[35] * 13, 28, 10, 0, 0])) >= 120.0
    assert sharp(ridge([0, 0, 10, 28, *[35] * 9, 28, 10, 0, 0])) == 0.0


def test_a_faint_crease_of_one_long_edge_is_drawn() -> None:
    """Parts that are meshed coarsely have such edges, and scans have not."""
    folds = [0, 12, 24, 35, 35, 24, 12, 0]
    assert sharp(ridge(folds, [0, 20, 40, 60, 160, 180, 200, 220])) == pytest.approx(100.0, rel=0.01)
    assert sharp(ridge(folds, [0, 30, 60, 90, 120, 150, 180, 210])) == 0.0
    # Below the crease angle a long edge is smooth all the same.
    assert sharp(ridge([0, 9, 18, 27, 27, 18, 9, 0], [0, 20, 40, 60, 160, 180, 200, 220])) == 0.0


def test_what_is_clearly_a_crease_may_end_there() -> None:
    assert sharp(ridge([0, 0, 10, 28, 33, 50, 55, 50, 33, 35, 28, 10, 0, 0])) > 60.0


RISE = [0, 15, 33, 45, 60, 60, 45, 33]
"""Folds of a ridge that begins in a smooth surface;"""


def test_a_crease_that_fades_into_facets_ends_there() -> None:
    # Beyond the clear part the fold stays near the limit for a while: no other crease begins there.
    short, long = ([*RISE, *[28] * n, 15, 0] for n in (1, 6))
    assert sharp(ridge(long, facets=True), 1.0) == pytest.approx(sharp(ridge(short, facets=True), 1.0), rel=0.01)


def test_a_crease_that_fades_goes_on_while_it_stands_out() -> None:
    short, long = ([*RISE, *[28] * n, 15, 0] for n in (1, 6))
    assert sharp(ridge(long)) - sharp(ridge(short)) > 3 * 10.0


@pytest.mark.parametrize(("gap", "closed"), [(3, True), (12, False)])
def test_a_gap_longer_than_its_creases_stays_open(gap: int, closed: bool) -> None:
    whole, half = [*RISE, *[28] * gap, *RISE[::-1]], [*RISE, 28, 15, 0]
    drawn, creases = sharp(ridge(whole, facets=True), 1.0), 2 * sharp(ridge(half, facets=True), 1.0)
    assert drawn == pytest.approx(creases + 10.0 * (gap - 1) * closed, rel=0.1)
