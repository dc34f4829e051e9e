"""A section a millionth of a micrometre beside the seam of a bore in a block of a few tenths of a millimetre.

The end of the seam and the corner of the block there differ in the last digits. Beside the plane such points counted
as two, the block seemed open, and OpenCASCADE cut it.
"""

from __future__ import annotations

import cadquery as cq
import pytest

import hlr
from hlr.pipeline.section import sources
from support.at_size import ALL_LINES
from support.sections import measured_area


def block(share: float) -> cq.Shape:
    """share: of its usual size."""
    return cq.Workplane().box(40, 40, 10).faces(">Z").workplane().hole(12).val().scale(share)


@pytest.mark.parametrize("beside", [0.0, 1e-9, -1e-8])
@pytest.mark.parametrize("share", [0.01, 0.003, 0.001])
def test_the_kernel_cuts_it(monkeypatch, share: float, beside: float) -> None:
    monkeypatch.setattr(sources, "_left_of", None)
    drawing = hlr.draw(block(share), "front", section=beside, scale=1.0 / share, **ALL_LINES)
    assert not drawing.notes
    assert measured_area(drawing) / share**2 == pytest.approx(280.0, rel=0.05)
