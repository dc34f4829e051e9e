"""A file of edges alone, as a sketch or a trajectory is exported: nothing can hide anything.

(asahi.brep of OpenCASCADE: 2,828 edges, no face.) It is refused by one sentence that says what is in the file and what
would help. The same edges beside a solid are left out with a note, and a wire alone in a file of a part is not missed.
"""

from __future__ import annotations

import cadquery as cq
import pytest
from hard.brep import compound

import hlr
from hlr.drawing.notes import Note
from support.at_size import AT_SIZE


def edges(count=28):
    return [cq.Edge.makeLine(cq.Vector(i, 0, 0), cq.Vector(i, 10, i * i / 10)) for i in range(count)]


@pytest.mark.parametrize("suffix", [".brep", ".step"])
def test_a_file_of_edges_is_refused(tmp_path, suffix):
    path = tmp_path / f"sketch{suffix}"
    shape = compound(*edges())
    shape.exportBrep(str(path)) if suffix == ".brep" else shape.exportStep(str(path))
    for call in (hlr.draw, hlr.info):
        with pytest.raises(hlr.SourceError) as refused:
            call(path)
        (sentence,) = str(refused.value).splitlines()
        assert "28 edges but no faces" in sentence and path.name in sentence


def test_beside_a_solid_they_are_left_out_with_a_note(picture):
    assembly = cq.Assembly()
    assembly.add(cq.Workplane().box(20, 20, 20), name="box").add(compound(*edges(3)), name="path")
    drawing = hlr.draw(assembly, "iso", **AT_SIZE)
    assert drawing.notes == (Note("wires-left-out", 'Part "path" without faces (3 edges) left out.'),)
    assert {drawing.parts[line.part].name for line in drawing.lines} == {"box"}
    assert len(drawing.lines) == 12
    picture(drawing)
