"""A section some millionths of a millimetre beside the middle of a ball, along its seam.

The seam lies on the plane, as near as the kernel tells, and what is left between the two is too narrow to follow. The
ball was cut open or not hatched, and a hollow one was refused: the section would leave nothing of it.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.sections import measured_area

RADIUS, CAVITY = 20.0, 10.0

BESIDE = [1e-6, -1e-6, 5e-6, -5e-6]
"""How far the plane lies beside the middle."""


def ball(hollow: bool) -> cq.Workplane:
    whole = cq.Workplane().sphere(RADIUS)
    return whole.cut(cq.Workplane().sphere(CAVITY)) if hollow else whole


@pytest.mark.parametrize("beside", BESIDE)
@pytest.mark.parametrize("hollow", [False, True])
def test_it_is_hatched_as_through_the_middle(hollow: bool, beside: float) -> None:
    drawing = hlr.draw(ball(hollow), "front", section=beside, **AT_SIZE)
    assert not drawing.notes
    area = np.pi * (RADIUS**2 - (CAVITY**2 if hollow else 0.0))
    assert measured_area(drawing) == pytest.approx(area, rel=0.02)
    middle = hlr.draw(ball(hollow), "front", section=0.0, **AT_SIZE)
    assert len(drawing.lines) == len(middle.lines)
    for line, other in zip(drawing.lines, middle.lines, strict=True):
        assert line.points[[0, -1]] == pytest.approx(other.points[[0, -1]], abs=1e-4)


@pytest.mark.parametrize("beside", [0.0, 1e-15, -1e-12, 1e-8, -1e-6])
def test_corners_of_the_seam_that_differ_by_rounding(beside: float) -> None:
    """A bar through a ball divides its seam: its corners lie 1e-15 mm apart across the plane."""
    model = cq.Workplane().sphere(5).union(cq.Workplane().box(20, 3, 3))
    drawing = hlr.draw(model, "front", section=beside, **AT_SIZE)
    assert not drawing.notes
    half = np.arcsin(1.5 / 5.0)
    across = 2.0 * (25.0 * half + 1.5 * 5.0 * np.cos(half))  # of the bar within the ball
    assert measured_area(drawing) == pytest.approx(np.pi * 25.0 + 60.0 - across, rel=0.02)


def test_picture(picture):
    picture(hlr.draw(ball(True), "front", section=5e-6, **AT_SIZE))
