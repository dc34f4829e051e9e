"""Two holes of a plate that touch in one point: their circles share a vertex, where the plate has no width."""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr


@pytest.mark.parametrize("turn", [0, 30, 45, 77, 90, 180])
def test_the_plate_is_meshed_and_both_holes_are_whole_circles(turn):
    plate = cq.Workplane().rect(100, 80).extrude(5)
    for y in (12.5, -12.5):
        plate = plate.cut(cq.Workplane().center(-20, y).circle(12.5).extrude(5))
    drawing = hlr.draw(plate.rotate((0, 0, 0), (0, 0, 1), turn), "top", scale=1.0, hidden=False)
    assert not {note.code for note in drawing.notes} & {"not-meshed", "faces-mended"}
    # Beside the point itself, both run under one pen.
    arcs = [line.curve for line in drawing.visible if line.curve is not None]
    assert sum(abs(arc.angles[1] - arc.angles[0]) for arc in arcs) == pytest.approx(4 * np.pi, abs=0.1)
    assert all(np.linalg.norm(arc.axes[0]) == pytest.approx(12.5) for arc in arcs)
