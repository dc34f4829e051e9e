"""A circle seen nearly edge-on: an ellipse ten thousand times longer than wide.

SVG writes an arc by its two ends, its radii and a rotation, all rounded, and a renderer computes the centre from them.
Here half a step across the ellipse, of which it is a few steps wide, moves the centre by tenths of a millimetre along
it, and one of the two turns lies that far beyond the true one. Where no arc of SVG fits, it must be another curve.
"""

from __future__ import annotations

import math

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.lab.measure.written import written
from support.at_size import AT_SIZE

RADIUS = 9.2306


def quarters():
    """A disc whose rim is four arcs; each ends where a wall meets it."""
    disc = cq.Workplane().circle(RADIUS).extrude(12)
    return disc.cut(cq.Workplane().center(0, 0).rect(40, 2).extrude(6)).cut(cq.Workplane().rect(2, 40).extrude(6))


@pytest.mark.parametrize("accuracy", [0.05, 0.01])
@pytest.mark.parametrize("tilt", [1e-5, 1e-4, 2.6e-4, 1e-3, 5e-3, 0.02])
@pytest.mark.parametrize("cubic", [False, True], ids=["svg", "pdf"])
def test_no_arc_reaches_beyond_its_circle(tilt, accuracy, cubic):
    for turned in (0.0, 0.3, 0.8):
        direction = (math.cos(turned), math.sin(turned), tilt)
        drawing = hlr.draw(quarters(), direction, accuracy=accuracy, **AT_SIZE)
        of_rims = np.array([line.edge is not None and np.ptp(line.points3[:, 2]) < 1e-6 for line in drawing.lines])
        form = written(drawing, cubic=cubic)
        points = form.points[of_rims[form.line]] + np.array(drawing.origin)
        # Across the sight no point of a rim lies farther out than its radius.
        assert len(points) and np.abs(points[:, 0]).max() <= RADIUS + 0.5 * accuracy
        # And each rim reaches as far as its own points in space.
        for number in np.flatnonzero(of_rims):
            line, own = drawing.lines[number], form.points[form.line == number] + np.array(drawing.origin)
            true = line.points3 @ np.array(drawing.view.right)
            assert own[:, 0].min() == pytest.approx(true.min(), abs=accuracy)
            assert own[:, 0].max() == pytest.approx(true.max(), abs=accuracy)
