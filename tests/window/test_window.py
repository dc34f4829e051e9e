"""The window of a drawing: cut exactly after hiding, two halves make the whole, and what lies outside still hides."""

import io
import json
import subprocess
import sys
from collections import Counter

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.drawing.curve import Arc, Bezier
from hlr.drawing.drawing import DrawnView
from hlr.drawing.fill import Fill
from hlr.drawing.line import Bounds, Line
from hlr.request.drawing_effects import drawing_effects
from hlr.request.effect import Planner
from hlr.window.cut import cut_at_window
from hlr.window.fill import cut_fill
from hlr.window.frame import Frame
from hlr.window.lines import cut_lines
from support.at_size import AT_SIZE
from support.models import box

FLAT = DrawnView("top", "orthographic", (0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
LEVEL, RAISED = (0, 0, 0), (0, 0, 20)


def housing():
    """Straight edges, circles, ellipses, an intersection of cylinders (fitted curves), and tangent edges."""
    block = cq.Workplane().box(40, 30, 20).edges("|Z").fillet(4)
    return block.faces(">Z").workplane().hole(12).union(cq.Workplane("XZ").cylinder(60, 7))


def frame(x0, y0, x1, y1):
    return Frame(FLAT, 1.0, Bounds(x0, y0, x1, y1))


def line(points, curve=None):
    points = np.array(points, float)
    return Line("sharp", True, 0, None, None, points, np.column_stack([points, np.zeros(len(points))]), curve=curve)


def lengths(drawing):
    """Of all lines of each class, hidden and visible, along their curves."""
    found = Counter()
    for each in drawing.lines:
        found[each.kind, each.visible] += length(each)
    return found


def length(each):
    curve = each.curve
    if curve is None:
        points = each.points
    elif isinstance(curve, Arc):
        points = curve.at(np.linspace(*curve.angles, 2000))
    else:
        points = curve.at(np.linspace(0.0, (len(curve.points) - 1) // curve.degree, 2000))
    return float(np.hypot(*np.diff(points, axis=0).T).sum())


def tolerant(found):
    return {key: pytest.approx(value, abs=2e-3) for key, value in found.items()}


CAMERAS = [{}, {"perspective": hlr.Perspective(fov=70.0)}]


@pytest.mark.slow
@pytest.mark.parametrize("options", CAMERAS)
@pytest.mark.parametrize("across", [0, 1])
def test_two_windows_side_by_side_make_the_whole(options, across):
    whole = hlr.draw(housing(), **AT_SIZE | {"smooth": True} | options)
    low, high = np.array(whole.bounds[:2]), np.array(whole.bounds[2:])
    middle = low[across] + 0.37 * (high - low)[across]
    first, second = [*low, *high], [*low, *high]
    first[2 + across] = second[across] = middle
    halves = [hlr.draw(housing(), window=tuple(w), **AT_SIZE | {"smooth": True} | options) for w in (first, second)]
    total = sum((lengths(half) for half in halves), Counter())
    assert total == tolerant(lengths(whole)) and all(half.lines for half in halves)
    for half, window in zip(halves, (first, second), strict=True):
        ends = 0
        for each in half.lines:
            for points in (each.points, *([] if each.curve is None else [along(each.curve)])):
                expect_within(points, window)
            ends += sum(point[across] == middle for point in each.points[[0, -1]])
            expect_ends_of_curves(each)
        assert ends >= 4
    # Both halves end at the same places.
    cuts = [sorted(p[1 - across] for x in h.lines for p in x.points[[0, -1]] if p[across] == middle) for h in halves]
    assert cuts[0] == pytest.approx(cuts[1], abs=1e-9)


def expect_within(points, window):
    assert (points >= np.array(window[:2]) - 1e-6).all() and (points <= np.array(window[2:]) + 1e-6).all()


def along(curve):
    end = 1.0 if isinstance(curve, Arc) else (len(curve.points) - 1) // curve.degree
    t = np.linspace(0.0, end, 100)
    return curve.at(curve.angles[0] + t * np.diff(curve.angles) if isinstance(curve, Arc) else t)


def expect_ends_of_curves(each):
    if each.curve is not None:
        assert along(each.curve)[[0, -1]] == pytest.approx(each.points[[0, -1]], abs=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("options", CAMERAS)
def test_points_in_the_model_are_those_that_are_seen(options):
    whole = hlr.draw(housing(), **AT_SIZE | options)
    b = whole.bounds
    cut = hlr.draw(
        housing(), window=(0.3 * b.width, 0.3 * b.height, 0.6 * b.width, 0.6 * b.height), **AT_SIZE | options
    )
    view, off = cut.view, {}
    for drawing in (whole, cut):
        worst = 0.0
        for each in drawing.lines:
            from_eye = each.points3 - np.array(view.eye or (0.0, 0.0, 0.0))
            size = 1.0 if view.eye is None else (view.distance / -(from_eye @ np.array(view.direction)))[:, None]
            seen = np.stack([from_eye @ np.array(view.right), from_eye @ np.array(view.up)], axis=1)
            seen = seen * size * drawing.scale - np.array(drawing.origin)
            worst = max(worst, float(np.abs(seen - each.points).max()))
        off[drawing is cut] = worst
    assert off[True] <= max(off[False], 1e-9)


def test_what_lies_outside_still_hides():
    # A large plate before a small box: no edge of the plate is in the window, and still it hides the box.
    plate = cq.Workplane().box(60, 60, 2).translate(RAISED)
    model = cq.Assembly().add(plate, name="plate").add(cq.Workplane().box(10, 10, 10), name="box")
    found = hlr.draw(model, "top", window=(20, 20, 40, 40), **AT_SIZE)
    assert {found.parts[each.part].name for each in found.lines} == {"box"}
    assert found.hidden and not found.visible


def test_a_circle_cut_by_one_side_is_one_arc():
    circle = Arc(np.array([10.0, 10.0]), np.array([[5.0, 0.0], [0.0, 5.0]]), np.array([0.0, 2.0 * np.pi]))
    whole = line(circle.at(np.linspace(0, 2 * np.pi, 41)), circle)
    (left,), cuts = cut_lines([whole], frame(0, 0, 12.5, 20))
    assert cuts == 1 and left.points[0].tolist() == pytest.approx([12.5, 10 + 5 * np.sin(np.pi / 3)], abs=1e-12)
    assert left.curve.angles.tolist() == pytest.approx([np.pi / 3, 5 * np.pi / 3], abs=1e-12)
    # The other side holds the circle's start: its two ends are one arc again.
    (right,), _ = cut_lines([whole], frame(12.5, 0, 20, 20))
    assert right.curve.angles.tolist() == pytest.approx([5 * np.pi / 3, 7 * np.pi / 3], abs=1e-12)
    assert (np.diff(right.points[:, 1]) > 0).all()
    # Through all four sides, backward: four arcs.
    back = Arc(circle.centre, circle.axes, np.array([7.0, 7.0 - 2.0 * np.pi]))
    four, _ = cut_lines([line(back.at(np.linspace(7.0, 7.0 - 2 * np.pi, 41)), back)], frame(6, 6, 14, 14))
    assert len(four) == 4 and sum(map(length, four)) == pytest.approx(5 * (2 * np.pi - 8 * np.arccos(0.8)), abs=1e-4)


def test_a_curve_that_touches_or_leaves_and_comes_back():
    arch = Bezier(3, np.array([[0.0, 0.0], [0.0, 8.0], [8.0, 8.0], [8.0, 0.0]]))  # its top is at 6
    whole = line(arch.at(np.linspace(0, 1, 30)), arch)
    (same,), cuts = cut_lines([whole], frame(-1, -1, 9, 6))
    assert same is whole and cuts == 0
    two, _ = cut_lines([whole], frame(-1, -1, 9, 4.5))  # y = 24 s (1 - s) = 4.5: s = 1/4 and 3/4
    assert [each.points[-1, 1] for each in two[:1]] == [4.5] == [two[1].points[0, 1]]
    assert two[0].curve.points[-1].tolist() == pytest.approx(arch.at(0.25).tolist(), abs=1e-12)
    assert cut_lines([whole], frame(-1, 6.001, 9, 7))[0] == ()
    parabola = Bezier(2, np.array([[0.0, 0.0], [4.0, 8.0], [8.0, 0.0], [12.0, -8.0], [16.0, 0.0]]))
    (low,), _ = cut_lines([line(parabola.at(np.linspace(0, 2, 40)), parabola)], frame(6, -9, 10, 9))
    t = (low.curve.points[0, 0], low.curve.points[-1, 0], len(low.curve.points))
    assert t == (6.0, 10.0, 5)


def test_a_line_along_a_side_is_drawn_on_both_sides_and_its_last_digit_does_not_matter():
    along_side, beyond = line([[0, 5], [9, 5]]), line([[0, 5 + 1e-9], [9, 5 + 1e-9]])
    for window in (frame(1, 0, 8, 5), frame(1, 5, 8, 9)):
        for each in (along_side, beyond):
            (cut,), _ = cut_lines([each], window)
            assert cut.points.tolist() == pytest.approx(np.array([[1, 5], [8, 5]]), abs=1e-8)
    assert cut_lines([line([[0, 5.001], [9, 5.001]])], frame(1, 0, 8, 5)) == ((), 1)
    # A corner that only touches the window leaves nothing.
    assert cut_lines([line([[0, 2], [1, 1], [0, 0]])], frame(1, 0, 3, 3)) == ((), 1)


def test_a_polyline_that_comes_and_goes():
    zigzag = line([[0, 0], [4, 4], [8, 0], [12, 4], [16, 0]])
    cut, _ = cut_lines([zigzag], frame(1, 1, 15, 3))
    assert [each.points.tolist() for each in cut] == [
        [[1, 1], [3, 3]], [[5, 3], [7, 1]], [[9, 1], [11, 3]], [[13, 3], [15, 1]],
    ]  # fmt: skip


# Faces


def area(fill, spacing=0.05, size=10):
    """How often each place of a fine grid is covered, by the even-odd rule of each face."""
    # Off the corners, the diagonals and all that lies between them.
    x, y = np.meshgrid(np.arange(spacing / np.e, size, spacing), np.arange(spacing / np.pi, size, spacing))
    covered = np.zeros(x.shape, int)
    for k in range(len(fill.part)):
        inside = np.zeros(x.shape, bool)
        for j in range(fill.faces[k], fill.faces[k + 1]):
            p = fill.points[fill.loops[j] : fill.loops[j + 1]]
            for (ax, ay), (bx, by) in zip(p, np.roll(p, -1, axis=0), strict=True):
                between = (ay <= y) != (by <= y)
                with np.errstate(all="ignore"):
                    inside ^= between & (x < ax + (y - ay) * (bx - ax) / (by - ay))
        covered += inside
    return x, y, covered


def fill_of(*faces):
    loops = [loop for face in faces for loop in face]
    count = len(faces)
    return Fill(
        np.array([p for loop in loops for p in loop], float),
        np.cumsum([0, *map(len, loops)]).astype(np.int32),
        np.cumsum([0, *map(len, faces)]).astype(np.int32),
        np.full((count, 4), 255, np.uint8),
        np.full(count, -1, np.int32),
        (),
        np.arange(count, dtype=np.int32),
        0.1,
    )


@pytest.mark.parametrize("seed", range(20))
def test_faces_are_cut_to_what_lies_inside(seed):
    random = np.random.default_rng(seed)
    # On a coarse grid: corners and whole edges on the sides of the window, loops through themselves, holes.
    faces = [[random.integers(0, 11, (random.integers(3, 9), 2)).tolist() for _ in range(2)] for _ in range(3)]
    fill, window = fill_of(*faces), Bounds(3.0, 2.0, 7.0, 8.0)
    x, y, before = area(fill)
    after = area(cut_fill(fill, window)[0])[2]
    inside = (x > 3) & (x < 7) & (y > 2) & (y < 8)
    assert (after == np.where(inside, before, 0)).all()


def test_no_seam_is_left_where_there_is_no_face():
    comb = [[[1, 1], [9, 1], [9, 3], [3, 3], [3, 5], [9, 5], [9, 7], [1, 7]]]
    cut, cuts = cut_fill(fill_of(comb), Bounds(5.0, 0.0, 10.0, 8.0))
    assert cuts == 1 and len(cut.loops) == 3
    for start, end in zip(cut.loops[:-1], cut.loops[1:], strict=True):
        assert np.ptp(cut.points[start:end, 1]) == 2  # two teeth, nothing between them


@pytest.mark.slow
def test_fill_and_its_gradients_are_cut():
    whole = hlr.draw(housing(), fill=True, hidden=False, scale=1.0, smooth=False)
    b = whole.bounds
    cut = hlr.draw(
        housing(), fill=True, hidden=False, window=(0.0, 0.0, 0.5 * b.width, b.height), scale=1.0, smooth=False
    )
    assert 0 < len(cut.fill.part) <= len(whole.fill.part) and cut.fill.points[:, 0].max() == 0.5 * b.width
    assert set(cut.fill.gradient.tolist()) - {-1} == set(range(len(cut.fill.gradients)))
    # A window within a face shows no line, and that is no reason for a warning.
    inside = hlr.draw(box((30, 30, 30)), "top", fill=True, window=(10, 10, 20, 20), **AT_SIZE)
    assert not inside.lines and len(inside.fill.part) == 1 and not [n for n in inside.notes if n.is_warning]


# The drawing, its page and its plan


def effect(plan):
    return next(d for d in plan if d.name == "window")


def test_nothing_is_done_where_nothing_crosses_the_window():
    model = housing()
    whole = hlr.draw(model, **AT_SIZE)
    b = whole.bounds
    assert not effect(whole.plan).on and effect(whole.plan).reason == "no window was asked for"
    for window, sides in (((-1, -1, b.x1 + 1, b.y1 + 1), 0), ((0, 0, b.width / 2, b.height / 2), 2)):
        drawn, (plan,) = (
            hlr.draw(model, window=window, **AT_SIZE),
            hlr.plan_views(model, ["iso"], hlr.Options(window=window, **AT_SIZE)),
        )
        for found in (effect(drawn.plan), effect(plan.decisions)):
            assert found.on == (sides > 0) and ("2 sides" if sides else "all lies within the window") in found.reason
        assert (effect(drawn.plan).counts["window_cuts"] > 0) == (sides > 0)
        if not sides:
            assert drawn.lines == whole.lines and drawn.area == Bounds(*window) and drawn.page is None


def test_the_page_is_the_window_and_json_holds_it():
    drawn = hlr.draw(housing(), window=(10, 5, 30, 45), **AT_SIZE)
    svg = drawn.to_svg()
    assert 'width="31mm" height="51mm"' in svg and 'viewBox="4.5 -50.5 31 51"' in svg
    document = json.loads(drawn.to_json())
    assert document["window"] == [10, 5, 30, 45] and "window" not in json.loads(
        hlr.draw(housing(), **AT_SIZE).to_json()
    )
    again = hlr.load(io.BytesIO(drawn.to_json().encode()))
    assert again == drawn and again.window == Bounds(10, 5, 30, 45) and again.to_svg() == svg
    assert drawn != hlr.draw(housing(), window=(10, 5, 30, 46), **AT_SIZE)


def test_the_note_on_an_empty_window_rounds_its_numbers():
    lines = [line([(-2.2e-15, 1e-9), (20 / 3, 100 / 3)])]
    planner = Planner(drawing_effects(), hlr.Options(window=(100, 100, 400 / 3, 130)))
    _, _, (note,) = cut_at_window(lines, None, frame(100, 100, 400 / 3, 130), planner)
    assert note.text == (
        "nothing of the drawing lies in the window 100,100,133.333,130: without it the drawing is 0,0,6.667,33.333 "
        "(x0,y0,x1,y1 in millimetres)"
    )


def test_a_window_that_shows_nothing_is_drawn_empty_with_a_note():
    drawn = hlr.draw(box((10, 10, 10)), "top", window=(100, 100, 140, 130), **AT_SIZE)
    (note,) = [n for n in drawn.notes if n.code == "nothing-in-view"]
    assert note.text == (
        "nothing of the drawing lies in the window 100,100,140,130: without it the drawing is 0,0,10,10 "
        "(x0,y0,x1,y1 in millimetres)"
    )
    assert drawn.lines == () and 'width="51mm" height="41mm"' in drawn.to_svg() and drawn.to_pdf()
    with pytest.raises(hlr.StrictError):
        hlr.draw(box((10, 10, 10)), "top", window=(100, 100, 140, 130), strict=True, **AT_SIZE)


@pytest.mark.parametrize(
    ("window", "why"),
    [
        ((0, 0, 0, 5), "the window 0,0,0,5 holds nothing"),
        ((5, 0, 0, 5), "the window 5,0,0,5 holds nothing"),
        ((0, 5, 5, 0), "x0 < x1 and y0 < y1"),
        ((0, 0, float("nan"), 5), "four numbers"),
        ((0, 0, float("inf"), 5), "four numbers"),
        ((0, 0, 1e300, 5), "at most 10000000, not"),
        ((0, 0, 5), "four numbers"),
        ("0,0,5,5", "four numbers"),
        (7, "four numbers"),
    ],
)
def test_windows_that_are_none_are_refused(window, why):
    with pytest.raises(hlr.OptionError, match=why):
        hlr.draw(box((10, 10, 10)), window=window, **AT_SIZE)


def test_what_was_reached_is_that_of_the_whole_drawing():
    model = box((10, 10, 10))
    whole, cut = hlr.draw(model, report=True, **AT_SIZE), hlr.draw(model, report=True, window=(0, 0, 8, 8), **AT_SIZE)
    assert cut.reached == whole.reached and cut.window is not None and len(cut.lines) < len(whole.lines)


@pytest.mark.slow
def test_the_command(tmp_path):
    box((10, 10, 10)).export(tmp_path / "a.stl")

    def run(*arguments):
        command = [sys.executable, "-P", "-m", "hlr", *arguments]
        return subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)

    assert run("draw", "a.stl", "-o", "a.json", "--view", "top", "--window", "-2,-2,5,5").returncode == 0
    drawn = hlr.load(tmp_path / "a.json")
    assert drawn.window == (-2, -2, 5, 5) and drawn.bounds == (0, 0, 5, 5)
    for wrong, why in (("5,5,0,0", "holds nothing"), ("0,0,nan,5", "0,0,100,80"), ("1,2,3", "0,0,100,80")):
        done = run("draw", "a.stl", "-o", "b.svg", "--window", wrong)
        assert done.returncode == 2 and why in done.stderr and len(done.stderr.splitlines()) <= 3
        assert not (tmp_path / "b.svg").exists()
    planned = run("plan", "a.stl", "--window", "0,0,5,5")
    assert "beyond 2 sides of the window" in planned.stdout
