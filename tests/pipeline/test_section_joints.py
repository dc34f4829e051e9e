"""Sections whose plane lies between parts that rest on one another: it goes through material there."""

import cadquery as cq
import numpy as np
import pytest
import trimesh

import hlr
from support.sections import hatch_of, hatched_area, mesh_of, section


def halves():
    """A block with a hole, in two mirrored halves that meet in the middle."""
    half = cq.Workplane().box(60, 20, 40).faces(">Z").workplane().center(0, -10).hole(20).translate((0, 10, 0))
    return half, half.mirror("XZ")


def as_scene(bodies):
    scene = trimesh.Scene()
    for k, body in enumerate(bodies):
        scene.add_geometry(trimesh.Trimesh(*mesh_of(body)), geom_name=f"part{k}", node_name=f"part{k}")
    return scene


def plate_and_boss(boss):
    return [cq.Workplane().box(60, 10, 40).translate((0, 5, 0)), boss]


def rims_of(drawing):
    return [line for line in drawing.lines if line.kind == "sharp" and line.edge is None]


@pytest.mark.parametrize("meshed", [False, True])
@pytest.mark.parametrize("view", ["front", "back"])
def test_halves_that_meet_in_the_plane_are_hatched_as_one_body_is(view, meshed):
    thing = as_scene(halves()) if meshed else list(halves())
    drawing = section(thing, view)
    assert hatched_area(drawing, 3.0) == pytest.approx(40 * 40, rel=0.03)
    assert not [note for note in drawing.notes if note.code == "section-not-hatched"]
    assert len(drawing.section.parts) == len(drawing.parts) == 1
    assert meshed or rims_of(drawing) == []
    near = section(thing, view, 1e-3)
    assert len(drawing.lines) == len(near.lines)
    assert len(hatch_of(drawing)) == len(hatch_of(near))


def test_a_face_is_hatched_only_where_a_part_rests_on_it_and_that_has_a_border():
    boss = cq.Workplane().box(20, 10, 10).translate((10, -5, 0))
    drawing = section(plate_and_boss(boss))
    assert hatched_area(drawing, 3.0) == pytest.approx(200.0, rel=0.1)
    x = hatch_of(drawing)[..., 0]
    assert (x.min(), x.max()) == (pytest.approx(30.0, abs=3.0), pytest.approx(50.0, abs=3.0))
    assert x.min() >= 30.0 - 1e-9 and x.max() <= 50.0 + 1e-9
    (rim,) = rims_of(drawing)
    assert rim.visible
    assert (rim.points.min(axis=0), rim.points.max(axis=0)) == (pytest.approx([30, 15]), pytest.approx([50, 25]))
    assert np.abs(np.diff(rim.points, axis=0)).sum() == pytest.approx(2 * (20 + 10))
    assert (rim.points3[:, 1] == 0.0).all()


def test_a_border_that_runs_along_an_edge_of_the_face_is_not_drawn_twice():
    boss = cq.Workplane().box(20, 10, 80).translate((20, -5, 0))
    rims = rims_of(section(plate_and_boss(boss)))
    assert [sorted(map(tuple, np.round(rim.points, 6).tolist())) for rim in rims] == [[(40.0, 0.0), (40.0, 40.0)]]


def test_round_bosses_have_round_borders_as_exact_as_the_drawing():
    boss = cq.Workplane("XZ").circle(8).extrude(10)
    drawing = section(plate_and_boss(boss))
    (rim,) = rims_of(drawing)
    radius = np.hypot(*(rim.points - [30.0, 20.0]).T)
    assert (radius.min(), radius.max()) == (pytest.approx(8.0, abs=0.05), pytest.approx(8.0, abs=1e-6))
    assert np.hypot(*(hatch_of(drawing).reshape(-1, 2) - [30.0, 20.0]).T) == pytest.approx(8.0, abs=0.05)


def test_parts_that_stay_whole_make_no_joint():
    for name in ("part", "part:2"):
        drawing = section(list(halves()), uncut=(name,))
        assert not len(hatch_of(drawing))
    (note,) = (note for note in drawing.notes if note.code == "section-not-hatched")
    assert note.text == "the plane of section front goes through no part: nothing is hatched."


def test_faces_that_lie_side_by_side_in_the_plane_make_no_joint():
    side_by_side = [
        cq.Workplane().box(60, 10, 40).translate((0, 5, 0)),
        cq.Workplane().box(20, 10, 40).translate((40, -5, 0)),
    ]
    drawing = section(side_by_side)
    assert not len(hatch_of(drawing))
    assert drawing.section.parts == ()


def test_a_section_of_whole_parts_alone_says_so():
    drawing = hlr.draw(cq.Workplane().box(10, 10, 10), "front", section=True, uncut=("*",))
    (note,) = drawing.notes
    assert note.text == "all parts that the plane of section front goes through stay whole: nothing is hatched."
