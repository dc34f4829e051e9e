"""A cap of an ellipsoid between four walls, from a STEP file: its border runs around the pole, and there is no seam.

In (u, v) that border begins at one u and ends a period beyond. Modellers close it by a seam and an edge without length
at the pole; the file has neither. The face had no mesh: the part was open, one saw into it, and the outline of the cap
was missing. OpenCASCADE cannot mesh such a face either.
"""

from __future__ import annotations

import math

import cadquery as cq
import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE

WIDE, HIGH, HALF, LEVEL = 20.0, 10.0, 15.0, 7.0
"""Half axes of the ellipsoid, half the width of the block, and how high above the pole it ends."""


def block(pole_above: bool) -> cq.Workplane:
    """The pole is the origin."""
    ellipsoid = cq.Workplane("XZ").ellipseArc(WIDE, HIGH, -90, 90).close().revolve(360, (0, 0, 0), (0, 1, 0))
    part = ellipsoid.intersect(cq.Workplane().box(2 * HALF, 2 * HALF, 2 * LEVEL))
    return part.rotate((0, 0, 0), (1, 0, 0), 180) if pole_above else part


def ink(drawing: hlr.Drawing) -> float:
    """Millimetres of visible lines."""
    return sum(float(np.linalg.norm(np.diff(line.points, axis=0), axis=1).sum()) for line in drawing.visible)


@pytest.fixture(params=["above", "below"])
def file(request, tmp_path):
    path = tmp_path / f"{request.param}.step"
    cq.exporters.export(block(request.param == "above"), str(path))
    return path


def test_the_outline_of_the_cap_is_an_arc_of_an_ellipse(file):
    drawing = hlr.draw(file, "front", **AT_SIZE)
    assert not drawing.notes
    points = np.concatenate([line.points3 for line in drawing.visible if line.kind == "outline"])
    x, up = points[:, 0], np.abs(points[:, 2])
    assert np.hypot(x / WIDE, (HIGH - up) / HIGH) == pytest.approx(1.0, abs=0.005)
    assert [x.min(), x.max()] == pytest.approx([-HALF, HALF], abs=0.05)
    assert up.max() == pytest.approx(HIGH - HIGH * math.sqrt(1 - (HALF / WIDE) ** 2), abs=0.05)


def test_the_drawing_is_that_of_the_same_part_in_memory(file):
    for view in ("front", "top", "iso"):
        read, made = hlr.draw(file, view, **AT_SIZE), hlr.draw(block(file.stem == "above"), view, **AT_SIZE)
        assert not read.notes
        assert ink(read) == pytest.approx(ink(made), abs=0.1)


def test_the_seam_is_no_line(tmp_path, picture):
    path = tmp_path / "cap.step"
    cq.exporters.export(block(True), str(path))
    drawing = hlr.draw(path, "iso", scale=4.0)
    assert {line.kind for line in drawing.lines} == {"sharp", "outline"}
    picture(drawing)
