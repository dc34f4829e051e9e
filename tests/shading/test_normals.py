"""Normals of meshes: smooth up to creases, and right where a needle or a flat triangle says nothing of its own."""

from __future__ import annotations

import numpy as np
import pytest

import hlr

SIDES, HEIGHT, RADIUS = 24, 60.0, 20.0


def tube(off: float | None, turn: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """An open tube. With `off`, each upright side has a third vertex near its top, so far inside of the side, which
    only the facets on its left have; the gap is filled by a triangle that has no area, or hardly any."""
    angle = turn + 2 * np.pi * np.arange(SIDES) / SIDES
    ring = np.stack([RADIUS * np.cos(angle), RADIUS * np.sin(angle), np.zeros(SIDES)], axis=1)
    inward = ring * [1 - (off or 0.0) / RADIUS, 1 - (off or 0.0) / RADIUS, 1]
    points = np.concatenate([ring, ring + (0, 0, HEIGHT), inward + (0, 0, HEIGHT * 7 / 8)])
    faces: list[tuple[int, int, int]] = []
    for i in range(SIDES):
        j = (i + 1) % SIDES
        p, q, r, s, t = i, SIDES + i, 2 * SIDES + i, j, SIDES + j
        faces += [(p, s, q), (s, t, q)] if off is None else [(p, s, r), (r, s, q), (p, r, q), (s, t, q)]
    return points, np.array(faces)


@pytest.mark.parametrize("off", [0.0, 1e-6, -1e-6])
def test_vertices_on_a_side_of_a_larger_facet_leave_no_wedges(off: float) -> None:
    points, faces = tube(off, 0.1)
    whole = hlr.preview(tube(None, 0.1), "front", size=(200, 200))
    with_needles = hlr.preview((points.astype(np.float32).astype(float), faces), "front", size=(200, 200))
    apart = np.abs(whole.pixels.astype(int) - with_needles.pixels.astype(int)).max(axis=2)
    # How a quad is split changes what is interpolated over it by a shade or two. A wedge is fifteen and more apart.
    assert np.percentile(apart, 99.5) <= 4
    assert (apart > 8).mean() < 0.001


def test_a_crease_that_ends_in_a_smooth_surface_fades() -> None:
    """A sheet folded at one end and flat at the other: no jump of light where it folds less than 30 degrees."""
    n = 8
    x, y = np.meshgrid(np.linspace(-1, 1, 2 * n + 1), np.linspace(0, 2, n + 1), indexing="ij")
    z = -np.abs(x) * np.maximum(0.0, 1.0 - y)
    points = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    at = np.arange(len(points)).reshape(x.shape)
    a, b, c, d = (at[i : i + 2 * n, j : j + n].ravel() for i, j in ((0, 0), (1, 0), (1, 1), (0, 1)))
    faces = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    pixels = hlr.preview((points, faces), "top", size=(260, 260)).pixels[..., :3].astype(int).sum(axis=2)
    ys, xs = np.nonzero(pixels < 765)
    box = pixels[ys.min() + 4 : ys.max() - 3, xs.min() + 4 : xs.max() - 3]
    jump = np.abs(np.diff(box, axis=1)).max(axis=1)
    assert jump[-20:].min() > 60  # a crease
    assert jump[: len(jump) // 2].max() < 12  # none
    # It ends within one facet, and not at once: from row to row the jump changes little.
    assert np.abs(np.diff(jump)).max() < 40
