"""Shells that are not closed, as B-rep: their inside is seen, and back-face culling would tear holes into them.

Borders are drawn as such, from inside and outside alike. `hlr info` says that the part is open.
"""

from __future__ import annotations

import cadquery as cq
import pytest
from hard.brep import kinds, like, ring, turn

import hlr
from support.at_size import AT_SIZE
from support.expected import agrees, by_oracle, defects, expect
from support.meshes import BOX_EDGES, BOX_QUADS, box, split

LOW, HIGH = (0, 0, 0), (30, 20, 12)
LID = 5
"""The quad at z = HIGH is left out."""


def tray(turned=False):
    faces = cq.Solid.makeBox(30, 20, 12).faces("not >Z")
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Shell

    shell, builder = TopoDS_Shell(), BRep_Builder()
    builder.MakeShell(shell)
    for face in faces.Faces():
        builder.Add(shell, face.wrapped)
    return cq.Shape.cast(shell.Reversed() if turned else shell)


VIEWS = ["iso", "front", "bottom", (1, -2, 3), (1, 1, -1), (-0.3, 0.2, 1)]


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("view", VIEWS)
def test_a_box_without_lid(view, turned, picture):
    drawing = hlr.draw(tray(turned), view, **AT_SIZE)
    points = box(LOW, HIGH)[0]
    triangles = split([quad for i, quad in enumerate(BOX_QUADS) if i != LID])
    agrees(drawing, by_oracle(drawing, points, triangles, BOX_EDGES))
    assert ("boundary", True) in kinds(drawing) or view in ("bottom", (1, 1, -1))
    if view == "iso" and not turned:
        picture(drawing)


def test_its_defects():
    assert defects(tray()) == ["open: 4 border edges"]


def test_half_a_pipe_wall_seen_into():
    """A cylindrical wall alone: both rims whole or hidden by the wall itself, no caps."""
    wall = cq.Workplane().circle(10).extrude(20).faces("%CYLINDER").val()
    view = turn((0, -1, 0), (1, 0, 0), -30)
    drawing = hlr.draw(wall, view, **AT_SIZE)
    seen = [*ring(10, 20), *ring(10, 0, 180, 360), *(((x, 0, 0), (x, 0, 20)) for x in (10, -10))]
    like(drawing, expect(drawing, seen, ring(10, 0, 0, 180)))
    assert {kind for kind, _ in kinds(drawing)} == {"boundary", "outline"}
