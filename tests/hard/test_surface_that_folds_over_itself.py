"""A face at 7 mm from a wavy surface whose smallest radius is 5 mm: it folds over itself, and jumps where
the surface has no normal. No mesher keeps a chord error there: the face is drawn as it is, and a warning says so."""

from __future__ import annotations

import math

import cadquery as cq
import pytest
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
from OCP.Geom import Geom_BSplineSurface, Geom_OffsetSurface
from OCP.gp import gp_Pnt
from OCP.TColgp import TColgp_Array2OfPnt
from OCP.TColStd import TColStd_Array1OfInteger, TColStd_Array1OfReal

import hlr


def spline(poles: list[list[tuple[float, float, float]]]) -> Geom_BSplineSurface:
    """A bicubic surface with these poles, four or more in each direction, and even knots."""
    counts = (len(poles), len(poles[0]))
    net = TColgp_Array2OfPnt(1, counts[0], 1, counts[1])
    for i, row in enumerate(poles, 1):
        for j, pole in enumerate(row, 1):
            net.SetValue(i, j, gp_Pnt(*pole))
    axes = []
    for count in counts:
        spans = count - 3
        knots, repeated = TColStd_Array1OfReal(1, spans + 1), TColStd_Array1OfInteger(1, spans + 1)
        for k in range(spans + 1):
            knots.SetValue(k + 1, k / spans)
            repeated.SetValue(k + 1, 4 if k in (0, spans) else 1)
        axes.append((knots, repeated))
    (u, mu), (v, mv) = axes
    return Geom_BSplineSurface(net, u, v, mu, mv, 3, 3)


def face(surface: object) -> cq.Face:
    return cq.Face(BRepBuilderAPI_MakeFace(surface, 1e-6).Face())


def doubled_back() -> Geom_BSplineSurface:
    """A sheet, 40 x 40, one row of whose poles goes back over the row before it: it has no normal there."""
    xs = [-20, -12, -4, 6, -6, 4, 12, 20]
    ys = [-20, -12, -4, 4, 12, 20]
    return spline([[(x, y, 5 * math.cos(x / 5) * math.sin(y / 5)) for y in ys] for x in xs])


@pytest.mark.parametrize("view", ["top", "iso"])
def test_it_is_drawn_and_a_warning_says_how_far_it_may_be_off(view):
    drawing = hlr.draw(face(Geom_OffsetSurface(doubled_back(), 7.0)), view=view)
    (note,) = [note for note in drawing.notes if note.code == "surfaces-torn"]
    assert note.is_warning and note.text.endswith("mm off there (face 0).")
    assert (drawing.counters["rescued_faces"], drawing.counters["lost_faces"]) == (0, 0)
    assert 1_000 < drawing.counters["triangles"] < 500_000
    assert {line.edge for line in drawing.lines if line.visible} >= {0, 1, 2, 3}


def test_without_a_distance_it_keeps_its_chord_error():
    drawing = hlr.draw(face(doubled_back()), view="iso")
    assert "surfaces-torn" not in {note.code for note in drawing.notes}
    assert drawing.counters["rescued_faces"] == 0
