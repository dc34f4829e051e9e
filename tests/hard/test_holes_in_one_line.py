"""A planar face with a row of holes: corners of three of them lie in one line but for rounding.

The triangle between such corners is a needle that is turned any way. Its side was drawn as an outline of the fillet
beside the face, from hole to hole.
"""

from __future__ import annotations

from pathlib import Path

import pytest

import hlr

MODEL = Path(__file__).parents[2] / "examples" / "models" / "nist_ftc_06_asme1_ap242-e2.stp"


@pytest.mark.slow
@pytest.mark.parametrize("accuracy", [0.1, 0.2])
def test_no_outline_runs_from_hole_to_hole(accuracy):
    pytest.importorskip("OCP")
    drawing = hlr.draw(MODEL, "iso-ne", fit=(240, 180), accuracy=accuracy, hidden=False, smooth=False)
    outlines = [line for line in drawing.lines if line.kind == "outline"]
    assert outlines, "fillets have outlines"
    top = 180
    assert not [line for line in outlines if line.face == top]
