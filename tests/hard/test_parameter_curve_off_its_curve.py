"""A face on which an edge has a curve in (u, v) that lies beside the edge's curve in space: an invalid face.

Vertices and curves in space are right, and what is drawn follows them. OpenCASCADE's polygon of the edge follows the
curve in (u, v) instead: it starts millimetres away from its vertex, and a slot became a tangle.
"""

from __future__ import annotations

from typing import Any

import cadquery as cq
import numpy as np
import pytest

import hlr

RADIUS = 50.0


def slotted(shift: tuple[float, float], which: tuple[int, ...]) -> Any:
    """A round bar with a slot through one side; of the slot's edges on the round face some are shifted in (u, v)."""
    from OCP.BRep import BRep_Builder, BRep_Tool
    from OCP.gp import gp_Trsf2d, gp_Vec2d

    bar = cq.Workplane("XY").circle(RADIUS).extrude(60)
    part: Any = bar.cut(cq.Workplane("XZ").center(0, 30).slot2D(40, 16).extrude(-80)).val()
    round_face = max((f for f in part.Faces() if f.geomType() == "CYLINDER"), key=lambda f: f.Area())
    ends = [e for e in round_face.Edges() if e.geomType() != "LINE" and 15 < e.Center().z < 45]
    assert len(ends) == 4
    move = gp_Trsf2d()
    move.SetTranslation(gp_Vec2d(shift[0] / RADIUS, shift[1]))
    for i in which:
        edge = ends[i].wrapped
        curve = BRep_Tool.CurveOnSurface_s(edge, round_face.wrapped, 0.0, 0.0).Copy()
        curve.Transform(move)
        builder = BRep_Builder()
        builder.UpdateEdge(edge, curve, round_face.wrapped, 1e-7)
        builder.SameParameter(edge, False)
        builder.SameRange(edge, False)
    return part


def ink(drawing: hlr.Drawing) -> float:
    """Millimetres of visible lines."""
    return sum(float(np.hypot(*np.diff(line.points, axis=0).T).sum()) for line in drawing.lines if line.visible)


def test_the_sound_part() -> None:
    drawing = hlr.draw(slotted((0.0, 0.0), (0,)), "back", hidden=False, scale=1.0, smooth=False)
    # The box of the bar, and the slot: two straight sides and two half circles.
    assert ink(drawing) == pytest.approx(2 * (100 + 60) + 2 * 24 + 16 * np.pi, abs=0.1)


@pytest.mark.slow
@pytest.mark.parametrize("which", [(0,), (1,), (0, 1), (0, 1, 2, 3)])
@pytest.mark.parametrize("shift", [(0.0, 3.4), (0.0, -3.4)])
def test_lines_follow_the_curves_in_space(shift: tuple[float, float], which: tuple[int, ...]) -> None:
    sound, drawing = (
        hlr.draw(slotted(s, which), "back", hidden=False, scale=1.0, smooth=False) for s in ((0.0, 0.0), shift)
    )
    assert ink(drawing) == pytest.approx(ink(sound), abs=0.1)
    assert np.allclose(drawing.bounds, sound.bounds, atol=0.1)
