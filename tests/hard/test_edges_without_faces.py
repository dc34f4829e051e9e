"""A file or an object of edges alone, as a sketch or a trajectory is exported: nothing can hide anything.

(asahi.brep of OpenCASCADE: 2,828 edges, no face.) The edges are drawn as they are, from a file as from memory. A
preview needs faces, and says so in one sentence. Edges that a caller gives beside a solid are drawn, and hidden by it;
those of a file, its construction lines and axes, are left out with a note.
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


ROD = [(-20, 3, 2), (-10, 3, 2), (10, 3, 2), (20, 3, 2)]
"""A straight path through a cube of 20, and the points where it enters and leaves it."""


def cube_and_path():
    ends = [cq.Vector(*ROD[k]) for k in (0, -1)]
    return cq.Workplane().box(20, 20, 20).val(), cq.Edge.makeLine(*ends)


def as_list(tmp_path):
    return list(cube_and_path())


def as_compound(tmp_path):
    return compound(*cube_and_path())


def as_assembly(tmp_path):
    cube, path = cube_and_path()
    return cq.Assembly().add(cube, name="cube").add(path, name="path")


def as_script(tmp_path):
    script = tmp_path / "rod.py"
    script.write_text(
        "import cadquery as cq\n"
        "show_object(cq.Workplane().box(20, 20, 20))\n"
        f"show_object(cq.Edge.makeLine(cq.Vector{ROD[0]}, cq.Vector{ROD[-1]}))\n"
    )
    return script


@pytest.mark.parametrize("given", [as_list, as_compound, as_assembly, as_script])
def test_those_of_a_caller_are_drawn_beside_a_solid(given, tmp_path, picture):
    drawing = hlr.draw(given(tmp_path), "front", **AT_SIZE)
    assert not [note for note in drawing.notes if note.is_warning]
    before, within, behind = pairwise(ROD)
    square = [(-10, -10, -10), (10, -10, -10), (10, -10, 10), (-10, -10, 10), (-10, -10, -10)]
    agrees(drawing, expect(drawing, visible=[before, behind, *pairwise(square)], hidden=[within]))
    picture(hlr.draw(given(tmp_path), "iso", **AT_SIZE))


def test_those_of_a_file_are_left_out_with_a_note(tmp_path):
    as_assembly(tmp_path).export(str(tmp_path / "rod.step"))
    drawing = hlr.draw(tmp_path / "rod.step", "iso", **AT_SIZE)
    assert drawing.notes == (Note("wires-left-out", 'Part "path" without faces (1 edge) left out.'),)
    assert {drawing.parts[line.part].name for line in drawing.lines} == {"cube"}
    assert len(drawing.lines) == 12


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
