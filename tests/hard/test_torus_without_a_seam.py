"""A torus that has lost one of its two seams: its outline in (u, v) does not close.

OpenCASCADE's mesher fills a strip of no width with triangles, all of which join the two sides of the seam: in (u, v)
they look sound, in space nothing is there. Such triangles are no face: the face is missing, and that is said.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.drawing.notes import Note

NOTE = Note("not-meshed", 'Part "part:2": 1 of 1 faces could not be meshed (face 0).')


def torn():
    """Radii 6 and 2."""
    from OCP.BRepTools import BRepTools_ReShape

    torus, tear = cq.Solid.makeTorus(6, 2), BRepTools_ReShape()
    tear.Remove(torus.Edges()[0].wrapped)
    return cq.Shape.cast(tear.Apply(torus.wrapped))


def test_it_is_missing_or_whole():
    """If ever the outline is closed for it, all of it must be there."""
    box = cq.Workplane().box(2, 2, 2).val()
    drawing = hlr.draw(
        cq.Workplane(obj=cq.Compound.makeCompound([box, torn()])), "top", hidden=False, scale=1.0, smooth=False
    )
    if drawing.counters["lost_faces"]:
        assert NOTE in drawing.notes
        assert {line.part for line in drawing.lines} == {0}
    else:
        reach = np.abs(np.concatenate([line.points for line in drawing.lines if line.part == 1])).max()
        assert reach == pytest.approx(8 * drawing.scale, abs=0.1)


def test_nothing_but_it_is_refused_or_drawn():
    try:
        drawing = hlr.draw(torn(), "top", hidden=False, scale=1.0, smooth=False)
    except hlr.SourceError as error:
        assert "none of its faces could be meshed" in str(error)
    else:
        assert sum(line.kind == "outline" for line in drawing.lines) >= 2
