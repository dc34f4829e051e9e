"""Two holes that touch in one point: their borders share a vertex, where the body has no width."""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr


def drilled(body: cq.Workplane, plane: str, places: list[tuple[float, float]], radius: float) -> cq.Workplane:
    for place in places:
        body = body.cut(cq.Workplane(plane).center(*place).circle(radius).extrude(60))
    return body


def vase() -> cq.Workplane:
    profile = cq.Workplane("XZ").moveTo(0, -30).lineTo(20, -30)
    return profile.spline([(24, 0), (20, 30)], includeCurrent=True).lineTo(0, 30).close().revolve()


@pytest.mark.parametrize("turn", [0, 30, 45, 77, 90, 180])
def test_the_plate_is_meshed_and_both_holes_are_whole_circles(turn):
    plate = drilled(cq.Workplane().rect(100, 80).extrude(5), "XY", [(-20, 12.5), (-20, -12.5)], 12.5)
    drawing = hlr.draw(plate.rotate((0, 0, 0), (0, 0, 1), turn), "top", scale=1.0, hidden=False)
    assert not {note.code for note in drawing.notes} & {"not-meshed", "faces-mended"}
    # Beside the point itself, both run under one pen.
    arcs = [line.curve for line in drawing.visible if line.curve is not None]
    assert sum(abs(arc.angles[1] - arc.angles[0]) for arc in arcs) == pytest.approx(4 * np.pi, abs=0.1)
    assert all(np.linalg.norm(arc.axes[0]) == pytest.approx(12.5) for arc in arcs)


@pytest.mark.parametrize("turn", [0, 33])
@pytest.mark.parametrize("along", [(5, 0), (0, 5), (5 / 2**0.5, 5 / 2**0.5)])
@pytest.mark.parametrize(
    "body",
    [
        lambda: cq.Workplane().circle(20).extrude(60).translate((0, 0, -30)),
        lambda: cq.Workplane(cq.Solid.makeCone(30, 10, 60)).translate((0, 0, -30)),
        lambda: cq.Workplane().sphere(20),
        lambda: cq.Workplane(cq.Solid.makeTorus(30, 12)),
        vase,
    ],
    ids=["cylinder", "cone", "sphere", "torus", "vase"],
)
def test_holes_that_touch_on_the_seam_are_meshed(body, along, turn):
    x, y = along
    holed = drilled(body(), "YZ", [(x, y), (-x, -y)], 5).rotate((0, 0, 0), (1, 2, 3), turn)
    drawing = hlr.draw(holed, "iso", hidden=True)
    assert not {note.code for note in drawing.notes} & {"not-meshed", "faces-mended"}
    assert len(drawing.visible) >= 3
