"""A section of one closed surface that passes through itself, or runs along itself: of parts joined, but not united.

The cut face of the star is one line that crosses itself, that of the ring has a slit of no width whose sides have
different corners. Both were triangulated with lines from corner to corner, and lost parts of their border.
Reference: the line in which the triangles meet the plane, segment by segment.
"""

from __future__ import annotations

import numpy as np
import pytest
from manifold3d import triangulate

from support.sections import section

HEIGHT = 10.0


def prism(outline, caps):
    """A closed surface over an outline (n, 2), bottom and top of triangles (m, 3) of its corners."""
    count = len(outline)
    points = np.array([(x, y, z) for z in (0.0, HEIGHT) for x, y in outline])
    here, then = np.arange(count), np.roll(np.arange(count), -1)
    walls = [np.stack([here, then, count + then], axis=1), np.stack([here, count + then, count + here], axis=1)]
    return points, np.concatenate([*walls, caps[:, ::-1], count + caps])


def star():
    """With five points: its outline goes around its middle twice."""
    angles = np.pi / 2 + np.arange(5) * 4 * np.pi / 5
    return prism(20 * np.stack([np.cos(angles), np.sin(angles)], axis=1), np.array([(0, 1, 2), (0, 2, 3), (0, 3, 4)]))


def ring():
    """A bar bent to a ring of rectangles until its ends touch, along y = 15."""
    outside = [(0, 15), (0, 0), (40, 0), (40, 30), (0, 30), (0, 15)]
    inside = [(3, 15), (10, 15), (10, 20), (30, 20), (30, 10), (10, 10), (10, 15), (6, 15)]
    outline = np.array([*outside, *inside], float)
    return prism(outline, np.asarray(triangulate([outline]), np.int64))


def met(mesh, axis, level):
    """(n, 2, 3) the segments in which triangles meet a plane across an axis."""
    found = []
    for corners in mesh[0][mesh[1]]:
        before = corners[:, axis] > level
        if before.any() and not before.all():
            ends = [(p, q) for p, q in zip(corners, np.roll(corners, -1, axis=0), strict=True)]
            crossed = [(p, q) for p, q in ends if (p[axis] > level) != (q[axis] > level)]
            found.append([p + (level - p[axis]) / (q[axis] - p[axis]) * (q - p) for p, q in crossed])
    return np.array(found)


def spread(pieces, step=0.05):
    """(n, 3) points along pieces (k, 2, 3)."""
    long = np.linalg.norm(pieces[:, 1] - pieces[:, 0], axis=1)
    shares = [np.linspace(0.0, 1.0, 2 + int(each / step))[:, None] for each in long]
    return np.concatenate([a + share * (b - a) for (a, b), share in zip(pieces, shares, strict=True)])


def farthest(points, others):
    """How far the farthest of points (n, 3) lies from others (k, 3)."""
    return max(float(np.linalg.norm(others - point, axis=1).min()) for point in points)


PLANES = [("top", 2, 0.3), ("top", 2, 0.47), ("front", 1, 0.62), ("right", 0, 0.3), ("right", 0, 0.47)]


@pytest.mark.parametrize("shape", [star, ring])
@pytest.mark.parametrize(("view", "axis", "share"), PLANES)
def test_its_border_is_where_the_triangles_meet_the_plane(shape, view, axis, share, picture):
    mesh = shape()
    low, high = mesh[0][:, axis].min(), mesh[0][:, axis].max()
    level = float(low + share * (high - low))
    drawing = section(mesh, view, level)
    lines = [line.points3 for line in drawing.visible if line.kind != "hatch"]
    drawn = np.concatenate([np.stack([points[:-1], points[1:]], axis=1) for points in lines])
    on_plane = drawn[(np.abs(drawn[..., axis] - level) < 1e-6).all(axis=1)]
    across = [k for k in range(3) if k != axis]
    truth = spread(met(mesh, axis, level))
    assert farthest(truth[:, across], spread(drawn)[:, across]) < 0.1
    assert farthest(spread(on_plane), truth) < 0.1
    if share == PLANES[0][2] and view == "top":
        picture(drawing, shape.__name__)
