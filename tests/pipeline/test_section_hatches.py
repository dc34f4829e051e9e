"""What of a section is hatched: of solids, surfaces and meshes, and which parts are hatched alike."""

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.errors import OptionError
from support.sections import HEIGHT, hatch_of, hatched_area, mesh_of, outlines_of, plate, section


def pocket():
    """A block with a pocket in front whose floor lies in the middle."""
    return cq.Workplane().box(60, 40, 40).cut(cq.Workplane().box(20, 20, 24).translate((0, -10, 0)))


@pytest.mark.parametrize("make", [lambda body: body, mesh_of], ids=["solid", "mesh"])
def test_the_floor_of_a_pocket_that_lies_in_the_plane_is_seen_and_not_hatched(make):
    drawing = section(make(pocket()))
    assert hatched_area(drawing, 3.0) == pytest.approx(60 * 40 - 20 * 24, rel=0.03)
    x, y = hatch_of(drawing).mean(axis=1).T
    assert not ((x > 20) & (x < 40) & (y > 8) & (y < 32)).any()
    (rim,) = (line for line in drawing.lines if line.kind == "sharp" and len(line.points) > 2)
    assert rim.visible
    assert rim.points[0] == pytest.approx(rim.points[-1])
    assert np.abs(np.diff(rim.points, axis=0)).sum() == pytest.approx(2 * (20 + 24))
    assert (rim.points.min(axis=0), rim.points.max(axis=0)) == (pytest.approx([20, 8]), pytest.approx([40, 32]))
    # Turned about, there is material before the floor, and all is cut.
    behind = section(make(pocket().rotate((0, 0, 0), (0, 0, 1), 180)), "front", -1e-3)
    assert hatched_area(behind, 3.0) == pytest.approx(60 * 40, rel=0.03)


def test_the_floor_of_a_round_pocket_in_a_round_body_is_not_hatched():
    body = cq.Workplane("XZ").circle(20).extrude(-30).faces("<Y").workplane().hole(16, 15)
    assert hatched_area(section(body), 3.0) == pytest.approx(np.pi * (20**2 - 8**2), rel=0.04)


def test_level_faces_are_found_a_few_points_at_a_time(monkeypatch):
    from hlr.linework import level_faces

    whole = section(mesh_of(pocket()))
    monkeypatch.setattr(level_faces, "PAIRS", 7)
    assert section(mesh_of(pocket())) == whole


def test_a_rim_that_reaches_the_border_is_open():
    slot = cq.Workplane().box(60, 40, 40).cut(cq.Workplane().box(20, 20, 60).translate((0, -10, 0)))
    rims = [line.points for line in section(slot).lines if line.kind == "sharp" and line.edge is None]
    assert sorted(tuple(sorted(map(tuple, np.round(each, 6).tolist()))) for each in rims) == [
        ((20.0, 0.0), (20.0, 40.0)), ((40.0, 0.0), (40.0, 40.0))
    ]  # fmt: skip


@pytest.mark.parametrize("meshed", [False, True])
def test_a_whole_part_hides_the_hatches_behind_it(meshed, tmp_path):
    """The plane lies behind the axis: the shaft is wider before it."""
    shaft = cq.Workplane("XY").circle(5).extrude(60).translate((0, 0, -30))
    bush = cq.Workplane("XY").circle(12).circle(5).extrude(30).translate((0, 0, -15))
    thing = cq.Assembly().add(shaft, name="shaft").add(bush, name="bush")
    if meshed:
        import trimesh

        scene = trimesh.Scene()
        for name, body in (("shaft", shaft), ("bush", bush)):
            scene.add_geometry(trimesh.Trimesh(*mesh_of(body)), geom_name=name, node_name=name)
        thing = scene
    drawing = section(thing, where=3, uncut=("shaft",))
    x = hatch_of(drawing)[..., 0] + drawing.origin[0]
    assert np.abs(x).min() == pytest.approx(5.0, abs=0.05)
    assert np.abs(x).max() == pytest.approx(np.sqrt(12**2 - 3**2), abs=0.05)
    assert [drawing.parts[k].name for k in drawing.section.parts] == ["bush"]


def test_parts_that_touch_have_other_hatches():
    left, right = cq.Workplane().box(20, 20, 20), cq.Workplane().box(20, 20, 20).translate((20, 0, 0))
    drawing = section([left, right])
    slopes = {}
    for line in drawing.lines:
        if line.kind == "hatch":
            way = line.points[1] - line.points[0]
            slopes.setdefault(line.part, set()).add(round(float(way[1] / way[0])))
    assert slopes == {0: {1}, 1: {-1}}
    assert drawing.section.parts == (0, 1)


def test_pieces_of_one_part_have_one_hatch():
    frame = (
        cq.Workplane()
        .box(60, 20, 40)
        .cut(cq.Workplane().box(40, 20, 60))
        .union(cq.Workplane("XY", (0, 9, 0)).box(60, 2, 40))
    )
    drawing = section(frame)
    ways = {
        round(float(np.divide(*(line.points[1] - line.points[0]))), 6) for line in drawing.lines if line.kind == "hatch"
    }
    assert ways == {1.0}
    # Two posts, joined before the plane.
    split = section(cq.Workplane().box(60, 20, 40).cut(cq.Workplane().box(40, 18, 60).translate((0, 1, 0))))
    assert len(split.section.parts) == len(split.parts) == 2
    x = hatch_of(split)[:, :, 0]
    assert x.min() < 20
    assert x.max() > 40


def test_a_part_that_the_plane_only_touches_is_not_hatched():
    drawing = section([cq.Workplane().box(10, 10, 10).translate((0, y, 0)) for y in (-5, 5, 0)], where=0)
    assert drawing.section.parts == (1,)
    assert [part.name for part in drawing.parts] == ["part:2", "part:3"]


def test_open_surfaces_are_cut_and_not_hatched():
    tube = cq.Workplane().rect(20, 10).extrude(10).faces("#Z").vals()
    drawing = section(cq.Shell.makeShell(tube))
    assert [note.code for note in drawing.notes if "section" in note.code] == ["section-not-hatched"]
    assert not len(hatch_of(drawing))


def test_an_edge_without_faces_is_cut_and_has_nothing_to_hatch():
    path = cq.Edge.makeLine(cq.Vector(-20, -20, 9), cq.Vector(20, 20, 9))
    drawing = section([cq.Workplane().box(10, 10, 10), path])
    (line,) = (line for line in drawing.lines if line.part == 1)
    # From the plane through the middle of the box to its end behind it.
    assert np.ptp(line.points, axis=0) == pytest.approx((20, 0))
    assert drawing.section.parts == (0,)
    assert [note for note in drawing.notes if "section" in note.code] == []


def test_faces_that_close_a_body_are_a_solid():
    shell = plate().val().Shells()[0]
    assert hatched_area(section(shell), 3.0) == pytest.approx(2 * 20 * HEIGHT, rel=0.03)
    loose = cq.Compound.makeCompound(plate().val().Faces())
    assert hatched_area(section(loose), 3.0) == pytest.approx(2 * 20 * HEIGHT, rel=0.03)


def test_a_solid_that_is_turned_inside_out_is_cut_like_any_other():
    inside_out = cq.Shape.cast(plate().val().wrapped.Reversed())
    assert hatched_area(section(inside_out), 3.0) == pytest.approx(2 * 20 * HEIGHT, rel=0.03)


def test_closed_meshes_are_cut_and_hatched():
    drawing = section(mesh_of(plate()))
    assert hatched_area(drawing, 3.0) == pytest.approx(2 * 20 * HEIGHT, rel=0.03)
    assert drawing.section.parts == (0,)
    assert outlines_of(drawing) == outlines_of(section(plate()))


def test_a_mesh_that_is_turned_inside_out_is_cut_like_any_other():
    points, triangles = mesh_of(plate())
    drawing = section((points, triangles[:, ::-1]))
    assert hatched_area(drawing, 3.0) == pytest.approx(2 * 20 * HEIGHT, rel=0.03)


def test_units_and_axes_of_a_mesh_are_those_of_its_file(tmp_path):
    """glTF: metres, y up. The plane is said in millimetres, z up."""
    import trimesh

    path = tmp_path / "body.glb"
    trimesh.creation.box((0.06, 0.04, 0.03)).export(path)
    drawing = section(path, "front", -10)
    assert drawing.section.point[2] == pytest.approx(0.01)
    with pytest.raises(OptionError, match=r"at y = -16 misses the model: body.glb reaches from -15 to 15 mm there"):
        section(path, "front", -16)
    assert hatched_area(drawing, 3.0) == pytest.approx(60 * 40, rel=0.03)


def test_a_model_of_any_size_has_hatches_that_can_be_read():
    counts = []
    for size in (1e-3, 1.0, 1e5):
        drawing = hlr.draw(cq.Workplane().box(size, size, size), "front", section=True)
        counts.append(len(hatch_of(drawing)))
    assert counts[0] == counts[1] or abs(counts[0] - counts[1]) < 40
    assert all(10 < count < 200 for count in counts)


@pytest.mark.parametrize("size", [1e-12, 1e-9, 1.0, 1e9])
def test_a_mesh_of_any_size_is_cut(size):
    points, triangles = mesh_of(pocket())
    drawing = hlr.draw((points * size, triangles), "front", section=True)
    alone = hlr.draw((points, triangles), "front", section=True)
    assert len(hatch_of(drawing)) == pytest.approx(len(hatch_of(alone)), rel=0.6)
    assert any(len(line.points) > 2 for line in drawing.lines)


def test_a_part_whose_box_alone_is_cut_is_not_said_to_have_no_hatch():
    """The box of the ball reaches before the oblique plane, the ball does not."""
    ball = cq.Workplane().sphere(10)
    drawing = section([cq.Workplane().box(40, 40, 40).translate((30, -30, 0)), ball], (1, 1, 0), (8.5, 8.5, 0))
    assert drawing.section.parts == (0,)
    assert [note for note in drawing.notes if note.code == "section-not-hatched"] == []
