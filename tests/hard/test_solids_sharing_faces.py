"""Solids that share a face, as a general fuse leaves them: four faces meet at the edges of the common one.

Each edge belongs to more than two faces, and to two solids; drawn once, and the common face hides nothing of its own
rim.
"""

from __future__ import annotations

import cadquery as cq
import pytest
from hard.brep import box_edges, kinds, like

import hlr
from support.at_size import AT_SIZE
from support.expected import defects, expect

LEFT = ((0, 0, 0), (10, 10, 10))
RIGHT = ((10, 0, 0), (25, 10, 10))
VIEW = (1, -2, 1.5)


def shared():
    from OCP.BOPAlgo import BOPAlgo_Builder
    from OCP.TopTools import TopTools_ListOfShape

    builder, arguments = BOPAlgo_Builder(), TopTools_ListOfShape()
    for low, high in (LEFT, RIGHT):
        size = [b - a for a, b in zip(low, high, strict=True)]
        arguments.Append(cq.Solid.makeBox(*size, cq.Vector(*low)).wrapped)
    builder.SetArguments(arguments)
    builder.Perform()
    return cq.Shape.cast(builder.Shape())


def test_there_is_one_common_face():
    assert len(shared().Solids()) == 2
    faces = {face.hashCode() for face in shared().Faces()}
    assert len(faces) == 11


@pytest.mark.parametrize("view", [VIEW, "front"])
def test_each_edge_once(view, picture):
    drawing = hlr.draw(shared(), view, **AT_SIZE)
    direction = drawing.view.direction
    seen, unseen = box_edges(*LEFT, direction)
    more, hidden = box_edges(*RIGHT, direction)
    inner = [e for e in seen if all(p[0] == 10 for p in e) and all(p[1] == 10 or p[2] == 0 for p in e)]
    like(drawing, expect(drawing, [e for e in seen if e not in inner] + more, unseen + hidden + inner))
    assert {kind for kind, _ in kinds(drawing)} == {"sharp"}
    if view == VIEW:
        picture(drawing)


def test_its_defects():
    assert all("open" not in text and "inside out" not in text for text in defects(shared()))
