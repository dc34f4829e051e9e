"""Sections whose plane steps: each piece is drawn as by its own plane, and the steps leave no line."""

import cadquery as cq
import numpy as np
import pytest
import trimesh

import hlr
from hlr.errors import OptionError
from support.sections import assembled, hatch_of, hatched_area, mesh_of, section

STEPS = (-12.0, (3.0, 12.0))
"""From x = 3 on at y = 12, before at y = -12."""


def plate():
    """80 x 50 x 20, with a hole of radius 6 at the front left, and one of radius 4 at the back right."""
    left = cq.Workplane().center(-25, -12).circle(6).extrude(60, both=True)
    right = cq.Workplane().center(25, 12).circle(4).extrude(60, both=True)
    return cq.Workplane().box(80, 50, 20).cut(left).cut(right)


def ink(drawing, low, high, axis=0, hatch=False):
    """Millimetres of visible lines between two coordinates in the model."""
    total = 0.0
    for line in drawing.lines:
        if (line.kind == "hatch") is not hatch or not line.visible:
            continue
        a, b = line.points3[:-1, axis], line.points3[1:, axis]
        length, way = np.hypot(*np.diff(line.points, axis=0).T), b - a
        across = np.abs(way) < 1e-9
        ends = (np.array([low, high])[:, None] - a) / np.where(across, 1.0, way)
        share = np.clip(ends.max(axis=0), 0, 1) - np.clip(ends.min(axis=0), 0, 1)
        total += float((length * np.where(across, (a > low) & (a < high), share)).sum())
    return total


def at_step(drawing, step, axis=0):
    """The lines that lie on a step wholly."""
    return [
        line for line in drawing.lines if line.kind != "hatch" and np.abs(line.points3[:, axis] - step).max() < 1e-6
    ]


def upright(lines):
    """From where to where lines reach that lie over one another, end to end."""
    spans: list[tuple[float, float]] = []
    for low, high in sorted(tuple(np.sort(np.round(line.points[[0, -1], 1], 6)).tolist()) for line in lines):
        begin = spans.pop()[0] if spans and spans[-1][1] == low else low
        spans.append((begin, high))
    return spans


@pytest.mark.parametrize("make", [lambda body: body, mesh_of], ids=["solid", "mesh"])
def test_each_piece_is_that_of_its_own_plane_and_the_step_leaves_no_line(make):
    drawing = section(make(plate()), "front", STEPS)
    assert not drawing.notes
    before, after = section(make(plate()), "front", -12.0), section(make(plate()), "front", 12.0)
    for hatch in (False, True):
        assert ink(drawing, -50, 2.9, hatch=hatch) == pytest.approx(ink(before, -50, 2.9, hatch=hatch), abs=0.01)
        assert ink(drawing, 3.1, 50, hatch=hatch) == pytest.approx(ink(after, 3.1, 50, hatch=hatch), abs=0.01)
    assert not at_step(drawing, 3.0)
    assert hatched_area(drawing, 3.0) == pytest.approx((80 - 12 - 8) * 20, rel=0.03)
    assert drawing.counters["lines"] == len(drawing.lines)


def test_it_is_hatched_as_one():
    strokes = hatch_of(section(plate(), "front", STEPS))
    ways = np.diff(strokes, axis=1)[:, 0]
    assert np.ptp(np.arctan2(ways[:, 1], ways[:, 0])) == pytest.approx(0.0, abs=1e-9)
    # A stroke that comes to the step from the left goes on at its right.
    step = 3.0 + 40.0
    ends = {tuple(np.round(end, 6)) for stroke in strokes for end in stroke if abs(end[0] - step) < 1e-6}
    both = [tuple(np.round(end, 6)) for stroke in strokes for end in stroke if abs(end[0] - step) < 1e-6]
    assert ends and len(both) == 2 * len(ends)


@pytest.mark.parametrize("hidden", [False, True])
def test_hidden_lines_have_no_step_either(hidden):
    assert not at_step(section(plate(), "front", STEPS, hidden=hidden), 3.0)


@pytest.mark.parametrize("make", [lambda body: body, mesh_of], ids=["solid", "mesh"])
def test_where_one_side_alone_is_cut_a_line_ends_its_face(make):
    """The step runs through the hole at the left, and the plane behind it goes through the full plate."""
    drawing = section(make(plate()), "front", (-12.0, (-25.0, 12.0)))
    assert upright(at_step(drawing, -25.0)) == [(0.0, 20.0)]
    # A pocket at one side of the step, from the top half way down.
    body = cq.Workplane().box(40, 20, 20).cut(cq.Workplane().box(10, 10, 10).translate((-5, -5, 5)))
    assert upright(at_step(section(make(body), "front", (-2.0, (0.0, 2.0))), 0.0)) == [(10.0, 20.0)]


@pytest.mark.parametrize(
    ("view", "steps", "axis"),
    [
        ("front", (-12.0, (-10.0, 0.0), (10.0, 12.0)), 0),
        ("back", (-12.0, (-10.0, 14.0), (10.0, 2.0)), 0),
        ("left", (-25.0, (-5.0, 25.0)), 1),
        ("right", (10.0, (-5.0, -25.0), (5.0, -26.0)), 1),
        ("top", (-2.0, (3.0, 4.0)), 0),
        ("bottom", (-2.0, (3.0, 4.0)), 0),
        ((0, 0, 3), (-2.0, (3.0, 4.0)), 0),
    ],
)
@pytest.mark.parametrize("make", [lambda body: body, mesh_of], ids=["solid", "mesh"])
def test_steps_lie_along_the_axis_across_the_view(make, view, steps, axis):
    first, *pairs = steps
    drawing = section(make(plate()), view, steps)
    begins, places = [-100.0, *(at for at, _ in pairs), 100.0], [first, *(place for _, place in pairs)]
    for low, high, place in zip(begins, begins[1:], places, strict=False):
        flat = section(make(plate()), view, place)
        for hatch in (False, True):
            found, wanted = (ink(each, low + 0.01, high - 0.01, axis, hatch) for each in (drawing, flat))
            assert found == pytest.approx(wanted, abs=0.1 if hatch else 0.01)
    assert not any(at_step(drawing, at, axis) for at, _ in pairs)
    assert len(drawing.section.corners) == 2 * len(pairs)


def test_units_and_axes_are_those_of_the_file(tmp_path):
    """glTF: metres, y up."""
    path = tmp_path / "body.glb"
    trimesh.creation.box((0.06, 0.04, 0.03)).export(path)
    drawing = section(path, "front", (-10, (5, 12)))
    assert np.array(drawing.section.corners) == pytest.approx(np.array([(0.005, 0, 0.01), (0.005, 0, -0.012)]))
    assert hatched_area(drawing, 3.0) == pytest.approx(60 * 40, rel=0.03)
    assert not at_step(drawing, 0.005)


def test_parts_before_the_planes_go_and_parts_that_touch_at_a_step_keep_their_line():
    parts = [cq.Workplane().box(10, 10, 10).translate((x, y, 0)) for x, y in ((-5, 0), (5, 0), (-5, -20), (5, 20))]
    drawing = section(parts, "front", (-3.0, (0.0, 3.0)))
    assert [part.name for part in drawing.parts] == ["part", "part:2", "part:4"]
    assert drawing.section.parts == (0, 1)
    lines = at_step(drawing, 0.0)
    assert lines and max(line.points[:, 1].max() for line in lines) == pytest.approx(10.0)
    assert {line.kind for line in lines} == {"sharp"}


def test_a_bar_whose_ends_lie_behind_the_planes_is_cut_between_them():
    bar = cq.Workplane().box(80, 10, 10)
    drawing = section(bar, "front", (-5.0, (-10.0, 0.0), (10.0, -5.0)))
    assert hatched_area(drawing, 1.5) == pytest.approx(20 * 10, rel=0.03)


def test_whole_parts_hide_the_hatch_as_far_as_they_lie_before_the_planes():
    shaft = cq.Workplane("XY").circle(5).extrude(60).translate((0, 0, -30))
    bush = cq.Workplane("XY").circle(12).circle(5).extrude(30).translate((0, 0, -15))
    assembly = cq.Assembly().add(shaft, name="shaft").add(bush, name="bush")
    drawing = section(assembly, "front", (3.0, (0.0, -6.0)), uncut=("shaft",))
    x = hatch_of(drawing)[..., 0] + drawing.origin[0]
    # Right of the step the plane lies before the shaft, which is then hidden by the cut bush.
    assert x[x < -1e-6].max() == pytest.approx(-5.0, abs=0.05)
    assert x[x > -1e-6].min() == pytest.approx(0.0, abs=0.05)
    assert [drawing.parts[k].name for k in drawing.section.parts] == ["bush"]


@pytest.mark.parametrize("meshed", [False, True])
def test_faces_on_which_others_rest_are_hatched_as_far_as_their_own_plane_reaches(meshed):
    """The plane lies between a boss and its plate at the left, and goes through the boss at the right."""
    plate, boss = (
        cq.Workplane().box(60, 10, 40).translate((0, 5, 0)),
        cq.Workplane().box(20, 10, 20).translate((0, -5, 0)),
    )
    bodies = {"plate": plate, "boss": boss}
    drawing = section(assembled(bodies, meshed), "front", (0.0, (4.0, -3.0)))
    reach = {}
    for line in drawing.lines:
        if line.kind == "hatch":
            reach.setdefault(drawing.parts[line.part].name, []).append(line.points - [30.0, 20.0])
    found = {name: np.concatenate(points) for name, points in reach.items()}
    assert np.ptp(found["plate"], axis=0) == pytest.approx([14.0, 20.0], abs=0.01)
    assert np.ptp(found["boss"], axis=0) == pytest.approx([6.0, 20.0], abs=0.01)
    assert found["plate"][:, 0].max() == pytest.approx(4.0) == found["boss"][:, 0].min()


def test_a_part_that_a_step_alone_cuts_is_not_said_to_have_no_hatch():
    """The bar lies behind the plane at the left, and before the one at the right."""
    bar, wall = cq.Workplane().box(80, 10, 10), cq.Workplane().box(80, 10, 40).translate((0, 20, 0))
    post = cq.Workplane().box(10, 10, 10).translate((-35, -12, 15))
    drawing = section([bar, wall, post], "front", (-8.0, (10.0, 18.0)))
    assert [drawing.parts[k].name for k in drawing.section.parts] == ["part:2", "part:3"]
    assert not drawing.notes
    # Its end is seen from its edge.
    assert (15.0, 25.0) in upright([line for line in at_step(drawing, 10.0) if drawing.parts[line.part].name == "part"])


def test_equal_parts_that_planes_cut_alike_are_cut_once(monkeypatch):
    from hlr.source.cad import half_space

    calls, cut_at = [], half_space.cut_at
    monkeypatch.setattr(half_space, "cut_at", lambda *asked: calls.append(1) or cut_at(*asked))
    row, bar = cq.Assembly(), cq.Workplane().box(20, 20, 10)
    for k, (x, z, turn) in enumerate(((0, 0, 0), (0, 40, 0), (0, 80, 0), (30, 0, 0), (0, 120, 90))):
        row.add(bar, name=f"bar{k}", loc=cq.Location(cq.Vector(x, 0, z), cq.Vector(0, 1, 0), turn))
    drawing = section(row, "front", (-4.0, (2.0, 4.0)))
    # Three alike, one beside the step, and one that is turned.
    assert len(calls) == 3
    assert len(drawing.section.parts) == 5
    assert not at_step(drawing, 2.0)


@pytest.mark.parametrize(
    ("view", "steps", "options", "message"),
    [
        (
            "front",
            (0.0, (41.0, 5.0)),
            {},
            "section front steps at x = 41, beside the model: .* from -40 to 40 mm there",
        ),
        ("front", (0.0, (1.0, 99.0)), {}, "section front at y = 99 misses the model: Workplane reaches from -25 to 25"),
        ("iso", (0.0, (1.0, 9.0)), {}, "section iso: planes step in views along an axis alone, such as front"),
        ("front", (0.0, (5.0, 9.0), (5.0, 2.0)), {}, "section steps from 5 on, then from 5 on: give its steps in asc"),
        ("front", (0.0, (5.0, 0.0)), {}, "section steps from 0 to 0 at 5: leave this step out"),
        ("front", (0.0, (1.0, 9.0)), {"up": (1, 0, 1)}, "section front steps along an axis, and none runs across"),
    ],
)
def test_steps_that_cannot_be_are_refused(view, steps, options, message):
    with pytest.raises(OptionError, match=message):
        section(plate(), view, steps, **options)


def test_files_state_the_steps_and_are_compared_with_the_model(tmp_path):
    path = tmp_path / "part.step"
    cq.exporters.export(plate(), str(path))
    drawing = section(path, "back", (-12.0, (-3.0, 12.0), (20.0, 11.0)))
    assert len(drawing.section.corners) == 4
    again = hlr.load(drawing.save(tmp_path / "part.json"))
    assert again == drawing and again.section == drawing.section
    svg = drawing.save(tmp_path / "part.svg")
    assert 'section-corners="-3 -12 0 -3 12 0 20 12 0 20 11 0"' in svg.read_text("utf-8")
    assert "cut by a plane that steps" in svg.read_text("utf-8")
    for name in ("part.svg", "part.json"):
        assert hlr.compare.compare(tmp_path / name, path).same
