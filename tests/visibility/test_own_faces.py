"""What the polygons of its own face do to an edge that lies among them: the kernel's answer, polygon by polygon."""

from __future__ import annotations

import numpy as np
import pytest

from hlr import _kernel

VISIBLE, HIDDEN = 0, 1
UNKNOWN, SEEN, GONE = 0, 1, 2
"""What an edge's faces do to it, as the tracer of outlines knows it."""

OPENLY = 0.5
EDGE_ON = 30.0
"""Slope of a polygon in front of the edge: depth per length in the image. Smaller depths are nearer."""


def pieces(slope, *, own=True, face=0, stretches=((0.0, 1.0),), beside=(UNKNOWN,), dented=False, off=0.4):
    """An edge along x at depth 0 with one polygon 0.1 before it; compared with it from `off` nearer to the viewer.

    own: whether the kernel is told that the polygon is of the edge's own face, `face` the number it is told
    """
    points = [[-1, 0, 0], [1, 0, 0]]
    y = 0.3 / slope
    points += [[-2, -y, -0.1 - y * slope], [2, -y, -0.1 - y * slope], [0, y, -0.1 + y * slope]]
    edges = [[0, 1]]
    line, away = [], []
    for start, end in stretches:
        n = len(points)
        ends = [[2 * t - 1, 0, 0] for t in (start, end)]
        points += [*ends, *([x, y, -off] for x, y, _ in ends)]
        line.append(len(edges))
        away.append(len(edges) + 1)
        edges += [[n, n + 1], [n + 2, n + 3]]
    k = len(stretches)
    told = _kernel.Stretches(
        np.zeros(k, np.int32),
        np.array(stretches, float),
        np.array(line, np.int32),
        np.array(beside, np.uint8),
        np.full(k, dented),
        np.arange(k + 1, dtype=np.int32),
        np.full(k, face, np.int32),
        np.array(away, np.int32),
        np.arange(2, dtype=np.int32),
    )
    mesh = _kernel.Mesh(
        np.array(points, float),
        np.array([[2, 3, 4]], np.int32),
        np.array(edges, np.int32),
        np.zeros(len(edges) + 1, np.int32),
        np.zeros(0, np.int32),
    )
    no = np.array([False])
    given = _kernel.VisibilityInput.of(
        np.zeros(1, np.int32),
        np.zeros(len(edges), np.int32),
        np.array([1] + [0] * (len(edges) - 1), np.uint8),
        cull=no,
        sound=no,
        delta=np.zeros(1),
        cap=np.zeros(1),
        tight=no,
        drawn=[],
    )
    found = _kernel.visibility(mesh, np.array(points, float), given, (told, np.zeros(1, np.int32)) if own else None)
    assert set(found.edge.tolist()) == {0}
    t0, t1, state = found.t0.round(6).tolist(), found.t1.round(6).tolist(), found.state.tolist()
    return list(zip(t0, t1, state, strict=True))


ALL_HIDDEN, ALL_SEEN = [(0.0, 1.0, HIDDEN)], [(0.0, 1.0, VISIBLE)]


@pytest.mark.parametrize("slope", [OPENLY, EDGE_ON])
def test_what_is_said_of_no_face_hides(slope):
    assert pieces(slope, own=False) == ALL_HIDDEN
    assert pieces(slope, face=1) == ALL_HIDDEN


def test_its_own_face_seen_edge_on_does_not_hide_it_by_a_hair():
    assert pieces(EDGE_ON) == ALL_SEEN
    assert pieces(EDGE_ON, off=0.05) == ALL_HIDDEN


def test_its_own_face_seen_openly_hides_it_unless_it_is_dented_there():
    assert pieces(OPENLY) == ALL_HIDDEN
    assert pieces(OPENLY, dented=True) == ALL_SEEN
    assert pieces(OPENLY, dented=True, off=0.05) == ALL_HIDDEN


def test_an_edge_that_its_faces_hide_is_hidden_whatever_its_polygons_do():
    assert pieces(EDGE_ON, beside=(GONE,)) == ALL_HIDDEN
    assert pieces(EDGE_ON, stretches=((0.0, 0.3), (0.3, 1.0)), beside=(SEEN, GONE)) == [
        (0.0, 0.3, VISIBLE),
        (0.3, 1.0, HIDDEN),
    ]
