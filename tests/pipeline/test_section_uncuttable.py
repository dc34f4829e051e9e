"""Parts that OpenCASCADE cannot cut stay whole in a section, and a warning names them."""

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.errors import SourceError, StrictError
from hlr.source.cad import half_space
from support.brep_shapes import bare_triangles
from support.sections import hatch_of, hatched_area, opencascade_cuts, outlines_of, section


def row(*bodies):
    """Bodies side by side, 40 mm apart."""
    assembly = cq.Assembly()
    for k, body in enumerate(bodies):
        assembly.add(body, name=f"body{k}", loc=cq.Location(cq.Vector(40 * k, 0, 0)))
    return assembly


def cube():
    return cq.Workplane().box(20, 20, 20)


def bare():
    """A block whose faces are triangles alone."""
    return cq.Shape.cast(bare_triangles(cq.Workplane().box(10, 30, 20).val().wrapped))


def not_cut(drawing):
    return [note for note in drawing.notes if note.code == "section-not-cut"]


def test_it_stays_whole_as_with_uncut():
    drawing = section(row(cube(), bare()))
    (note,) = not_cut(drawing)
    assert note.is_warning
    assert note.text == (
        'section front: "body1" stays whole, because its faces are triangles without surfaces: export it as a solid or '
        "as a mesh, or name it in uncut."
    )
    asked = section(row(cube(), bare()), uncut=("body1",))
    assert not not_cut(asked)
    assert drawing.lines == asked.lines and drawing.section == asked.section
    assert [drawing.parts[k].name for k in drawing.section.parts] == ["body0"]
    assert hatched_area(drawing, 2.0) == pytest.approx(400.0, rel=0.05)


def test_it_hides_the_hatch_behind_it():
    hidden = cq.Assembly().add(cq.Workplane().box(60, 10, 40), name="plate").add(bare(), name="post")
    x, y = (hatch_of(section(hidden)).reshape(-1, 2) - [30.0, 20.0]).T
    assert not ((np.abs(x) < 5 - 1e-6) & (np.abs(y) < 10 - 1e-6)).any() and (np.abs(x) < 6).any()


def test_warnings_are_errors_where_that_is_asked_for():
    with pytest.raises(StrictError, match='section front: "body1" stays whole, because its faces are triangles'):
        section(row(cube(), bare()), strict=True)
    assert section(row(cube(), bare()), strict=True, uncut=("body1",)).section.parts == (0,)


def test_where_no_part_can_be_cut_the_section_is_refused():
    with pytest.raises(SourceError, match='"body0" cannot be cut by the plane of a section, because its faces are'):
        section(row(bare(), bare()))


def test_equal_parts_are_tried_once_and_named_in_one_note(monkeypatch):
    tried, cut_away = [], half_space.cut_away

    def fails_with_balls(leaves, *plane):
        tried.append(leaves[0].name)
        if len(list(cq.Shape.cast(leaves[0].shape).Faces())) == 1:
            raise half_space.UncuttableError(leaves[0].name, "its shape is not sound", "move the plane a little")
        return cut_away(leaves, *plane)

    opencascade_cuts(monkeypatch)
    monkeypatch.setattr(half_space, "cut_away", fails_with_balls)
    ball = cq.Workplane().sphere(10)
    drawing = section(row(ball, cube(), ball, ball))
    assert tried == ["body0", "body1"]
    (note,) = not_cut(drawing)
    assert note.text == (
        'section front: "body0" stays whole, because its shape is not sound (2 more parts likewise): move the plane a '
        "little, or name it in uncut."
    )
    assert [part.name for part in drawing.parts] == ["body0", "body1", "body2", "body3"]
    assert drawing.section.parts == (1,)
    assert outlines_of(drawing) == outlines_of(section(row(ball, cube(), ball, ball), uncut=("body[023]",)))


def test_views_and_pages_say_it_of_each_section():
    options = hlr.Options(section={"front": True, "top": True})
    early = []
    from hlr.pipeline.draw import draw_views

    drawings = draw_views(row(cube(), bare()), ["front", "iso", "top"], options, noted=early.extend)
    named = [[note.text.partition(":")[0] for note in not_cut(drawing)] for drawing in drawings]
    assert named == [["section front"], [], ["section top"]]
    assert [note.text for note in early] == [note.text for each in drawings for note in not_cut(each)]
    page = hlr.draw_arranged(row(cube(), bare()), options=options)
    assert [note.text.partition(":")[0] for note in not_cut(page)] == ["section front", "section top"]


@pytest.mark.parametrize("kinds", [["Compound"], ["Compound", "Shell"]])
def test_faces_that_cannot_be_cut_together_are_cut_shell_by_shell_or_each_alone(monkeypatch, kinds):
    open_box = cq.Shell.makeShell(cube().faces("not >Z").vals())
    sheets = cq.Compound.makeCompound([open_box, *cube().translate((30, 0, 0)).faces("not >Z").vals()])
    wanted = outlines_of(section(sheets))
    together = half_space._cut

    def cut(shape, planes, origin, name):
        if cq.Shape.cast(shape).ShapeType() in kinds:
            raise half_space.UncuttableError(name, "its shape is not sound", "move the plane a little")
        return together(shape, planes, origin, name)

    monkeypatch.setattr(half_space, "_cut", cut)
    drawing = section(sheets)
    assert not not_cut(drawing)
    assert outlines_of(drawing) == wanted
