"""CAD objects and meshes in one list or dict: names, and what drawings, sections and previews show."""

from __future__ import annotations

import numpy as np
import pytest

import hlr
import hlr.source.joined
from hlr.errors import OptionError, SourceError
from hlr.source import open_source
from support.missing_ink import missing, visible_segments

cq = pytest.importorskip("cadquery")
trimesh = pytest.importorskip("trimesh")


def box(x=0.0):
    return cq.Workplane().box(20, 20, 10).translate((x, 0, 0))


def post(z=10.0, x=0.0):
    """A square post of a mesh, from z - 5 to z + 5."""
    made = trimesh.creation.box((6, 6, 10))
    made.apply_translation((x, 0, z))
    return made


@pytest.mark.parametrize(
    ("thing", "names"),
    [
        (lambda: [box(), post()], ["part", "part:2"]),
        (lambda: [post(), box(), None, box(40)], ["part", "part:2", "part:3"]),
        (lambda: {"post": post(), "box": box()}, ["box", "post"]),
        (
            lambda: {"box": box(), "of": {"a": post(), "b": box(40)}, "box:2": post(30)},
            ["box", "of/b", "of/a", "box:2"],
        ),
        (lambda: {"a": [box(), (post().vertices, post().faces)]}, ["a", "a:2"]),
        (lambda: [cq.Workplane(), post()], ["part"]),
    ],
)
def test_all_parts_have_names_of_their_own(thing, names):
    source = open_source(thing())
    assert source.names() == names == [info.name for info in source.infos()]
    assert len(source.boxes()) == len(names)


def test_what_is_left_out_is_said():
    source = open_source({"box": box(), "post": post(), "seal": None, "bad": ([[0, 0, 0]] * 3, [[0, 1, 2]])})
    assert source.names() == ["box", "post"]
    assert [note.text for note in source.notes] == [
        'Part "seal" is None and was left out.',
        "1 degenerate triangle (two corners in one place) was left out.",
        'Part "bad" has no triangles and was left out.',
    ]
    alone = open_source([box(), ([[0, 0, 0]] * 3, [[0, 1, 2]])])
    assert (alone.kind, alone.names()) == ("object", ["part"])
    assert alone.notes[0].text.startswith("The meshes were left out: ")


@pytest.mark.parametrize("thing", [lambda: [box(), post(), 5], lambda: {"a": [box(), post(), "pot.stl"]}])
def test_other_things_beside_them_are_refused(thing):
    with pytest.raises(SourceError, match="in it is no CAD object and no mesh"):
        open_source(thing())


def test_meshes_of_other_units_stand_where_they_do_alone():
    scan = post()
    scan.apply_scale(0.001)
    scan.units = "meters"
    alone, beside = open_source(scan), open_source([box(), scan])
    low, high = beside.bounds()
    assert np.allclose([low[2], high[2]], [-5.0, 15.0])
    assert np.allclose(alone.bounds() * alone.frame.unit, [[-3, -3, 5], [3, 3, 15]])


@pytest.mark.parametrize("view", ["front", "iso", (1, -2, 3)])
@pytest.mark.parametrize("z", [10.0, 7.0, 10.001])
def test_a_mesh_and_a_cad_object_hide_one_another(view, z):
    """As two CAD objects do: the same visible and hidden length, class by class but for creases, which meshes have."""
    solid = cq.Workplane().box(6, 6, 10).translate((0, 0, z))
    mixed = hlr.draw({"box": box(), "post": post(z)}, view=view, hidden=True)
    both = hlr.draw({"box": box(), "post": solid}, view=view, hidden=True)
    assert lengths(mixed) == pytest.approx(lengths(both), abs=0.1)
    if view != "front":  # There it is seen edge-on, upon an edge of the box.
        assert any(line.kind == "intersection" for line in mixed.lines) == (z < 10.0)


def lengths(drawing):
    found = {}
    for line in drawing.lines:
        key = drawing.parts[line.part].name, line.visible, line.kind == "intersection"
        found[key] = found.get(key, 0.0) + np.linalg.norm(np.diff(line.points, axis=0), axis=1).sum()
    return {key: found[key] for key in sorted(found)}


@pytest.mark.parametrize("view", ["front", (1, -1, 1), (0.2, -0.3, 1)])
@pytest.mark.parametrize("radius", [7.0, 8.0, 8.5])
def test_a_ball_of_triangles_in_a_cup_looks_like_one_of_a_cad_object(view, radius):
    """Free in the cup, lying in it, and sunk into it: but where they touch, the lines are the same within 0.1 mm."""
    cup = cq.Workplane().box(30, 30, 12).translate((0, 0, -6)).cut(cq.Workplane().sphere(8))
    fine = trimesh.creation.icosphere(subdivisions=6, radius=radius)
    mixed, both = (
        visible_segments(hlr.draw({"cup": cup, "ball": ball}, view=view, scale=1.0))
        for ball in (fine, cq.Workplane().sphere(radius))
    )
    touching = 3.0 if radius == 8.0 else 0.0
    assert missing(mixed, both, 0.1) <= touching
    assert missing(both, mixed, 0.1) <= touching


def test_a_cad_part_that_comes_near_a_mesh_has_the_finer_mesh():
    source = open_source({"near": cq.Workplane().sphere(10), "far": cq.Workplane().sphere(10).translate((99, 0, 0)),
                          "post": post(15.0)})  # fmt: skip
    made = source.mesh(0.05, 0.5)
    near, far, mesh = (len(part.triangles) for part in made.parts)
    assert near > 1.3 * far
    assert mesh == 12
    assert made.touching.tolist() == [1, 0, 0]
    (whole,) = open_source(cq.Workplane().sphere(10)).mesh(0.05, 0.5).parts
    assert len(whole.triangles) == far


def test_parts_are_chosen_from_both():
    model = {"box": box(), "post": post(), "other": box(40)}
    assert [part.name for part in hlr.draw(model, view="iso", only=["box"]).parts] == ["box"]
    assert [part.name for part in hlr.draw(model, view="iso", only=["post"]).parts] == ["post"]
    assert [part.name for part in hlr.draw(model, view="iso", hide=["other"]).parts] == ["box", "post"]
    with pytest.raises(OptionError, match="no part"):
        hlr.draw(model, view="iso", only=["nothing"])


def test_a_section_cuts_and_hatches_both():
    drawing = hlr.draw({"box": box(), "post": post()}, view="front", section=True)
    assert [drawing.parts[k].name for k in drawing.section.parts] == ["box", "post"]
    hatched = {drawing.parts[line.part].name for line in drawing.lines if line.kind == "hatch"}
    assert hatched == {"box", "post"}
    assert drawing.notes == ()


def test_a_section_may_leave_one_of_them():
    drawing = hlr.draw({"box": box(), "post": post(x=0.0), "far": post(0.0, x=60.0)}, view="right", section=30.0)
    assert {part.name for part in drawing.parts} == {"box", "post"}
    with pytest.raises(OptionError, match="misses the model"):
        hlr.draw([box(), post()], view="front", section=90.0)


def test_a_mesh_that_is_open_is_cut_without_a_hatch():
    sheet = trimesh.Trimesh([[-30, -30, 8], [30, -30, 8], [30, 30, 8], [-30, 30, 8]], [[0, 1, 2], [0, 2, 3]])
    drawing = hlr.draw({"box": box(), "sheet": sheet}, view="front", section=True)
    assert [note.code for note in drawing.notes if note.code.startswith("section")] == ["section-not-hatched"]
    assert '"sheet"' in drawing.notes[-1].text


def test_a_preview_shows_both_in_their_colours():
    scan = post()
    scan.visual.face_colors = (255, 0, 0, 255)
    picture = hlr.preview({"box": box(), "scan": scan}, view="front", size=(200, 200), ids=True)
    assert set(np.unique(picture.part_ids)) == {-1, 0, 1}
    red, green, _ = (picture.pixels[picture.part_ids == 1][:, k].mean() for k in range(3))
    assert red > 3 * green


def test_what_is_said_of_the_stages():
    drawing = hlr.draw({"box": box(), "post": post(), "also": post(30)}, view="iso")
    told = {row.name: row for row in drawing.plan}
    assert told["B-rep reader"].on and told["mesh reader"].on
    assert told["B-rep reader"].counts == {"brep_parts": 1}
    assert told["mesh reader"].counts == {"mesh_parts": 2}
    assert told["triangulation of planar faces"].counts == {"planar_triangles": 12}
    assert not told["meshing of curved faces"].on


def test_a_mesh_that_passes_through_itself_is_meshed_once(monkeypatch):
    """A finer mesh is there for B-reps alone."""
    spindle = trimesh.creation.torus(4.0, 6.0)
    calls, mesh = [], hlr.source.joined.JoinedSource.mesh
    monkeypatch.setattr(
        hlr.source.joined.JoinedSource, "mesh", lambda self, *a, **k: (calls.append(1), mesh(self, *a, **k))[1]
    )
    hlr.draw({"box": box(), "spindle": spindle}, view="iso", scale=1.0)
    assert len(calls) == 1
