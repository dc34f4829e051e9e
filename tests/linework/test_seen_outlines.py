"""No outline is missing in perspective: places at which a true surface is seen edge-on, and rays say that one sees
them, have a visible line; and rays agree with what is drawn visible and hidden.

The places are found by OpenCASCADE alone: the sign of N . V on a grid over each face, and halving where it changes.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import cadquery as cq
import numpy as np
import pytest
from scipy.spatial import cKDTree

import hlr
from hlr.drawing.saving import render
from support.at_size import ALL_LINES
from support.referee import exchange, reference
from support.referee.judge import RayCaster, judge

GRID, HALVINGS = 12, 40
FINENESS = 5000
ASIDE = 2.5
"""Accuracies beside the outline at which rays pass it. Where it just begins to be covered they cannot tell."""
CLOSE = 4.0
"""Accuracies: a line this near is that of the place."""
CAMERAS = {"far": hlr.Perspective(fov=25.0), "near": hlr.Perspective(fov=110.0)}


def vase() -> Any:
    profile = cq.Workplane("XZ").lineTo(8, 0).spline([(14, 10), (5, 25), (9, 36)], includeCurrent=True)
    return profile.lineTo(0, 36).close().revolve(360, (0, 0, 0), (0, 1, 0))


def dome() -> Any:
    ball = cq.Workplane().sphere(15).cut(cq.Workplane().box(60, 60, 30).translate((0, 0, -15)))
    return ball.cut(cq.Workplane().circle(4).extrude(40)).edges(">Z").fillet(1)


SHAPES = {
    "rounded box": lambda size: cq.Workplane().box(30 * size, 20 * size, 10 * size).edges().fillet(3 * size),
    "torus": lambda size: cq.Workplane(obj=cq.Solid.makeTorus(20 * size, 6 * size)),
    "loft": lambda _: cq.Workplane().rect(30, 20).workplane(offset=25).circle(6).loft(),
    "vase": lambda _: vase(),
    "dome": lambda _: dome(),
}
CASES = [(name, 1.0) for name in SHAPES] + [("torus", 0.02), ("rounded box", 3000.0)]


def edge_on(face: Any, eye: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Places of a face that are seen edge-on, and its outward unit normals there."""
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.BRepTools import BRepTools
    from OCP.BRepTopAdaptor import BRepTopAdaptor_FClass2d
    from OCP.gp import gp_Pnt, gp_Pnt2d, gp_Vec
    from OCP.TopAbs import TopAbs_REVERSED, TopAbs_State

    surface, inside = BRepAdaptor_Surface(face, True), BRepTopAdaptor_FClass2d(face, 1e-7)
    sign = -1.0 if face.Orientation() == TopAbs_REVERSED else 1.0
    p, du, dv = gp_Pnt(), gp_Vec(), gp_Vec()

    def at(place: np.ndarray) -> tuple[float, np.ndarray, np.ndarray]:
        surface.D1(*place.tolist(), p, du, dv)
        across = sign * np.cross(du.Coord(), dv.Coord())
        normal = across / max(float(np.linalg.norm(across)), 1e-300)
        point = np.array(p.Coord())
        return float(normal @ (point - eye)), point, normal

    low_u, high_u, low_v, high_v = BRepTools.UVBounds_s(face)
    low, size = np.array([low_u, low_v]), np.array([high_u - low_u, high_v - low_v])
    # Off the borders: there a pole has no normal.
    share = np.linspace(1e-4, 1 - 1e-4, GRID)
    places = np.stack(np.meshgrid(share, share, indexing="ij"), axis=2) * size + low
    away = np.array([[at(place)[0] > 0.0 for place in row] for row in places])
    for shift in ((1, 0), (0, 1)):
        i, j = np.nonzero(away[: GRID - shift[0], : GRID - shift[1]] != away[shift[0] :, shift[1] :])
        for start, end in zip(places[i, j], places[i + shift[0], j + shift[1]], strict=True):
            place, step, behind = start, end - start, at(start)[0] > 0.0
            for _ in range(HALVINGS):
                step = step / 2
                place = place + step if (at(place + step)[0] > 0.0) == behind else place
            if inside.Perform(gp_Pnt2d(*place.tolist())) == TopAbs_State.TopAbs_IN:
                yield at(place)[1:]


def drawn(shape: Any, camera: str) -> exchange.Exchange:
    options = hlr.Options(perspective=CAMERAS[camera], **ALL_LINES)
    (drawing,) = hlr.draw_views(shape, [(-0.6, -1.0, 0.45)], options)
    return exchange.parse(render(drawing, "json"))


def off(shape: Any, document: exchange.Exchange, caster: RayCaster) -> np.ndarray:
    """How far from the nearest visible line each place of an outline that rays see is on paper, in accuracies."""
    eye = document.camera.eye
    assert eye is not None
    found = [place for face in shape.faces().vals() for place in edge_on(face.wrapped, eye)]
    places, normals = (np.array(each) for each in zip(*found, strict=True))
    aside = ASIDE * document.accuracy / document.magnification(places)
    beside = places + normals * np.maximum(aside, 2 * caster.diagonal / FINENESS)[:, None]
    seen = ~caster.blocked_each(beside, document.camera)[:, 0]
    ink = np.concatenate([line.ink(document.accuracy) for line in document.lines if line.visible])
    far, _ = cKDTree(ink).query(document.on_paper(places[seen]))
    return np.asarray(far / document.accuracy)


@pytest.mark.slow
@pytest.mark.parametrize("camera", CAMERAS)
@pytest.mark.parametrize(("name", "size"), CASES)
def test_every_outline_that_rays_see_is_drawn(name: str, size: float, camera: str) -> None:
    shape = SHAPES[name](size)
    document = drawn(shape, camera)
    caster = RayCaster(reference.from_shape(shape.val().wrapped, FINENESS))
    assert judge(document, caster).wrong == 0
    far = off(shape, document, caster)
    assert len(far) >= 5 and far.max() < CLOSE


@pytest.mark.slow
def test_an_outline_that_is_not_drawn_is_noticed() -> None:
    shape = SHAPES["rounded box"](1.0)
    document = drawn(shape, "near")
    caster = RayCaster(reference.from_shape(shape.val().wrapped, FINENESS))
    outlines = [line for line in document.lines if line.visible and line.kind == "outline"]
    lengths = [np.linalg.norm(np.diff(line.points, axis=0), axis=1).sum() for line in outlines]
    for longest in np.argsort(lengths)[-3:].tolist():
        rest = [line for line in document.lines if line is not outlines[longest]]
        assert off(shape, replace(document, lines=rest), caster).max() > CLOSE
