"""Meshes without a B-rep: smooth contours, long creases, and circles where they were asked for."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import trimesh

import hlr
from hlr.drawing.curve import Arc, Bezier
from hlr.drawing.saving import render
from support.at_size import AT_SIZE
from support.measures import apart, distances, length, placed, samples

ACCURACY = 0.2
RADIUS = 20.0


def blob() -> trimesh.Trimesh:
    """A round thing whose mesh follows no contour: it turns to and fro along every one."""
    mesh = trimesh.creation.icosphere(subdivisions=5, radius=RADIUS)
    x, y, z = mesh.vertices.T
    mesh.vertices = mesh.vertices * (1.0 + 0.15 * np.sin(0.2 * x) + 0.1 * np.cos(0.15 * y + 0.1 * z))[:, None]
    return mesh


def pieces(points: np.ndarray) -> np.ndarray:
    return np.stack([points[:-1], points[1:]], axis=1)


def contour(mesh: trimesh.Trimesh, drawing: hlr.Drawing) -> np.ndarray:
    """(n, 2, 2) on paper: the mesh edges between triangles turned toward the viewer and away from him."""
    front = mesh.face_normals @ np.asarray(drawing.view.direction) > 0
    pairs, edges = mesh.face_adjacency, mesh.face_adjacency_edges
    ends = mesh.vertices[edges[front[pairs[:, 0]] != front[pairs[:, 1]]]]
    return np.stack([ends @ np.asarray(drawing.view.right), ends @ np.asarray(drawing.view.up)], axis=2)


def turns(points: np.ndarray) -> np.ndarray:
    """Degrees at the inner vertices of a polyline."""
    way = np.diff(points, axis=0)
    angle = np.degrees(np.arctan2(way[:, 1], way[:, 0]))
    return np.abs((np.diff(angle) + 180.0) % 360.0 - 180.0)


@pytest.fixture(scope="module")
def smooth() -> tuple[trimesh.Trimesh, hlr.Drawing]:
    mesh = blob()
    return mesh, hlr.draw(mesh, (3, 2, 1), accuracy=ACCURACY, **AT_SIZE)


@pytest.mark.slow
def test_a_contour_stays_within_the_accuracy_of_the_mesh(smooth: tuple[trimesh.Trimesh, hlr.Drawing]) -> None:
    mesh, drawing = smooth
    raw = contour(mesh, drawing)
    drawn = [line for line in drawing.lines if line.kind == "outline"]
    assert drawn
    for line in drawn:
        assert distances(samples(pieces(placed(drawing, line)), 0.1), raw).max() < 0.9 * ACCURACY
        if isinstance(line.curve, Bezier):
            along = line.curve.at(np.linspace(0, (len(line.curve.points) - 1) // 3, 20000))
            assert distances(along + drawing.origin, raw).max() < 0.9 * ACCURACY
            assert distances(line.points, pieces(along)).max() < 0.01 * ACCURACY
            assert distances(along, pieces(line.points)).max() < 0.2 * ACCURACY


def test_all_of_a_contour_is_drawn() -> None:
    """Of a convex mesh: one loop, from which the line is nowhere far, nor it from the line."""
    mesh = trimesh.creation.icosphere(subdivisions=4, radius=RADIUS)
    mesh.vertices = mesh.vertices * (1.0, 0.8, 0.6)
    drawing = hlr.draw(mesh, (3, 2, 1), accuracy=ACCURACY, **AT_SIZE)
    (line,) = drawing.lines
    assert apart(pieces(placed(drawing, line)), contour(mesh, drawing), 0.1) < 0.9 * ACCURACY


def test_no_zigzag_is_left(smooth: tuple[trimesh.Trimesh, hlr.Drawing]) -> None:
    mesh, drawing = smooth
    # The mesh's own contour has corners; what is drawn of it has none.
    edges = contour(mesh, drawing)
    ends, owner = np.unique(np.round(edges.reshape(-1, 2), 9), axis=0, return_inverse=True)
    sharp = 0
    for i in range(len(ends)):
        at = np.flatnonzero(owner.ravel().reshape(-1, 2).ravel() == i)
        if len(at) == 2:
            sharp += (
                turns(np.stack([edges[at[0] // 2, 1 - at[0] % 2], ends[i], edges[at[1] // 2, 1 - at[1] % 2]]))[0] > 45
            )
    assert sharp > 5
    outer = max((line for line in drawing.lines if line.kind == "outline"), key=length)
    assert isinstance(outer.curve, Bezier) and (turns(outer.points) < 25).all()
    assert len(outer.curve.points) < len(edges)


def test_a_closed_contour_closes_smoothly(smooth: tuple[trimesh.Trimesh, hlr.Drawing]) -> None:
    outer = max((line for line in smooth[1].lines if line.kind == "outline"), key=length)
    assert (outer.points[0] == outer.points[-1]).all()
    assert turns(np.stack([outer.points[-2], outer.points[0], outer.points[1]]))[0] < 25
    assert (outer.curve.points[0] == outer.points[0]).all() and (outer.curve.points[-1] == outer.points[0]).all()


@pytest.mark.parametrize("perspective", [None, hlr.Perspective()])
def test_the_points_in_space_are_where_the_line_is(perspective: Any) -> None:
    drawing = hlr.draw(blob(), (3, 2, 1), accuracy=ACCURACY, perspective=perspective, **AT_SIZE)
    view = drawing.view
    for line in drawing.lines:
        away = line.points3 - np.asarray(view.eye or (0.0, 0.0, 0.0))
        flat = np.stack([away @ np.asarray(view.right), away @ np.asarray(view.up)], axis=1)
        if view.eye is not None:
            flat *= (view.distance / -(away @ np.asarray(view.direction)))[:, None]
        assert np.abs(flat - placed(drawing, line)).max() < 1e-6


def test_ends_stay_where_they_are() -> None:
    mesh = trimesh.creation.torus(15.0, 5.0, major_sections=90, minor_sections=40)
    drawing = hlr.draw(mesh, (3, 2, 0.6), accuracy=ACCURACY, **AT_SIZE)
    raw = contour(mesh, drawing)
    broken = [line for line in drawing.lines if (line.points[0] != line.points[-1]).any()]
    assert {line.visible for line in broken} == {True, False}
    for line in broken:
        assert isinstance(line.curve, Bezier)
        assert distances(placed(drawing, line)[[0, -1]], raw).max() < 1e-9
    one, two = (line.points for line in broken)
    assert (one[-1] == two[0]).all(), "where the contour disappears, its two parts meet"


def test_the_same_bytes_with_any_number_of_threads() -> None:
    one, two = (hlr.draw(blob(), (3, 2, 1), circles=True, threads=n, **AT_SIZE) for n in (1, 2))
    assert render(one, "svg") == render(two, "svg")


def test_a_ridge_goes_on_past_valleys_that_end_on_it() -> None:
    points = [
        (0, -10, 0),
        (0, 0, 0),
        (0, 10, 0),
        (-10, -10, -10),
        (-10, 10, -10),
        (10, -10, -14),
        (10, 0, -2),
        (10, 10, -14),
    ]
    faces = [(0, 1, 3), (1, 4, 3), (1, 2, 4), (0, 5, 1), (5, 6, 1), (6, 7, 1), (7, 2, 1)]
    drawing = hlr.draw((np.array(points, float), np.array(faces)), "top", hidden=False, scale=1.0, smooth=False)
    sharp = [line for line in drawing.lines if line.kind == "sharp"]
    assert len(sharp) == 4
    ridge = max(sharp, key=length)
    assert np.ptp(ridge.points3, axis=0).tolist() == [0.0, 20.0, 0.0]
    # Where the valleys end, it keeps its vertex.
    assert (ridge.points3 == (0, 0, 0)).all(axis=1).any()


def test_a_box_keeps_its_twelve_edges() -> None:
    assert len(hlr.draw(trimesh.creation.box((1, 2, 3)), (3, 2, 1), **AT_SIZE).lines) == 12


def prism(ring: np.ndarray, height: float = 30.0) -> trimesh.Trimesh:
    """Upright, over an outline (n, 2) that is convex about the origin."""
    n = len(ring)
    i, j = np.arange(n), (np.arange(n) + 1) % n
    low, high = np.full(n, 2 * n), np.full(n, 2 * n + 1)
    faces = np.concatenate(
        [np.stack(f, axis=1) for f in ((i, j, n + j), (i, n + j, n + i), (j, i, low), (n + i, n + j, high))]
    )
    walls = [np.column_stack([ring, np.full(n, z)]) for z in (0.0, height)]
    return trimesh.Trimesh(np.concatenate([*walls, [[0, 0, 0], [0, 0, height]]]), faces, process=False)


def ring(angles: np.ndarray) -> np.ndarray:
    return RADIUS * np.stack([np.cos(angles), np.sin(angles)], axis=1)


def regular(n: int) -> np.ndarray:
    return np.arange(n) * 2 * np.pi / n + 0.1


def arcs(drawing: hlr.Drawing) -> list[hlr.Line]:
    return [line for line in drawing.lines if isinstance(line.curve, Arc)]


@pytest.mark.parametrize("n", [6, 8, 12])
def test_a_nut_is_no_circle(n: int) -> None:
    assert not arcs(hlr.draw(prism(ring(regular(n))), "iso", circles=True, **AT_SIZE))
    # Nor is it one when creases are hardly drawn, unless it has more corners than an octagon.
    assert bool(arcs(hlr.draw(prism(ring(regular(n))), "iso", circles=True, crease=80, **AT_SIZE))) == (n > 8)


def test_where_edges_are_drawn_at_every_corner_there_is_no_circle() -> None:
    assert not arcs(hlr.draw(prism(ring(regular(16))), "iso", circles=True, crease=20, **AT_SIZE))


@pytest.mark.slow
@pytest.mark.parametrize("perspective", [None, hlr.Perspective()])
@pytest.mark.parametrize("n", [13, 16, 64])
def test_a_rim_is_a_circle(n: int, perspective: Any) -> None:
    drawing = hlr.draw(prism(ring(regular(n))), "iso", circles=True, perspective=perspective, **AT_SIZE)
    rims = arcs(drawing)
    assert [line.kind for line in drawing.lines].count("sharp") == len(rims) == 3
    for line in rims:
        assert np.hypot(*line.points3[:, :2].T) == pytest.approx(RADIUS, abs=1e-9)
        assert apart(pieces(line.points), pieces(line.curve.at(np.linspace(*line.curve.angles, 2000)))) < 0.01
    low = [line for line in rims if line.points3[0, 2] == 0.0]
    assert {line.visible for line in low} == {True, False}
    assert low[0].curve.axes == pytest.approx(low[1].curve.axes) and low[0].curve.centre == pytest.approx(
        low[1].curve.centre
    )
    # Beside the outlines a hidden rim lies under their ink.
    assert 5.9 < sum(abs(np.ptp(line.curve.angles)) for line in low) < 2 * math.pi + 1e-9
    (top,) = (line for line in rims if line.points3[0, 2] == 30.0)
    assert top.curve.whole and (top.points[0] == top.points[-1]).all()


def test_circles_are_drawn_only_where_they_are_asked_for() -> None:
    assert not arcs(hlr.draw(prism(ring(regular(64))), "iso", **AT_SIZE))
    with pytest.raises(hlr.HlrError, match="circles is yes or no"):
        hlr.draw(prism(ring(regular(64))), "iso", circles="all", **AT_SIZE)


def test_what_is_not_quite_a_circle_is_none() -> None:
    flat = np.linspace(0.0, 2 * np.pi - math.radians(25), 70)
    assert not arcs(hlr.draw(prism(ring(flat)), "iso", circles=True, **AT_SIZE)), "a shaft with a flat"
    assert not arcs(hlr.draw(prism(ring(regular(64)) * (1.0, 0.98)), "iso", circles=True, **AT_SIZE)), "an ellipse"
    dented = ring(regular(64))
    dented[7] *= 1.0 - 0.1 / RADIUS
    assert not arcs(hlr.draw(prism(dented), "iso", circles=True, **AT_SIZE)), "a vertex off by two accuracies"
    assert arcs(hlr.draw(prism(dented), "iso", circles=True, accuracy=0.2, **AT_SIZE))


def test_an_open_rim_is_an_arc() -> None:
    """A quarter of a cylinder: each rim is an arc between corners, beside two straight lines."""
    quarter = np.concatenate([ring(np.linspace(0.0, 0.5 * np.pi, 17)), [[0.0, 0.0]]]) - 8.0
    lines = hlr.draw(prism(quarter), (1, 1, 3), circles=True, hidden=False, scale=1.0, smooth=False).lines
    found = [line for line in lines if isinstance(line.curve, Arc)]
    assert len(found) == 2
    for line in found:
        assert not line.curve.whole
        assert np.hypot(*(line.points3[:, :2] + 8.0).T) == pytest.approx(RADIUS, abs=1e-9)
        assert np.ptp(line.points3[:, :2], axis=0) == pytest.approx([RADIUS, RADIUS])
