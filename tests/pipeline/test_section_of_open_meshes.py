"""Open meshes are cut open in a section: without cut faces, and so without a hatch. A note says so."""

import cadquery as cq
import numpy as np
import pytest
import trimesh

import hlr
from support.sections import DEPTH, HEIGHT, RADIUS, WIDTH, hatch_of, hatched_area, mesh_of, plate, section


def tray():
    """A plate with a hole, its back missing."""
    points, triangles = mesh_of(plate())
    return points, triangles[(points[triangles][:, :, 1] < DEPTH / 2 - 1e-9).any(axis=1)]


def beside(*meshes):
    """One mesh of several, 100 mm apart."""
    moved = [trimesh.Trimesh(points + [100.0 * k, 0, 0], triangles) for k, (points, triangles) in enumerate(meshes)]
    whole = trimesh.util.concatenate(moved)
    return np.asarray(whole.vertices), np.asarray(whole.faces)


def as_scene(**meshes):
    scene = trimesh.Scene()
    for name, (points, triangles) in meshes.items():
        scene.add_geometry(trimesh.Trimesh(points, triangles, process=False), geom_name=name, node_name=name)
    return scene


def unhatched(drawing):
    return [note.text for note in drawing.notes if note.code == "section-not-hatched"]


def test_an_open_mesh_is_cut_and_not_hatched():
    drawing = section(tray())
    assert not len(hatch_of(drawing))
    assert drawing.section.parts == ()
    assert unhatched(drawing) == ['section front: it cuts "part", without a closed surface, and so without a hatch.']
    cut = np.concatenate([line.points3 for line in drawing.lines])
    assert cut[:, 1].min() == pytest.approx(0.0, abs=1e-12)
    assert drawing.bounds.width == pytest.approx(WIDTH) and drawing.bounds.height == pytest.approx(HEIGHT)


def test_lines_at_the_plane_are_borders():
    lines = section(tray()).lines
    on_plane = [line for line in lines if np.abs(line.points3[:, 1]).max() < 1e-9]
    assert {line.kind for line in on_plane} == {"boundary"}
    length = sum(float(np.hypot(*np.diff(line.points, axis=0).T).sum()) for line in on_plane)
    assert length == pytest.approx(2 * (WIDTH - 2 * RADIUS) + 4 * HEIGHT, rel=1e-3)


def test_closed_bodies_of_the_same_mesh_are_cut_and_hatched_as_ever():
    drawing = section(beside(mesh_of(plate()), tray()))
    alone = section(mesh_of(plate()))
    assert hatched_area(drawing, 3.0) == pytest.approx(hatched_area(alone, 3.0), rel=0.02)
    assert hatch_of(drawing)[..., 0].max() == pytest.approx(WIDTH)
    assert [part.name for part in drawing.parts] == ["part", "part:2"] and drawing.section.parts == (0,)
    assert unhatched(drawing) == [
        'section front: it cuts bodies of "part", without a closed surface, and so without a hatch.'
    ]


def test_open_bodies_that_the_plane_misses_are_not_named():
    points, triangles = tray()
    behind = section(beside(mesh_of(plate()), (points + [0, 40, 0], triangles)), where=0)
    assert [part.name for part in behind.parts] == ["part", "part:2"] and not unhatched(behind)
    before = section(beside(mesh_of(plate()), (points - [0, 40, 0], triangles)), where=0)
    assert [part.name for part in before.parts] == ["part"] and not unhatched(before)


def test_a_face_of_an_open_mesh_in_the_plane_is_no_cut_face():
    """The floor of a hollow, over which the rest of a lidless block is before the plane."""
    hollow = cq.Workplane().box(60, 40, 40).cut(cq.Workplane().box(20, 10, 60).translate((0, -5, 0)))
    points, triangles = mesh_of(hollow)
    lidless = triangles[(points[triangles][:, :, 1] > -20 + 1e-9).any(axis=1)]
    drawing = section((points, lidless))
    assert not len(hatch_of(drawing))
    assert len(hatch_of(section((points, triangles))))


def test_open_parts_of_an_assembly_may_stay_whole_and_are_not_cut_where_their_box_alone_is():
    ball = trimesh.creation.icosphere(2, 10.0)
    ball.apply_translation((-30, 30, 0))
    scene = as_scene(block=mesh_of(plate()), ball=(ball.vertices, ball.faces[1:]))
    drawing = section(scene, "front", (0, 30, 0))
    assert unhatched(drawing) == ['section front: it cuts "ball", without a closed surface, and so without a hatch.']
    assert [part.name for part in drawing.parts] == ["ball"]
    whole = section(scene, "front", (0, 0, 0), uncut=("ball",))
    assert whole.section.parts == (0,) and not unhatched(whole)
    # Its box reaches 4 mm before this plane, the ball ends behind it.
    beside_it = section(scene, (1, 1, 0), (7.2, 7.2, 0))
    assert beside_it.section.parts == (0,) and not unhatched(beside_it)


def test_closed_bodies_of_one_mesh_on_both_sides_of_the_plane_are_not_said_to_be_open():
    points, triangles = mesh_of(cq.Workplane().box(10, 10, 10))
    both = (
        np.concatenate([points - [0, 20, 0], points + [0, 20, 0]]),
        np.concatenate([triangles, triangles + len(points)]),
    )
    assert unhatched(section(both)) == ["the plane of section front goes through no part: nothing is hatched."]


def test_names_stay_unique():
    mixed = beside(mesh_of(plate()), tray())
    drawing = section(as_scene(**{"body": mixed, "body:2": (mixed[0] + [0, 0, 100], mixed[1])}))
    assert [part.name for part in drawing.parts] == ["body", "body:3", "body:2", "body:2:2"]
    assert drawing.section.parts == (0, 2)
    assert unhatched(drawing) == [
        'section front: 2 parts that it cuts, such as bodies of "body", without a closed surface, and so without a '
        "hatch."
    ]


def test_a_page_of_an_open_mesh():
    page = hlr.draw_arranged(tray(), options=hlr.Options(section={"front": True}))
    assert page.sheet.marks[0].letter == "A" and page.sheet.marks[0].line is not None


def test_border_edges_are_counted_after_the_cut_and_the_notes_say_so():
    options = hlr.Options(section={"front": True}, scale=1)
    drawing = hlr.draw_arranged(tray(), views=["front", "top"], options=options)
    whole, left = sorted((note.text for note in drawing.notes if note.code == "defects"), key=len)
    assert whole.startswith('Part "part" is drawn as it is: open: ')
    assert left.startswith('section front, after the cut: Part "part" is drawn as it is: open: ')
    assert int(left.split()[-3]) > int(whole.split()[-3])


def test_where_nothing_is_cut_the_notes_are_those_of_the_model():
    whole = [note.text for note in hlr.draw(tray(), view="front", scale=1).notes if note.code == "defects"]
    drawing = section(tray(), where=-DEPTH / 2)
    assert whole and [note.text for note in drawing.notes if note.code == "defects"] == whole
