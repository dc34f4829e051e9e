"""A file or an object of edges alone, as a sketch or a trajectory is exported: nothing can hide anything.

(asahi.brep of OpenCASCADE: 2,828 edges, no face.) The edges are drawn as they are, from a file as from memory. A
preview needs faces, and says so in one sentence. The same edges beside a solid are left out with a note, and a wire
alone in a file of a part is not missed.
"""

from __future__ import annotations

from itertools import pairwise

import cadquery as cq
import pytest
from hard.brep import arc, compound, like, ring
from OCP.BRep import BRep_Builder
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeVertex
from OCP.Geom import Geom_Line
from OCP.gp import gp_Dir, gp_Pnt
from OCP.TopAbs import TopAbs_FORWARD, TopAbs_REVERSED
from OCP.TopoDS import TopoDS_Edge

import hlr
from hlr.drawing.notes import Note
from support.at_size import AT_SIZE
from support.expected import agrees, expect


def edges(count=28):
    return [cq.Edge.makeLine(cq.Vector(i, 0, 0), cq.Vector(i, 10, i * i / 10)) for i in range(count)]


def path_and_circles():
    """Three sides of a square that is tilted, a circle about it, and one that stands on end."""
    square = cq.Wire.makePolygon([cq.Vector(*p) for p in SQUARE])
    return [square, cq.Edge.makeCircle(9), cq.Edge.makeCircle(4, cq.Vector(0, 0, 6), cq.Vector(0, 1, 0))]


SQUARE = [(-5, -5, 0), (5, -5, 0), (5, 5, 3), (-5, 5, 3)]


@pytest.mark.parametrize("suffix", ["", ".brep", ".step"])
def test_edges_alone_are_drawn(tmp_path, suffix):
    shape = compound(*edges())
    source = shape
    if suffix:
        source = tmp_path / f"sketch{suffix}"
        shape.exportBrep(str(source)) if suffix == ".brep" else shape.exportStep(str(source))
    for view in ("iso", "top", (2, 1, -1.3)):
        drawing = hlr.draw(source, view, **AT_SIZE)
        agrees(drawing, expect(drawing, visible=[((i, 0, 0), (i, 10, i * i / 10)) for i in range(28)]))
    assert sum(part.edges for part in hlr.info(source).parts) == 28


@pytest.mark.parametrize("view", ["iso", "top", (2, 1, -1.3)])
def test_nothing_hides_a_path(view):
    drawing = hlr.draw(path_and_circles(), view, **AT_SIZE)
    like(drawing, expect(drawing, [*pairwise(SQUARE), *ring(9), *arc((0, 0, 6), (4, 0, 0), (0, 0, 4))]))
    assert {line.visible for line in drawing.lines} == {True}


def test_lines_of_a_script(tmp_path):
    path = tmp_path / "sketch.py"
    path.write_text("import cadquery as cq\nresult = cq.Workplane('XZ').lineTo(10, 0).lineTo(10, 5).close()\n")
    drawing = hlr.draw(path, "front", **AT_SIZE)
    corners = [(0, 0, 0), (10, 0, 0), (10, 0, 5), (0, 0, 0)]
    agrees(drawing, expect(drawing, visible=pairwise(corners)))


def test_a_preview_needs_faces():
    with pytest.raises(hlr.SourceError) as refused:
        hlr.preview(compound(*edges()), "iso")
    (sentence,) = str(refused.value).splitlines()
    assert "edges but no faces" in sentence


def test_beside_a_solid_they_are_left_out_with_a_note(picture):
    assembly = cq.Assembly()
    assembly.add(cq.Workplane().box(20, 20, 20), name="box").add(compound(*edges(3)), name="path")
    drawing = hlr.draw(assembly, "iso", **AT_SIZE)
    assert drawing.notes == (Note("wires-left-out", 'Part "path" without faces (3 edges) left out.'),)
    assert {drawing.parts[line.part].name for line in drawing.lines} == {"box"}
    assert len(drawing.lines) == 12
    picture(drawing)


def an_edge_without_length():
    line = Geom_Line(gp_Pnt(0, 0, 0), gp_Dir(1, 0, 0))
    ends = [BRepBuilderAPI_MakeVertex(gp_Pnt(0, 0, 0)).Vertex() for _ in range(2)]
    edge, builder = TopoDS_Edge(), BRep_Builder()
    builder.MakeEdge(edge, line, 1e-7)
    builder.Add(edge, ends[0].Oriented(TopAbs_FORWARD))
    builder.Add(edge, ends[1].Oriented(TopAbs_REVERSED))
    builder.Range(edge, 0.0, 0.0)
    return cq.Edge(edge)


@pytest.mark.parametrize("done", [hlr.info, hlr.draw])
def test_one_without_length_is_refused(done):
    with pytest.raises(hlr.SourceError, match="has no size: all of it lies in one point"):
        done(an_edge_without_length())
