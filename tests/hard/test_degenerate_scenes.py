"""Hardly anything: one triangle, none, all corners on one line, all in one place, an edge that points at the viewer."""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import agrees, expect
from support.meshes import face, ring

CORNERS = [(0, 0, 0), (12, 0, 0), (3, 9, 0)]
NONE = np.zeros((0, 3), int)


@pytest.mark.parametrize("view", ["top", "bottom", "iso", (1, 2, 3)])
@pytest.mark.parametrize("order", [1, -1])
def test_one_triangle(picture, view, order):
    points, triangles = face(*CORNERS[::order])
    drawing = hlr.draw((points, triangles), view, **AT_SIZE)
    agrees(drawing, expect(drawing, ring(CORNERS)))
    assert all(line.visible for line in drawing.lines)
    if view == "iso" and order == 1:
        picture(drawing)


@pytest.mark.parametrize("view", ["front", "right"])
def test_one_triangle_on_edge(view):
    drawing = hlr.draw(face(*CORNERS), view, **AT_SIZE)
    ends = ((0, 0, 0), (12, 0, 0)) if view == "front" else ((0, 0, 0), (0, 9, 0))
    agrees(drawing, expect(drawing, [ends]))


@pytest.mark.parametrize(
    ("points", "triangles"),
    [
        (NONE.astype(float), NONE),
        (np.eye(3), NONE),
        (np.zeros((3, 3)), [[0, 1, 2]]),
        (np.eye(3), [[0, 1, 1], [2, 2, 2]]),
    ],
)
def test_no_triangle_is_refused_in_words(points, triangles):
    with pytest.raises(hlr.SourceError, match="there is nothing to draw"):
        hlr.draw((points, np.asarray(triangles)), **AT_SIZE)


@pytest.mark.parametrize("direction", [(1, 0, 0), (1, 1, 1), (1, 2, -3), (1e-3, 1, 0)])
def test_all_corners_on_one_line(direction):
    d = np.array(direction, float)
    points = np.array([0, 5, 7, 20])[:, None] * d
    drawing = hlr.draw((points, np.array([[0, 1, 2], [1, 3, 2], [0, 2, 3]])), (0.3, -1, 0.4), **AT_SIZE)
    agrees(drawing, expect(drawing, [(points[0], points[3])]))
    assert all(line.visible for line in drawing.lines)


def test_all_corners_on_one_line_that_points_at_the_viewer():
    points = np.array([0.0, 5, 7])[:, None] * np.array([0, 1.0, 0])
    try:
        drawing = hlr.draw((points, np.array([[0, 1, 2]])), "front", **AT_SIZE)
    except hlr.HlrError as refused:
        assert "no size" in str(refused) or "nothing" in str(refused)
    else:
        assert drawing.lines == ()
        assert drawing.notes


@pytest.mark.parametrize("up", [(1, -1, 1), (-2, 2, -2), (1e-200, -1e-200, 1e-200)])
def test_up_parallel_to_the_direction_is_refused_in_words(up):
    with pytest.raises(hlr.ViewError, match="`up` is parallel to the view direction: give another direction"):
        hlr.draw(face(*CORNERS), "iso", up=up, **AT_SIZE)


@pytest.mark.parametrize("off", [1e-7, 1e-5, 1e-2])
def test_up_a_little_off_the_direction_is_square_to_it(off):
    drawing = hlr.draw(face(*CORNERS), (0, 0, 1), up=(0, off, 1), **AT_SIZE)
    assert drawing.view.up == pytest.approx((0, 1, 0), abs=1e-12)
    agrees(drawing, expect(drawing, ring(CORNERS)))
