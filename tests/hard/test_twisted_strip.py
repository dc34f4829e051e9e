"""A flank of a cross recess: a strip between two straight sides that do not lie in one plane, wide at one end alone.

Its sides are single chords, and no triangle beside such a chord keeps the chord error. The chords are divided until one
does; otherwise the face is left to OpenCASCADE, which has to be imported for it.
"""

from __future__ import annotations

import cadquery as cq
import pytest

import hlr

WIDE = [(4.16667, -0.83333, 6.0), (4.44444, -0.83333, 6.0), (4.72222, -0.83333, 6.0), (5.0, -0.83333, 6.0)]
NARROW = [(0.5026, -0.10052, 0.12), (0.50783, -0.0958, 0.12), (0.51308, -0.09109, 0.12), (0.51834, -0.08639, 0.12)]


@pytest.mark.parametrize("scale", [1, 2, 5, 10, 20, 50, 100])
def test_the_kernel_meshes_it(scale):
    ends = [cq.Edge.makeBezier([cq.Vector(*p) for p in poles]) for poles in (WIDE, NARROW)]
    drawing = hlr.draw(cq.Face.makeRuledSurface(*ends), "iso", scale=scale, details=True)
    assert not {note.code for note in drawing.notes} & {"not-meshed", "faces-mended"}
    assert len(drawing.visible) >= 4
