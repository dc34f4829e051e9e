"""Boxes on a coarse lattice, touching, overlapping and flush in every way, against rays through them."""

from itertools import pairwise

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.measures import distances, drawn_twice, segments
from support.models import box, parts, solids

RING = 0.02
"""Radius of the ring of rays around a sample; a line is judged only where all nine agree."""
VIEWS = ["front", "top", "iso", (3.0, -2.0, 1.5), (-1.0, 2.0, 4.0)]


def crowd(seed):
    """(n, 2, 3) lower and upper corners, n different boxes."""
    rng = np.random.default_rng(seed)
    low = rng.integers(0, 5, (int(rng.integers(2, 6)), 3)) * 10.0
    return np.unique(np.stack([low, low + rng.integers(1, 4, low.shape) * 10.0], axis=1), axis=0)


def blocked(points, toward, boxes):
    """(m,) whether a ray runs through the inside of a box for more than a hair."""
    out = np.zeros(len(points), bool)
    with np.errstate(divide="ignore", invalid="ignore"):
        for low, high in boxes:
            a, b = (low - points) / toward, (high - points) / toward
            inside = (points > low + 1e-6) & (points < high - 1e-6)
            level = np.abs(toward) < 1e-12
            near = np.where(level, np.where(inside, -np.inf, np.inf), np.minimum(a, b)).max(axis=1)
            far = np.where(level, np.where(inside, np.inf, -np.inf), np.maximum(a, b)).min(axis=1)
            out |= far - np.maximum(near, 0.0) > 1e-3
    return out


def rays(points, view, boxes):
    """(m,) how many of nine rays around each point are blocked."""
    right, up, toward = (np.asarray(v) for v in (view.right, view.up, view.direction))
    count = blocked(points, toward, boxes).astype(int)
    for k in range(8):
        angle = np.pi * (k + 0.37) / 4
        count += blocked(points + RING * (np.cos(angle) * right + np.sin(angle) * up), toward, boxes)
    return count


def along(a, b):
    """Points of an edge that no lattice line passes close by."""
    return a + (b - a) * np.linspace(0.013, 0.987, 11)[:, None]


def edges_of(boxes):
    for low, high in boxes:
        size = high - low
        for k in range(3):
            u, v = np.eye(3)[(k + 1) % 3] * size, np.eye(3)[(k + 2) % 3] * size
            for corner in (low, low + u, low + v, low + u + v):
                yield corner, corner + np.eye(3)[k] * size


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["brep", "mesh"])
@pytest.mark.parametrize("seed", range(6))
def test_boxes_on_a_lattice(kind, seed):
    boxes = crowd(seed)
    sizes = [(tuple(high - low), tuple((low + high) / 2)) for low, high in boxes]
    model = solids(*sizes) if kind == "brep" else parts(*(box(*s) for s in sizes))
    for drawing in hlr.draw_views(model, VIEWS, hlr.Options(accuracy=0.004, **AT_SIZE)):
        view = drawing.view
        for visible, wrong in ((True, 9), (False, 0)):
            chosen = [line.points3 for line in drawing.lines if line.visible == visible]
            points = [along(a, b) for line in chosen for a, b in pairwise(line)]
            count = rays(np.concatenate([np.zeros((0, 3)), *points]), view, boxes)
            assert not (count == wrong).any(), (view.name, visible)
        assert drawn_twice(drawing) < 0.1, view.name
        points = np.concatenate([along(a, b) for a, b in edges_of(boxes)])
        seen = points[rays(points, view, boxes) == 0]
        flat = np.stack([seen @ view.right, seen @ view.up], axis=1)
        assert distances(flat, segments(drawing, True)).max(initial=0.0) < 0.01, view.name


def test_the_rays_notice():
    boxes = np.array([[[0, 0, 0], [10, 10, 10]], [[0, 20, 0], [10, 30, 10]]], float)
    view = hlr.draw(box((1, 1, 1)), "front", **AT_SIZE).view
    behind, before = np.array([[5.0, 20.0, 5.0]]), np.array([[5.0, 0.0, 5.0]])
    assert rays(behind, view, boxes).tolist() == [9]
    assert rays(before, view, boxes).tolist() == [0]
    assert 0 < rays(np.array([[10.0, 20.0, 5.0]]), view, boxes)[0] < 9
