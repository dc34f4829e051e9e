"""Each class of error: drawings keep the promise, and a drawing spoiled by a known amount is found."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from measure.models import pierced

import hlr
from hlr.drawing.curve import Arc, Bezier
from hlr.drawing.line import Line
from hlr.errors import OptionError
from hlr.lab.measure import measured
from hlr.lab.measure.meshes import mesh_errors
from hlr.lab.measure.paper import Paper
from hlr.lab.measure.written import written
from hlr.source import open_source
from support.at_size import AT_SIZE

ACCURACY = 0.05


@pytest.fixture(scope="module")
def model():
    return open_source(pierced())


@pytest.fixture(scope="module")
def drawing(model):
    return hlr.draw(model, "iso", accuracy=ACCURACY, **AT_SIZE)


@pytest.fixture(scope="module")
def finer(model):
    return hlr.draw(model, "iso", accuracy=ACCURACY / 4, **AT_SIZE)


def judged(model, drawing, finer, lines):
    return measured(model, replace(drawing, lines=tuple(lines)), finer=finer)


def moved(line, by):
    shift = np.array(by)
    curve = line.curve
    if isinstance(curve, Arc):
        curve = replace(curve, centre=curve.centre + shift)
    elif isinstance(curve, Bezier):
        curve = replace(curve, points=curve.points + shift)
    return replace(line, points=line.points + shift, curve=curve)


@pytest.mark.slow
def test_what_is_drawn_keeps_its_promise(model, drawing, finer):
    reached = measured(model, drawing, finer=finer)
    assert reached.kept()
    assert reached.worst <= ACCURACY
    assert 0.0 < reached.edges.worst < 0.5 * ACCURACY
    assert 0.0 < reached.outlines.worst < 0.5 * ACCURACY
    assert reached.changes.count > 4
    assert reached.lost.worst <= ACCURACY
    assert reached.labels.longest <= ACCURACY
    assert reached.meshes.worst is None and "mesh" in reached.meshes.why


@pytest.mark.slow
@pytest.mark.parametrize("kind, name", [("sharp", "edges"), ("outline", "outlines")])
def test_a_line_beside_its_curve_is_found(model, drawing, finer, kind, name):
    i = next(i for i, x in enumerate(drawing.lines) if x.kind == kind and x.curve is not None)
    lines = list(drawing.lines)
    lines[i] = moved(lines[i], (0.0, 3.0 * ACCURACY))
    reached = judged(model, drawing, finer, lines)
    # As far as the shift is across the line.
    assert ACCURACY < getattr(reached, name).worst < 4.0 * ACCURACY
    assert not reached.kept()


def test_a_lost_line_is_found(model, drawing, finer):
    straight = [x for x in drawing.lines if x.curve is None and len(x.points) == 2]
    gone = max(straight, key=lambda x: np.hypot(*(x.points[1] - x.points[0])))
    reached = judged(model, drawing, finer, [x for x in drawing.lines if x is not gone])
    length = np.hypot(*(gone.points[1] - gone.points[0]))
    assert reached.lost.worst == pytest.approx(length, abs=4.0 * ACCURACY)


@pytest.mark.slow
def test_a_wrong_label_is_found(model, drawing, finer):
    straight = [x for x in drawing.lines if x.curve is None and x.visible]
    wrong = max(straight, key=lambda x: np.hypot(*(x.points[-1] - x.points[0])))
    reached = judged(model, drawing, finer, [replace(x, visible=False) if x is wrong else x for x in drawing.lines])
    length = np.hypot(*(wrong.points[-1] - wrong.points[0]))
    assert reached.labels.longest == pytest.approx(length, abs=10.0 * ACCURACY)
    assert reached.labels.share > 0.0
    assert not reached.kept()


def test_a_displaced_change_is_found(model, drawing, finer):
    """A line with a visible and a hidden piece: the one is made longer at the other's expense."""
    lines = list(drawing.lines)
    one, other = next(
        (i, k)
        for i, a in enumerate(lines)
        for k, b in enumerate(lines)
        if a.visible and not b.visible and a.edge == b.edge is not None and a.part == b.part
        if a.curve is None and b.curve is None and np.hypot(*(a.points[-1] - b.points[0])) < ACCURACY
    )
    a, b = lines[one], lines[other]
    way, way3 = b.points[-1] - b.points[0], b.points3[-1] - b.points3[0]
    share = 12.0 * ACCURACY / np.hypot(*way)
    to, to3 = b.points[0] + share * way, b.points3[0] + share * way3
    lines[one] = replace(a, points=np.vstack([a.points[:-1], to]), points3=np.vstack([a.points3[:-1], to3]))
    lines[other] = replace(b, points=np.vstack([to, b.points[1:]]), points3=np.vstack([to3, b.points3[1:]]))
    reached = judged(model, drawing, finer, lines)
    assert reached.changes.worst == pytest.approx(12.0 * ACCURACY, abs=3.0 * ACCURACY)


def test_a_dot_on_its_own_is_found(model, drawing, finer):
    x0, y0, _, _ = drawing.bounds
    points = np.array([(x0 - 5.0, y0), (x0 - 5.0 + 0.4 * ACCURACY, y0)])
    dot = Line("sharp", True, 0, 0, None, points, np.zeros((2, 3)))
    reached = judged(model, drawing, finer, [*drawing.lines, dot])
    assert reached.short.worst == pytest.approx(0.4 * ACCURACY, abs=0.1 * ACCURACY)
    assert not reached.kept()


def test_a_mesh_is_measured_against_its_own_edges():
    import trimesh

    ball = trimesh.creation.icosphere(subdivisions=4, radius=20.0)
    drawing = hlr.draw(ball, "front", accuracy=ACCURACY, **AT_SIZE)
    assert 0.0 < measured(ball, drawing).meshes.worst <= ACCURACY
    spoiled = replace(drawing, lines=tuple(moved(x, (0.4, 0.0)) for x in drawing.lines))
    assert measured(ball, spoiled).meshes.worst > 2.0 * ACCURACY


def test_what_was_not_measured_says_why(model, drawing):
    reached = measured(model, drawing, finer=None, samples=500)
    told = reached.as_dict()
    assert told["meshes"] == {"worst": None, "count": 0, "why": reached.meshes.why}
    assert "seconds" not in told
    with pytest.raises(OptionError, match="asked for"):
        measured(model, replace(drawing, request=None))


@pytest.mark.parametrize("cubic", [False, True])
def test_what_is_written_is_what_is_drawn(drawing, cubic):
    """SVG's arcs, rebuilt from their ends and radii as a renderer does, and PDF's curves."""
    found = written(drawing, cubic=cubic)
    assert (np.unique(found.line) == np.arange(len(drawing.lines))).all()
    for i, line in enumerate(drawing.lines):
        points = found.points[found.line == i]
        if isinstance(line.curve, Arc):
            away = points - line.curve.centre
            u, v = (away @ axis / (axis @ axis) for axis in line.curve.axes)
            assert np.abs(np.hypot(u, v) - 1.0).max() * line.curve.radii[0] < 0.5 * ACCURACY
        if line.curve is None or not line.curve.whole if isinstance(line.curve, Arc) else True:
            assert np.abs(points[[0, -1]] - line.points[[0, -1]]).max() < 0.2 * ACCURACY


@pytest.mark.slow
def test_a_triangle_seen_edge_on_may_fold_at_any_of_its_edges():
    """Flanks of these gears are seen edge-on: rounding says how they are turned, and not the same in the drawing."""
    gears = open_source(Path(__file__).parents[1] / "data" / "cube_gears.3mf")
    drawing = hlr.draw(gears, "iso", accuracy=0.05, **AT_SIZE)
    off, _ = mesh_errors(gears, drawing, written(drawing), Paper.of(drawing))
    assert len(off) > 2000 and off.max() <= 0.05


@pytest.mark.slow
def test_intersections_are_measured_where_the_surfaces_cross():
    import cadquery as cq

    ball = cq.Workplane("XY").sphere(15.0)
    drum = cq.Workplane("XY").circle(9.0).extrude(40.0).translate((4, 3, -20))
    model = open_source(cq.Assembly().add(ball, name="ball").add(drum, name="drum"))
    drawing = hlr.draw(model, "iso", accuracy=ACCURACY, **AT_SIZE)
    reached = measured(model, drawing, samples=500).intersections
    assert reached.count >= 2 and reached.worst <= ACCURACY and "ball" in reached.where
    off = replace(
        drawing,
        lines=tuple(moved(x, (3.0 * ACCURACY, 0.0)) if x.kind == "intersection" else x for x in drawing.lines),
    )
    assert measured(model, off, samples=500).intersections.worst > ACCURACY


@pytest.mark.slow
def test_what_the_pen_is_too_wide_for_is_not_lost():
    # Triangles at random: the finer drawing leaves out other lines than this one.
    model = open_source(Path(__file__).parents[1] / "data" / "soup.stl")
    drawing = hlr.draw(model, "iso")
    assert drawing.counters["left_out"] > 0
    assert measured(model, drawing).lost.worst <= drawing.accuracy.used
    # What is lost by fault is found all the same.
    edges = (line for line in drawing.lines if line.kind != "intersection")
    longest = max(edges, key=lambda line: np.ptp(line.points, axis=0).max())
    reached = judged(model, drawing, None, [line for line in drawing.lines if line is not longest])
    assert reached.lost.worst > 1.0
