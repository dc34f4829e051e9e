"""A cylinder whose curves in (u, v) lie a whole period beside one another: sound in space, no outline in (u, v).

(A sensor of SparkFun's KiCad libraries, which are CC-BY-4.0, has sixteen solder balls like that.) OpenCASCADE's mesher
leaves such a face empty, or pulls the ends of its polygons together right round the cylinder.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

import hlr
from hlr.source import open_source
from support.at_size import AT_SIZE
from support.brep_shapes import shifted_cylinder


def curves(solid):
    """The curves in (u, v) of the edges of a solid's faces: where they begin and end."""
    from OCP.BRepAdaptor import BRepAdaptor_Curve2d

    ends = []
    for face in solid.Faces():
        for edge in face.Edges():
            curve = BRepAdaptor_Curve2d(edge.wrapped, face.wrapped)
            for t in (curve.FirstParameter(), curve.LastParameter()):
                ends += [curve.Value(t).X(), curve.Value(t).Y()]
    return ends


BROKEN = [("top",), ("bottom",), ("seam", "top"), ("seam", "bottom")]


@pytest.mark.parametrize("moved", BROKEN)
def test_it_is_drawn_like_a_sound_one(moved):
    sound, drawing = (
        hlr.draw(shifted_cylinder(), "iso", **AT_SIZE),
        hlr.draw(shifted_cylinder(*moved), "iso", **AT_SIZE),
    )
    assert drawing.notes == ()
    assert sorted((line.kind, line.visible) for line in drawing.lines) == sorted(
        (line.kind, line.visible) for line in sound.lines
    )


@pytest.mark.parametrize("moved", BROKEN)
def test_it_becomes_a_closed_mesh_and_stays_what_it_was(moved):
    solid = shifted_cylinder(*moved)
    before = curves(solid)
    (part,) = open_source(solid).mesh(0.01, 0.2).parts
    a, b, c = (part.points[part.triangles[:, k]] for k in range(3))
    assert (a * np.cross(b, c)).sum() / 6 == pytest.approx(math.pi * 90, rel=0.01)
    assert np.bincount(part.edge_class).tolist() == [2, 0, 1]
    assert curves(solid) == before
