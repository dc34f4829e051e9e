"""A section through both poles of a ball, or beside them by rounding alone, the seam in the middle of what is left.

At a pole the seam and both halves of the rim meet, and each could go on as any other. The ball was cut by OpenCASCADE,
or open, or not hatched.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.pipeline.section import sources
from support.at_size import AT_SIZE
from support.sections import measured_area

BESIDE = [0.0, 1e-16, 3e-16, 1e-15, -1e-12, 1e-9, 1e-7, -3.5e-7, 5e-7, -5e-7, 9e-7, -9e-7, 1e-6, -1e-6, 1e-5, -1e-5]


@pytest.mark.parametrize("beside", BESIDE)
@pytest.mark.parametrize("view", ["left", "right", "back"])
@pytest.mark.parametrize("radius", [2.6, 10.0])
def test_it_is_hatched_and_sound(radius: float, view: str, beside: float) -> None:
    drawing = hlr.draw(cq.Workplane().sphere(radius), view, section=beside, **AT_SIZE)
    assert not drawing.notes
    assert measured_area(drawing) == pytest.approx(np.pi * radius**2, rel=0.06)
    assert sum(line.kind == "sharp" for line in drawing.lines) <= 2


@pytest.mark.parametrize("beside", BESIDE)
def test_opencascade_is_not_asked(monkeypatch, beside: float) -> None:
    monkeypatch.setattr(sources, "_left_of", None)
    assert hlr.draw(cq.Workplane().sphere(2.6), "left", section=beside, **AT_SIZE).lines


def test_picture(picture):
    picture(hlr.draw(cq.Workplane().sphere(2.6), "left", section=-9e-7, **AT_SIZE))
