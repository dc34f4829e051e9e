"""A ball alone is meshed coarsely: its outline lies on the sphere, and nothing else is drawn of it."""

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.source import open_source
from hlr.source.brep import BrepSource

EFFECT = "meshing of curved faces"
COARSE = 1000
"""Triangles."""


def sphere(radius=10.0):
    return cq.Workplane().sphere(radius)


def reason(drawing):
    (row,) = [d for d in drawing.plan if d.name == EFFECT]
    return row.reason


def is_circle(drawing, radius):
    (line,) = drawing.lines
    assert (line.kind, line.visible, line.curve.whole) == ("outline", True, True)
    away = np.linalg.norm(line.points - line.curve.centre, axis=1)
    step = np.linalg.norm(np.diff(line.points, axis=0), axis=1).max()
    assert np.abs(away - radius).max() < 1e-6 * radius
    assert step * step / (8.0 * radius) < drawing.accuracy.used  # its chords as well


@pytest.mark.parametrize("view", ["iso", "top", (0.3, -1.0, 0.2)])
@pytest.mark.parametrize("turn", [0.0, 33.0, 71.0])
def test_a_ball_is_its_outline_within_the_accuracy(view, turn):
    ball = sphere().rotate((0, 0, 0), (1, 2, 3), turn).translate((40, -7, 3))
    drawing = hlr.draw(ball, view, smooth=True)
    is_circle(drawing, 10.0)
    assert reason(drawing).startswith("a ball alone, coarsely")
    assert drawing.counters["triangles"] < COARSE
    assert hlr.draw(ball, view, smooth=True, accuracy=0.001).counters["triangles"] == drawing.counters["triangles"]


@pytest.mark.parametrize("view", ["front", "back", "left", "right"])
def test_an_outline_through_the_poles_calls_for_a_fine_mesh(view):
    drawing = hlr.draw(sphere().translate((40, -7, 3)), view, smooth=True)
    is_circle(drawing, 10.0)
    assert drawing.counters["triangles"] > COARSE and "ball" not in reason(drawing)


@pytest.mark.parametrize("tilt", [2e-3, 0.01, 0.1, 0.2, 0.3])
@pytest.mark.parametrize("around", [0.0, 45.0, 123.0])
def test_an_outline_beside_the_poles_is_one_circle(tilt, around):
    turn = np.radians(around)
    view = (np.cos(turn) * np.cos(tilt), np.sin(turn) * np.cos(tilt), np.sin(tilt))
    drawing = hlr.draw(sphere(), view)
    is_circle(drawing, 10.0)
    assert drawing.counters["triangles"] < COARSE


@pytest.mark.parametrize("node", range(3, 200, 14))
def test_an_outline_through_corners_of_the_mesh_is_one_circle(node):
    corner = open_source(sphere()).mesh(10.0 / 40.0, 0.5).parts.tables.points[node]
    view = tuple(np.cross(corner, (0.3, 0.4, 0.5)))
    drawing = hlr.draw(sphere(), view)
    is_circle(drawing, 10.0)
    assert drawing.counters["triangles"] < COARSE


def test_it_is_as_large_before_an_eye_and_fitted_into_a_sheet():
    fitted = hlr.draw(sphere(), "iso", fit=(100.0, 100.0))
    is_circle(fitted, 50.0 - 0.5 * (100.0 - fitted.bounds.width))
    assert 99.9 < fitted.bounds.width <= 100.0
    eye = hlr.Perspective(eye=(0.0, -30.0, 40.0), target=(0.0, 0.0, 0.0))
    is_circle(hlr.draw(sphere(), perspective=eye), 50.0 * 10.0 / (50.0**2 - 10.0**2) ** 0.5)


def test_the_same_lines_as_of_a_fine_mesh(monkeypatch):
    coarse = hlr.draw(sphere(), "iso")
    monkeypatch.setattr(BrepSource, "ball", lambda _source: None)
    fine = hlr.draw(sphere(), "iso")
    assert fine.counters["triangles"] > 10 * COARSE > coarse.counters["triangles"]
    assert coarse.to_svg() == fine.to_svg()


@pytest.mark.parametrize(
    ("model", "options"),
    [
        (sphere(), {"fill": True}),
        (sphere(), {"seam": True}),
        (cq.Workplane(obj=cq.Solid.makeSphere(10, cq.Vector(), cq.Vector(0, 0, 1), 0, 90)), {}),
        (sphere().cut(sphere(5.0)), {}),
        (sphere().union(sphere().translate((30, 0, 0))), {}),
        ([cq.Solid.makeSphere(10.0).Faces()[0], cq.Workplane().box(2, 2, 60).val()], {}),
    ],
    ids=["filled", "with its seam", "half a ball", "hollow", "two", "beside something"],
)
def test_what_else_is_drawn_calls_for_a_fine_mesh(model, options):
    drawing = hlr.draw(model, "iso", **options)
    assert drawing.counters["triangles"] > COARSE and "ball" not in reason(drawing)


def test_a_piece_of_a_sphere_is_no_ball():
    whole = cq.Solid.makeSphere(10.0, cq.Vector(), cq.Vector(0, 0, 1), -30, 60, 300)
    piece = next(face for face in whole.Faces() if face.geomType() == "SPHERE")
    drawing = hlr.draw(piece, "iso")
    assert drawing.counters["triangles"] > COARSE and "ball" not in reason(drawing)
    assert len(drawing.lines) > 4


def test_a_preview_shows_a_fine_mesh():
    shown = hlr.preview(sphere(), size=(200, 200))
    inside = np.argwhere(shown.pixels[..., :3].min(axis=2) < 250)
    reach = np.hypot(*(inside - inside.mean(axis=0)).T)
    corners = reach[reach > 0.9 * reach.max()].max()
    assert abs(np.pi * corners**2 / len(inside) - 1.0) < 0.03  # a polygon of thirty corners would fall short
