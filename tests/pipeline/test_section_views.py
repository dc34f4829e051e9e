"""Section views: what is cut away, what is hatched, and what is said where nothing is."""

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.common.types import Floats
from hlr.errors import OptionError, SourceError
from hlr.source.cad.brep_source import BrepSource

WIDTH, DEPTH, HEIGHT, RADIUS = 60.0, 30.0, 40.0, 10.0


def plate():
    """A block with a hole from top to bottom, its middle in the origin."""
    return cq.Workplane().box(WIDTH, DEPTH, HEIGHT).faces(">Z").workplane().hole(2 * RADIUS)


def mesh_of(thing):
    points, triangles = thing.val().tessellate(0.01, 0.05)
    return np.array([p.toTuple() for p in points]), np.array(triangles)


def section(thing, view="front", where=True, **options):
    return hlr.draw(thing, view, section=where, **{"scale": 1, **options})


def hatch_of(drawing) -> Floats:
    """(n, 2, 2)"""
    return np.array([line.points for line in drawing.lines if line.kind == "hatch"]).reshape(-1, 2, 2)


def hatched_area(drawing, spacing):
    way = hatch_of(drawing) @ [1, 1j]
    return float(np.abs(way[:, 1] - way[:, 0]).sum() * spacing)


def outlines_of(drawing):
    """The straight lines that are no hatch, by their ends, to a thousandth of a millimetre."""
    found = set()
    for line in drawing.lines:
        if line.kind != "hatch":
            ends = sorted(tuple(np.round(line.points[k], 3).tolist()) for k in (0, -1))
            found.add((line.visible, *ends))
    return found


def test_a_hole_that_is_cut_through_its_axis_is_open_and_hatched_beside():
    drawing = section(plate())
    assert outlines_of(drawing) == {(True, (x, 0.0), (x, HEIGHT)) for x in (0.0, 20.0, 40.0, WIDTH)} | {
        (True, (a, y), (b, y)) for a, b in ((0.0, 20.0), (20.0, 40.0), (40.0, WIDTH)) for y in (0.0, HEIGHT)
    }
    assert not drawing.hidden
    hatch = hatch_of(drawing)
    x, y = hatch.reshape(-1, 2).T
    on_border = np.minimum.reduce([*(abs(x - at) for at in (0, 20, 40, 60)), abs(y), abs(y - HEIGHT)])
    assert on_border.max() < 1e-9
    assert ((hatch[:, :, 0].max(axis=1) <= 20 + 1e-9) | (hatch[:, :, 0].min(axis=1) >= 40 - 1e-9)).all()
    assert hatched_area(drawing, 3.0) == pytest.approx(2 * 20 * HEIGHT, rel=0.03)
    # From left above to right below there are so many spacings across each of the two halves.
    assert len(hatch) == 2 * round((20 + HEIGHT) / np.sqrt(2.0) / 3.0)


def test_the_plane_and_the_parts_that_it_cuts_are_stated():
    drawing = section(plate(), where=5)
    assert drawing.section == hlr.Section((0.0, 5.0, 0.0), (0.0, -1.0, 0.0), (0,))
    hatch = [line for line in drawing.lines if line.kind == "hatch"]
    assert all((line.points3[:, 1] == 5.0).all() and line.edge is None and line.visible for line in hatch)
    assert drawing.counters["hatch_lines"] == len(hatch)
    back = np.concatenate([line.points3 for line in hatch])[:, [0, 2]] - np.concatenate([line.points for line in hatch])
    assert back == pytest.approx(np.tile(back[:1], (len(back), 1)))
    assert len({line.face for line in hatch}) == 2


@pytest.mark.parametrize(
    ("view", "where"), [("front", 5), ("front", (7, 5, -9)), ((0, -3, 0), 5), ("front", {"front": 5})]
)
def test_a_plane_is_said_by_a_coordinate_or_by_a_point(view, where):
    hole = 2.0 * np.sqrt(RADIUS**2 - 5.0**2)
    xs = {x for _, (x, _), (other, _) in outlines_of(section(plate(), view, where)) if x == other}
    cut = {30.0 - hole / 2, 30.0 + hole / 2}
    assert {round(x, 3) for x in cut} <= xs


@pytest.mark.parametrize(
    ("view", "where", "area"),
    [
        ("back", 5, (WIDTH - 2 * np.sqrt(75.0)) * HEIGHT),
        ("left", 20, DEPTH * HEIGHT),
        ("right", 20, DEPTH * HEIGHT),
        ("top", 1, WIDTH * DEPTH - np.pi * RADIUS**2),
        ("bottom", 1, WIDTH * DEPTH - np.pi * RADIUS**2),
        ((1, -1, 0), (0, 0, 0), (DEPTH * np.sqrt(2.0) - 2 * RADIUS) * HEIGHT),
    ],
)
def test_each_view_hatches_the_area_that_its_plane_cuts(view, where, area):
    assert hatched_area(section(plate(), view, where), 3.0) == pytest.approx(area, rel=0.05)


@pytest.mark.parametrize(
    ("view", "where"), [("front", 5), ("back", 5), ("top", -10), ("left", -10), ("iso", (3, 2, 1))]
)
def test_nothing_is_left_before_the_plane(view, where):
    drawing = section(plate(), view, where, hidden=True)
    normal = np.array(drawing.section.normal)
    level = np.array(drawing.section.point) @ normal
    assert (np.concatenate([line.points3 for line in drawing.lines]) @ normal).max() == pytest.approx(level)


def test_the_middle_is_that_of_the_model_and_not_of_control_points(monkeypatch):
    """Splines may reach much less far than their control points, by which a source tells how far it reaches."""
    reach = BrepSource.reach
    monkeypatch.setattr(BrepSource, "reach", lambda *asked: reach(*asked) + np.array([[-50.0, 1e-9], [0.0, 0.0]]))
    assert section(plate()).section.point[1] == pytest.approx(0.0, abs=1e-6)
    with pytest.raises(OptionError, match="reaches from -15 to 15 mm there"):
        section(plate(), where=30)


def test_a_section_has_hidden_lines_where_they_are_asked_for_alone():
    blind = cq.Workplane().box(60, 30, 40).faces("<Y").workplane().hole(10, 5).faces(">Y").workplane().hole(10, 5)
    assert not section(blind).hidden
    assert section(blind, hidden=True).hidden


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


def test_parts_may_stay_whole():
    shaft = cq.Workplane("XY").circle(5).extrude(60).translate((0, 0, -30))
    bush = cq.Workplane("XY").circle(12).circle(5).extrude(30).translate((0, 0, -15))
    assembly = cq.Assembly().add(shaft, name="shaft").add(bush, name="bush")
    every, some = section(assembly), section(assembly, uncut=("sha*",))
    assert [part.name for part in every.parts] == [part.name for part in some.parts] == ["shaft", "bush"]
    assert (every.section.parts, some.section.parts) == ((0, 1), (1,))
    # The whole shaft comes forward of the cut bush, and shows its outline in it.
    ahead = np.concatenate([line.points3 for line in some.lines if line.part == 0])[:, 1]
    assert ahead.min() == pytest.approx(-5.0, abs=0.05)
    with pytest.raises(OptionError, match='uncut "bolt" matches no part: there are "shaft", "bush"'):
        section(assembly, uncut=("bolt",))


def test_parts_before_the_plane_go_and_those_behind_it_stay():
    row = [cq.Workplane().box(10, 10, 10).translate((0, y, 0)) for y in (-20, 0, 20)]
    drawing = section(row, where=1)
    assert [part.name for part in drawing.parts] == ["part:2", "part:3"]
    assert drawing.section.parts == (0,)


@pytest.mark.parametrize(
    ("where", "message"),
    [
        (
            15.5,
            "section front at y = 15.5 misses the model: Workplane reaches from -15 to 15 mm there, so give a number",
        ),
        (-15.5, "section front at y = -15.5 misses the model"),
        (15, "section front at y = 15 leaves nothing of the model"),
    ],
)
def test_a_plane_that_leaves_nothing_to_draw_or_to_cut_is_refused(where, message):
    with pytest.raises(OptionError, match=message):
        section(plate(), where=where)


def test_an_oblique_plane_that_misses_the_model_is_refused():
    with pytest.raises(
        OptionError, match=r"section iso lies 288\.675 mm from the origin toward the viewer, and misses"
    ):
        section(plate(), "iso", (0, 0, 500))


def test_a_plane_that_touches_the_front_takes_nothing_away():
    drawing = section(plate(), where=-15)
    (note,) = drawing.notes
    assert (note.code, note.is_warning) == ("section-not-hatched", False)
    assert note.text == "the plane of section front only touches the model: nothing is taken away."
    assert drawing.section.parts == ()
    assert outlines_of(drawing) == outlines_of(hlr.draw(plate(), "front", scale=1, hidden=False))


def test_a_part_that_the_plane_only_touches_is_not_hatched():
    drawing = section([cq.Workplane().box(10, 10, 10).translate((0, y, 0)) for y in (-5, 5, 0)], where=0)
    assert drawing.section.parts == (1,)
    assert [part.name for part in drawing.parts] == ["part:2", "part:3"]


def test_open_surfaces_are_cut_and_not_hatched():
    tube = cq.Workplane().rect(20, 10).extrude(10).faces("#Z").vals()
    drawing = section(cq.Shell.makeShell(tube))
    assert [note.code for note in drawing.notes if "section" in note.code] == ["section-not-hatched"]
    assert not len(hatch_of(drawing))


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


def test_an_open_mesh_is_refused():
    points, triangles = mesh_of(plate())
    with pytest.raises(
        SourceError, match='Part "part" of mesh cannot be cut for a section, because its triangles do not'
    ):
        section((points, triangles[1:]))


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


def test_other_sources_are_refused():
    class Other:
        def __init__(self, source):
            self._source = source

        def __getattr__(self, name):
            return getattr(self._source, name)

    from hlr.source import open_source

    with pytest.raises(SourceError, match="Workplane cannot be cut for a section: draw a CAD model, or a mesh"):
        section(Other(open_source(plate())))


def test_some_views_of_several_are_cut():
    options = hlr.Options(scale=1, section={"left": True})
    views = ["front", "left", "top"]
    cut = hlr.draw_views(plate(), views, options)
    whole = hlr.draw_views(plate(), ["front", "top"], hlr.Options(scale=1))
    assert [drawing.view.name for drawing in cut] == views
    assert [drawing.section is None for drawing in cut] == [True, False, True]
    assert cut[0].lines == whole[0].lines and cut[2].lines == whole[1].lines


def test_sections_of_one_scale_have_the_smallest():
    long = cq.Workplane().box(200, 30, 20)
    drawings = hlr.draw_views(long, ["front", "left"], hlr.Options(section={"left": True}, same_scale=True))
    assert {drawing.scale for drawing in drawings} == {1.0}
    assert drawings[1].section is not None


def test_a_section_in_a_window_has_its_hatch_inside():
    drawing = section(plate(), window=(5.0, 5.0, 15.0, 15.0))
    hatch = hatch_of(drawing)
    assert hatch.min() >= 5.0 - 1e-9 and hatch.max() <= 15.0 + 1e-9
    assert hatched_area(drawing, 3.0) == pytest.approx(100.0, rel=0.2)


def test_a_section_within_a_time_and_one_that_is_filled():
    assert len(hatch_of(section(plate(), within=5.0))) == len(hatch_of(section(plate())))
    assert section(plate(), fill=True).fill is not None


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


def test_the_same_section_is_the_same_file():
    one, other = (section(plate(), where=5) for _ in range(2))
    assert one == other
    for name in ("svg", "pdf", "dxf", "png"):
        assert getattr(one, f"to_{name}")() == getattr(other, f"to_{name}")()


def test_each_format_has_the_hatch_in_a_layer_of_its_own_and_thin(tmp_path):
    import ezdxf

    drawing = section(plate())
    count = len(hatch_of(drawing))
    svg = drawing.to_svg()
    group = svg.partition('<g class="hatch"')[2].partition("</g>")[0]
    assert 'stroke-width="0.25"' in group.partition(">")[0] or 'stroke-width=".25"' in group.partition(">")[0]
    assert group.count("M") == count
    assert b"Visible hatch" in drawing.to_pdf()
    path = drawing.save(tmp_path / "part.dxf")
    document = ezdxf.readfile(path)
    assert document.layers.get("VISIBLE_HATCH").dxf.lineweight == 25
    assert len(document.modelspace().query('LINE[layer=="VISIBLE_HATCH"]')) == count


def test_json_states_the_section_and_is_read_back(tmp_path):
    drawing = section(plate(), where=5)
    path = drawing.save(tmp_path / "part.json")
    assert hlr.load(path) == drawing
    assert hlr.load(path).section == drawing.section


def test_a_model_is_compared_with_its_section(tmp_path):
    path = tmp_path / "part.step"
    cq.exporters.export(plate(), str(path))
    drawing = section(path, where=5)
    for name in ("part.svg", "part.json"):
        assert hlr.compare.compare(drawing.save(tmp_path / name), path).same
    assert not hlr.compare.compare(section(path, where=8), path, view="front").same


def test_a_plan_is_that_of_a_whole_model():
    with pytest.raises(OptionError, match="a plan is that of a whole model: leave out section"):
        hlr.plan_views(plate(), ["front"], hlr.Options(section=True))
