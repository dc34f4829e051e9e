"""A real screw with its thread modelled: helical B-spline faces that hide themselves turn by turn.

OpenCASCADE's exact algorithm draws a third of the samples of its visible lines wrong here. The referee casts rays
against its own mesh of the file: not one sample may be wrong, and no visible edge may be missing.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hard.brep import faultless

import hlr
from support.at_size import ALL_LINES
from support.referee import reference

UNDER_THE_HEAD = 16
"""The edge at which the cone of the head meets the flank of the thread."""
SCREW = Path(__file__).parents[1] / "data" / "M6-1x12-countersunk-screw.step"


@pytest.mark.slow
def test_not_one_sample_is_wrong():
    count = 0
    for drawing in faultless(SCREW, reference.read_shape(SCREW), ["front", "iso", "top", (0.36, 0.86, 0.35)]):
        assert len(drawing.lines) > 20
        count += 1
    assert count == 4


@pytest.mark.slow
def test_coarsely_drawn_an_edge_is_seen_as_far_as_its_outline_goes_on():
    """The edge under the head is concave: it is hidden from where the cone turns away and its outline begins."""
    (drawing,) = faultless(SCREW, reference.read_shape(SCREW), ["iso"], 533)
    ends = np.array([line.points[k] for line in drawing.visible if line.kind == "outline" for k in (0, -1)])
    under = np.array([line.points[k] for line in drawing.visible if line.edge == UNDER_THE_HEAD for k in (0, -1)])
    gaps = np.linalg.norm(under[:, None] - ends[None], axis=2).min(axis=1)
    assert gaps.min() < 0.05 * drawing.accuracy.used


@pytest.mark.slow
def test_it_is_as_large_on_paper_as_the_model():
    """The outermost line is the outline of the thread or the head, and ends where the solid does."""
    points = reference.from_shape(reference.read_shape(SCREW), 2000).points
    for view, axes in (("front", [0, 2]), ("top", [0, 1])):
        drawing = hlr.draw(SCREW, view, scale=2, **ALL_LINES)
        x0, y0, x1, y1 = drawing.bounds
        width, height = 2 * np.ptp(points[:, axes], axis=0)
        assert (x1 - x0, y1 - y0) == pytest.approx((width, height), abs=0.05)


@pytest.mark.slow
def test_picture(picture):
    picture(hlr.draw(SCREW, "iso", fit=(40, 40), accuracy=0.1, **ALL_LINES), twice=20.0, step=1.0)
