"""What the pen can show: thinner line groups, what is left out, and that no outline and no bit of ink goes astray."""

import io
import json
from dataclasses import replace

import numpy as np
import pytest

import hlr
from hlr.drawing.pens import LINE_GROUPS
from hlr.request.effect import everything_on
from support.measures import distances, samples, segments
from support.meshes import box

THINNEST = LINE_GROUPS[-1]


def joined(meshes):
    """One mesh of several."""
    starts = np.cumsum([0, *(len(points) for points, _ in meshes)])
    points = np.concatenate([points for points, _ in meshes])
    return points, np.concatenate([faces + start for (_, faces), start in zip(meshes, starts[:-1], strict=True)])


def fins(count, pitch):
    """Upright fins on a plate, seen from the front as lines at half the pitch."""
    plate = box((-5, 0, 0), (count * pitch + 5, 10, 5))
    return joined([plate, *(box((i * pitch, 2, 5), (i * pitch + pitch / 2, 8, 25)) for i in range(count))])


def pins(rows, pitch, side):
    """A pin header: square pins on a plate."""
    plate = box((-3, -3, 0), (rows * pitch + 3, rows * pitch + 3, 2))
    at = [(x * pitch, y * pitch) for x in range(rows) for y in range(rows)]
    return joined([plate, *(box((x, y, 2), (x + side, y + side, 6)) for x, y in at)])


def turned_profile(radii, heights, sides=96):
    """A closed body of revolution about z: rings at these radii and heights between two poles."""
    angles = np.arange(sides) * 2 * np.pi / sides
    rings = [
        np.stack([r * np.cos(angles), r * np.sin(angles), np.full(sides, z)], 1)
        for r, z in zip(radii, heights, strict=True)
    ]
    points = np.concatenate([*rings, [[0, 0, heights[0]], [0, 0, heights[-1]]]])
    faces, last = [], len(radii) - 1
    for i in range(sides):
        j = (i + 1) % sides
        for k in range(last):
            a, b, c, d = k * sides + i, k * sides + j, (k + 1) * sides + j, (k + 1) * sides + i
            faces += [(a, b, c), (a, c, d)]
        faces += [(len(points) - 2, j, i), (len(points) - 1, last * sides + i, last * sides + j)]
    return points, np.array(faces, np.int32)


def threaded(turns=60, pitch=0.4):
    """Grooves instead of a helix: a crest and a root per turn."""
    heights = np.arange(2 * turns + 1) * pitch / 2
    return turned_profile(5.0 + 0.3 * (np.arange(2 * turns + 1) % 2), heights)


def knurled(teeth=200, radius=8.0):
    """A cylinder with straight knurls along its axis."""
    angles = np.arange(2 * teeth) * np.pi / teeth
    r = radius + 0.15 * (np.arange(2 * teeth) % 2)
    low = np.stack([r * np.cos(angles), r * np.sin(angles), np.zeros(2 * teeth)], 1)
    n = 2 * teeth
    points = np.concatenate([low, low + (0, 0, 12), [[0, 0, 0], [0, 0, 12]]])
    faces = []
    for i in range(n):
        j = (i + 1) % n
        faces += [(i, j, n + j), (i, n + j, n + i), (2 * n, j, i), (2 * n + 1, n + i, n + j)]
    return points, np.array(faces, np.int32)


MODELS = {
    "fins": (fins(60, 0.4), "front"),
    "pins": (pins(20, 0.6, 0.2), "top"),
    "thread": (threaded(), "front"),
    "knurl": (knurled(), "front"),
}


def both(name, **options):
    """The drawing by the rule, and all its lines."""
    model, view = MODELS[name]
    options = {"scale": 1.0, **options}
    return hlr.draw(model, view, **options), hlr.draw(model, view, details=True, **options)


def numbers(drawing):
    return {note.code: note.text for note in drawing.notes}


def shapes(lines):
    """What is drawn, whatever its order."""
    return sorted((line.kind, line.visible, line.points.tobytes()) for line in lines)


def extent(points):
    return float(np.ptp(points, axis=0).max())


@pytest.mark.parametrize("name", MODELS)
def test_crowded_lines_are_drawn_thinner_and_what_is_left_out_lies_beside_what_stays(name):
    drawing, whole = both(name)
    assert drawing.group == THINNEST
    assert whole.group is None
    out = len(whole.lines) - len(drawing.lines)
    assert out == drawing.counters["left_out"] > 0 == whole.counters["left_out"]
    assert f"{out:,} lines are left out" in numbers(drawing)["details-left-out"]
    assert not {"thin-lines", "crowded", "details-left-out"} & set(numbers(whole))
    kept = set(shapes(drawing.lines))
    assert kept < set(shapes(whole.lines))
    for visible, pen in ((True, THINNEST[0]), (False, THINNEST[1])):
        gone = [line for line in whole.lines if line.visible == visible and shapes([line])[0] not in kept]
        seen = segments(replace(drawing, lines=[line for line in drawing.lines if line.visible == visible]))
        gone = [line for line in gone if extent(line.points) > pen]
        if gone:
            lost = segments(replace(drawing, lines=gone))
            assert distances(samples(lost, pen / 2), seen).max() <= pen + 0.01
    assert drawing.bounds == whole.bounds


def test_all_pins_smaller_than_the_pen_go_and_the_plate_stays():
    drawing, whole = both("pins", hidden=False)
    assert len(drawing.lines) == 4
    assert len(whole.lines) == 4 + 400 * 4


def test_a_larger_scale_than_the_note_names_needs_nothing_left_out():
    crowded = numbers(both("fins")[0])["crowded"]
    assert "would separate most" in crowded
    scale = crowded.split(": ")[1].split(":")[0]
    assert "crowded" not in numbers(both("fins", scale=float(scale))[0])


def test_nothing_is_looked_for_where_lines_are_far_apart():
    drawing = hlr.draw(box((0, 0, 0), (30, 20, 10)), "iso")
    assert drawing.counters["left_out"] == 0
    assert drawing.group is None
    with everything_on():
        assert hlr.draw(box((0, 0, 0), (30, 20, 10)), "iso").to_svg() == drawing.to_svg()


def test_threads_and_the_order_of_triangles_change_nothing():
    (points, faces), view = MODELS["fins"]
    one = hlr.draw((points, faces), view, scale=1, threads=1)
    assert hlr.draw((points, faces), view, scale=1, threads=2).to_svg() == one.to_svg()
    other = hlr.draw((points, np.random.default_rng(3).permutation(faces)), view, scale=1)
    assert shapes(other.lines) == shapes(one.lines)


def test_the_group_is_kept_in_json_and_its_widths_are_in_svg_and_pdf():
    drawing, whole = both("fins")
    assert hlr.load(_text(drawing)) == drawing
    assert 'stroke-width=".25"' in drawing.to_svg()
    assert json.loads(_text(drawing).read())["group"] == list(THINNEST)
    assert "group" not in json.loads(whole.to_json())


def test_another_style_keeps_the_group_unless_it_names_widths():
    drawing, _ = both("fins")
    model, view = MODELS["fins"]
    asked = hlr.draw(model, view, scale=1, style="dark")
    assert drawing.with_style("dark").to_svg() == asked.to_svg()
    assert drawing.with_style("asme").with_style("dark").to_svg() == asked.to_svg()
    assert 'stroke-width=".6"' in drawing.with_style("asme").to_svg()


@pytest.mark.parametrize(
    ("wall_mm", "group"), [(0.3, LINE_GROUPS[-1]), (0.4, LINE_GROUPS[-1]), (0.5, LINE_GROUPS[-2]), (0.8, None)]
)
def test_hidden_lines_beside_visible_ones_have_white_between_them(wall_mm, group):
    """A tray with thin walls: the dashes of the inner side do not run into the outline."""
    cq = pytest.importorskip("cadquery")
    tray = cq.Workplane().box(100, 60, 30).faces(">Z").shell(-wall_mm)
    for view in ("front", "right"):
        drawing = hlr.draw(tray, view, scale=1)
        assert len(drawing.hidden) == 3 and drawing.group == group
        assert [note.code for note in drawing.notes] == ([] if group is None else ["thin-lines"])
        assert hlr.draw(tray, view, scale=1, hidden=False).group is None
    wide, narrow = group or LINE_GROUPS[1]
    assert wall_mm - 0.5 * (wide + narrow) > 0.1


def test_widths_that_are_asked_for_stay():
    model, view = MODELS["fins"]
    for style in ({"wide": 0.5}, "asme"):
        drawing = hlr.draw(model, view, scale=1, style=style)
        assert drawing.group is None
        assert drawing.counters["left_out"] > 0


def _text(drawing):
    return io.StringIO(drawing.to_json())


@pytest.mark.parametrize("scale", [1 / 16, 1 / 512, 1e-5])
def test_a_drawing_so_small_that_its_accuracy_is_below_a_thousandth_of_a_millimetre(scale):
    drawn = hlr.draw(box((0, 0, 0), (10, 20, 30)), "front", scale=scale)
    assert drawn.lines and drawn.accuracy.used < 1e-3
