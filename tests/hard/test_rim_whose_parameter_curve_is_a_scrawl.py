"""A cylinder one of whose rims has, in (u, v) of the side, a curve that has nothing to do with it and crosses itself.

In space all is sound, but the outline in (u, v) encloses nothing: our mesher gives the side up. OpenCASCADE's meshes it
on a copy whose curves in (u, v) were found anew; the rims and the discs stay as they are. A remark says so.
"""

from __future__ import annotations

import json
import math
import subprocess
import sys

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.drawing.notes import Note
from hlr.source import open_source
from support.at_size import ALL_LINES, AT_SIZE
from support.brep_shapes import scrawled_cylinder

NOTE = Note("faces-mended", 'Part "part": 1 of 3 faces was meshed by OpenCASCADE (face 0).')
EFFECT = "rescue of faces"


def test_it_is_drawn_like_a_sound_one():
    sound, drawing = (
        hlr.draw(cq.Workplane().cylinder(10, 3), "iso", **AT_SIZE),
        hlr.draw(scrawled_cylinder()[0], "iso", **AT_SIZE),
    )
    assert drawing.notes == (NOTE,) and sound.notes == ()

    def told(drawing):
        return sorted((line.kind, line.visible, sorted(line.points[[0, -1]].tolist())) for line in drawing.lines)

    for one, other in zip(told(drawing), told(sound), strict=True):
        # Where the hidden half of the rim begins, its curve runs along the outline.
        assert one[:2] == other[:2] and np.allclose(one[2], other[2], atol=0.3)


def test_it_becomes_a_closed_mesh_on_its_surface():
    (part,) = open_source(scrawled_cylinder()[0]).mesh(0.01, 0.2).parts
    a, b, c = (part.points[part.triangles[:, k]] for k in range(3))
    assert (a * np.cross(b, c)).sum() / 6 == pytest.approx(math.pi * 90, rel=0.01)
    middle = ((a + b + c) / 3)[part.triangle_face == 0]
    assert np.abs(np.hypot(middle[:, 0], middle[:, 1]) - 3).max() < 0.03


@pytest.mark.slow
def test_what_was_rescued_is_counted_and_told():
    sound, drawing = hlr.draw(cq.Workplane().cylinder(10, 3), **AT_SIZE), hlr.draw(scrawled_cylinder()[0], **AT_SIZE)
    assert [drawing.counters[name] for name in ("rescued_faces", "lost_faces")] == [1, 0]
    assert [sound.counters[name] for name in ("rescued_faces", "lost_faces")] == [0, 0]
    (row,) = (d for d in drawing.plan if d.name == EFFECT)
    assert row.on and row.counts == {"rescued_faces": 1, "lost_faces": 0}
    assert row.reason == "the kernel could not mesh 1 face: OpenCASCADE tries"
    (row,) = (d for d in sound.plan if d.name == EFFECT)
    assert not row.on and row.reason == "the kernel has meshed every face"
    assert hlr.info(scrawled_cylinder()[0]).notes == (NOTE,)
    # Once, though its scale is found only after a first mesh, at which it was rescued, too.
    assert hlr.draw(scrawled_cylinder()[0], fit=(20, 20), **ALL_LINES).counters["rescued_faces"] == 1


def test_it_is_a_remark_and_no_warning():
    assert not NOTE.is_warning
    assert hlr.draw(scrawled_cylinder()[0], strict=True, **AT_SIZE).notes == (NOTE,)


@pytest.mark.slow
def test_the_caller_s_shape_stays_as_it_is():
    from OCP.BRep import BRep_Tool
    from OCP.BRepAdaptor import BRepAdaptor_Curve2d
    from OCP.TopLoc import TopLoc_Location

    solid, side = scrawled_cylinder()

    def curves():
        found = [BRepAdaptor_Curve2d(edge.wrapped, side) for edge in cq.Shape.cast(side).Edges()]
        values = [c.Value(t) for c in found for t in (c.FirstParameter(), 0.3, c.LastParameter())]
        return [(p.X(), p.Y()) for p in values]

    before = curves()
    hlr.draw(solid, **AT_SIZE)
    assert curves() == before
    assert [BRep_Tool.Triangulation_s(face.wrapped, TopLoc_Location()) for face in solid.Faces()] == [None] * 3


@pytest.mark.slow
def test_the_command_tells_all_this(tmp_path):
    scrawled_cylinder()[0].exportBrep(str(tmp_path / "part.brep"))

    def command(*arguments):
        words = [sys.executable, "-P", "-m", "hlr", *arguments]
        return subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=True, timeout=120)

    done = command("draw", "part.brep", "-o", "part.json", "--strict", "--explain")
    assert f"hlr: note: {NOTE.text}" in done.stderr.splitlines()
    (row,) = (line for line in (done.stdout + done.stderr).splitlines() if line.startswith(EFFECT))
    assert "1 rescued faces" in row
    document = json.loads((tmp_path / "part.json").read_text())
    assert document["notes"] == [NOTE.as_dict()]
    assert document["counters"]["rescued_faces"] == 1 and document["counters"]["lost_faces"] == 0
    done = command("info", "part.brep")
    assert NOTE.text in done.stdout + done.stderr
    assert json.loads(command("info", "part.brep", "--json").stdout)["notes"] == [NOTE.as_dict()]


@pytest.mark.parametrize("loose", [False, True])
def test_behind_the_plane_of_a_section_it_is_mended_as_well(loose):
    """As a solid, and as faces that are placed within their part: there, too, the mended face has its part's frame."""
    scrawl, place = scrawled_cylinder()[0], cq.Location(cq.Vector(20, 20, 0), cq.Vector(1, 1, 0), 40.0)
    body = cq.Compound.makeCompound([face.moved(place) for face in scrawl.Faces()]) if loose else scrawl.moved(place)
    parts = cq.Assembly().add(cq.Workplane().box(10, 10, 10), name="box").add(body, name="scrawl")
    drawing = hlr.draw(parts, "front", section=0, scale=1)
    assert [part.name for part in drawing.parts] == ["box", "scrawl"]
    assert [drawing.parts[k].name for k in drawing.section.parts] == ["box"]
    (note,) = drawing.notes
    assert note.text.startswith('Part "scrawl": 1 of 3 faces was meshed by OpenCASCADE')
