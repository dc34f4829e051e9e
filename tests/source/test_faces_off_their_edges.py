"""Faces that lie off their own edges in the model itself: no drawing is more exact there, and a note says so."""

from __future__ import annotations

import cadquery as cq
import pytest

import hlr
from support.at_size import AT_SIZE

RADIUS, HEIGHT, OFF = 10.0, 30.0, 0.02
CODE = "faces-off-edges"


def rod(changed: str = ""):
    """A rod. changed: its side has another radius ("side"), its upper rim has ("rim") or lies higher ("lid")."""
    from OCP.BRep import BRep_Builder, BRep_Tool
    from OCP.Geom import Geom_Circle
    from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt
    from OCP.TopLoc import TopLoc_Location

    made = cq.Workplane().circle(RADIUS).extrude(HEIGHT)
    if changed == "side":
        BRep_Tool.Surface_s(made.faces("%CYLINDER").val().wrapped).SetRadius(RADIUS + OFF)
    elif changed:
        higher, wider = (OFF, 0.0) if changed == "lid" else (0.0, OFF)
        circle = Geom_Circle(gp_Ax2(gp_Pnt(0, 0, HEIGHT + higher), gp_Dir(0, 0, 1)), RADIUS + wider)
        rim = made.faces(">Z").edges().val().wrapped
        BRep_Builder().UpdateEdge(rim, circle, TopLoc_Location(), 2 * OFF)
    return made


def notes(shape, accuracy: float, **more):
    return [note for note in hlr.draw(shape, "iso", accuracy=accuracy, **AT_SIZE, **more).notes if note.code == CODE]


# A rim that lies higher is still on the side, a wider one still on the lid.
@pytest.mark.parametrize(("changed", "face"), [("side", 0), ("rim", 0), ("lid", 2)])
def test_a_note_names_the_face_and_the_distance(changed, face):
    (note,) = notes(rod(changed), 0.01)
    assert f'face {face} of part "part"' in note.text and "up to 0.02 mm off its own edges" in note.text
    assert not note.is_warning


@pytest.mark.parametrize("changed", ["side", "rim", "lid"])
def test_where_it_does_not_show_there_is_no_note(changed):
    # Two faces beside one edge may be twice as far apart: half of the accuracy is the limit.
    assert notes(rod(changed), 2.1 * OFF) == [] and notes(rod(changed), 1.9 * OFF) != []


@pytest.mark.parametrize("accuracy", [0.05, 1e-4])
def test_a_sound_model_has_no_note(accuracy):
    assert notes(rod(), accuracy) == []
    assert notes(cq.Workplane().box(30, 20, 10).edges("|Z").fillet(3).faces(">Z").hole(5), accuracy) == []


def test_several_faces_are_one_note():
    both = [rod("side"), rod("lid"), rod()]
    (note,) = notes(both, 0.01)
    assert "2 faces lie up to 0.02 mm off their own edges (the farthest is face" in note.text
    # It is a remark: strict makes no error of it.
    assert notes(both, 0.01, strict=True) == [note]
