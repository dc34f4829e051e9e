"""Section views: what is cut away, what is stated and written, and what is said where nothing is cut."""

import gc

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr import _kernel
from hlr.errors import OptionError, SourceError
from hlr.source.cad.brep_source import BrepSource
from support.sections import (
    DEPTH,
    HEIGHT,
    RADIUS,
    WIDTH,
    hatch_of,
    hatched_area,
    opencascade_cuts,
    outlines_of,
    plate,
    section,
)


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


def test_a_plane_beside_a_large_model_is_told_as_people_type_numbers():
    hall = cq.Workplane().box(50_000_000, 40_000_000, 12_000)
    with pytest.raises(
        OptionError, match=r"at y = 90000000 misses the model: .* reaches from -20000000 to 20000000 mm"
    ):
        section(hall, "front", 9e7)


def test_a_section_has_hidden_lines_where_they_are_asked_for_alone():
    blind = cq.Workplane().box(60, 30, 40).faces("<Y").workplane().hole(10, 5).faces(">Y").workplane().hole(10, 5)
    assert not section(blind).hidden
    assert section(blind, hidden=True).hidden


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
    with pytest.raises(OptionError, match='`uncut` "bolt" matches no part: there are "shaft", "bush"'):
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


def test_a_plan_of_a_section_is_that_of_its_drawing_and_says_what_is_cut():
    row = [cq.Workplane().box(10, 10, 10).translate((20 * k, 0, 0)) for k in range(3)]
    options = hlr.Options(section={"top": 1.0, "left": (20, 0, 0)}, scale=1)
    views = ["top", "front", "left"]
    plans = hlr.plan_views(row, views, options)
    assert [plan.view for plan in plans] == views
    told = [next((each for each in plan.decisions if each.name == "section"), None) for plan in plans]
    assert [each and (each.on, each.origin, each.reason, each.counts["cut_parts"]) for each in told] == [
        (True, "asked", "asked for: its plane cuts 3 parts", 3),
        None,
        (True, "asked", "asked for: its plane cuts 1 part", 1),
    ]
    assert told[0].seconds > 0.0
    for plan, drawing in zip(plans, hlr.draw_views(row, views, options), strict=True):
        drawn = {each.name: (each.on, each.reason) for each in drawing.plan}
        assert {each.name: (each.on, each.reason) for each in plan.decisions} == drawn
    with pytest.raises(OptionError, match="section front at y = 9 misses the model"):
        hlr.plan_views(row, ["front"], hlr.Options(section=9))
    with pytest.raises(OptionError, match="section front is none of the views, top: add it to them"):
        hlr.plan_views(row, ["top"], hlr.Options(section={"front": True}))


def test_a_page_and_a_drawing_within_a_time_cut_the_model_once_and_forget_it(monkeypatch):
    from hlr.pipeline.section import draw
    from hlr.source import open_source

    cuts = []
    cut_source = draw.cut_source
    monkeypatch.setattr(draw, "cut_source", lambda *asked: cuts.append(1) or cut_source(*asked))
    source = open_source(plate())
    page = hlr.draw_arranged(source, options=hlr.Options(section={"front": True}))
    assert len(cuts) == 1
    assert hlr.draw_arranged(plate(), options=hlr.Options(section={"front": True})).lines == page.lines
    hlr.draw(source, "front", section={"front": True}, within=1.0)
    assert len(cuts) == 2
    assert hlr.draw(source, "front", section=1.0).section.point[1] == 1.0
    assert len(cuts) == 3
    before = len(draw._KNOWN)
    del source
    gc.collect()
    assert len(draw._KNOWN) < before


@pytest.mark.parametrize("in_kernel", [True, False])
def test_equal_parts_that_a_plane_cuts_alike_are_cut_once(monkeypatch, in_kernel):
    from hlr.source.cad import half_space

    calls, cut_away = [], half_space.cut_away
    monkeypatch.setattr(half_space, "cut_away", lambda *asked: calls.append(1) or cut_away(*asked))
    if not in_kernel:
        opencascade_cuts(monkeypatch)
    planes, cut_parts = [], _kernel.CutParts
    monkeypatch.setattr(_kernel, "CutParts", lambda model, cuts: planes.append(cuts) or cut_parts(model, cuts))
    angle = cq.Workplane().polyline([(0, 0), (12, 0), (12, 4), (4, 4), (4, 10), (0, 10)]).close().extrude(20)
    row = cq.Assembly()
    places = [
        *(cq.Location(cq.Vector(20 * k, 0, 3 * k)) for k in range(4)),
        cq.Location(cq.Vector(100, 0, 0), cq.Vector(0, 0, 1), 90),
        cq.Location(cq.Vector(120, 0, 0), cq.Vector(0, 1, 0), 180),
        cq.Location(cq.Vector(140, -5, 0)),
    ]
    for k, place in enumerate(places):
        row.add(angle, name=f"angle{k}", loc=place)
    drawing = section(row, where=2)
    # Four alike, and one that is turned about the line of sight; one is turned otherwise, one lies farther ahead.
    assert (len(planes[0]), len(calls)) == (3, 0) if in_kernel else len(calls) == 3
    assert len(drawing.section.parts) == 7
    alone = [section(angle.val().located(place), where=2) for place in places]
    assert hatched_area(drawing, 1.0) == pytest.approx(sum(hatched_area(each, 1.0) for each in alone), rel=0.2)
    assert len(drawing.visible) - len(hatch_of(drawing)) == sum(
        len(each.visible) - len(hatch_of(each)) for each in alone
    )
