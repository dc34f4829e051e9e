"""Lines of B-rep edges lie on their edges' true curves, by OpenCASCADE's own evaluation."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hlr
from hlr.drawing.curve import Arc, Bezier, arc_bounds, bezier_bounds, raised
from hlr.drawing.saving import render
from hlr.source import open_source
from support.at_size import AT_SIZE
from support.true_curves import DENSE, bends_without_curve, distance, measured, on_paper, samples, true_curves

cq = pytest.importorskip("cadquery")
DATA = Path(__file__).parents[1] / "data"
RANDOM_VIEWS = np.random.default_rng(7).normal(size=(6, 3)).tolist()


def edge_sheet(edge: Any) -> Any:
    """A face swept from an edge: its first edge is that edge."""
    from OCP.BRepPrimAPI import BRepPrimAPI_MakePrism
    from OCP.gp import gp_Vec

    return cq.Shape.cast(BRepPrimAPI_MakePrism(edge.wrapped, gp_Vec(1, 2, 9)).Shape())


def test_a_flat_face_is_bounded_by_arcs_though_no_face_is_curved() -> None:
    disc = cq.Face.makeFromWires(cq.Wire.makeCircle(5, cq.Vector(), cq.Vector(0, 0, 1)))
    (line,) = hlr.draw(disc, view="top", **AT_SIZE).lines
    assert isinstance(line.curve, Arc) and line.curve.axes[0] @ line.curve.axes[0] == pytest.approx(25)


def test_without_curved_edges_no_curve_is_looked_up() -> None:
    box = hlr.draw(cq.Workplane().box(3, 2, 1), view="iso", **AT_SIZE)
    assert box.counters["curves_sought"] == 0 and len(box.lines) == 12
    assert all(line.curve is None for line in box.lines)


def conics() -> dict[str, Any]:
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge
    from OCP.gp import gp_Ax2, gp_Circ, gp_Dir, gp_Elips, gp_Hypr, gp_Parab, gp_Pnt

    frame = gp_Ax2(gp_Pnt(3, -1, 2), gp_Dir(0.2, 0.3, 1))
    made = {
        "circle": BRepBuilderAPI_MakeEdge(gp_Circ(frame, 12.0)),
        "arc": BRepBuilderAPI_MakeEdge(gp_Circ(frame, 12.0), 5.0, 8.5),
        "ellipse": BRepBuilderAPI_MakeEdge(gp_Elips(frame, 15.0, 4.0), 1.0, 6.0),
        "parabola": BRepBuilderAPI_MakeEdge(gp_Parab(frame, 3.0), -12.0, 20.0),
        "hyperbola": BRepBuilderAPI_MakeEdge(gp_Hypr(frame, 5.0, 4.0), -1.5, 2.0),
    }
    points = [cq.Vector(0, 0, 0), cq.Vector(10, 5, 2), cq.Vector(14, -3, 8), cq.Vector(25, 4, 1)]
    shapes = {name: cq.Edge(maker.Edge()) for name, maker in made.items()}
    return shapes | {"spline": cq.Edge.makeSpline(points), "closed spline": cq.Edge.makeSpline(points, periodic=True)}


EXACT = {"circle": Arc, "arc": Arc, "ellipse": Arc, "parabola": Bezier, "spline": Bezier, "closed spline": Bezier}


@pytest.mark.slow
@pytest.mark.parametrize("name", list(conics()))
@pytest.mark.parametrize("perspective", [None, hlr.Perspective()])
def test_conics_and_splines_in_random_views(name: str, perspective: Any) -> None:
    sheet = edge_sheet(conics()[name])
    true = true_curves(open_source(sheet))
    options = hlr.Options(perspective=perspective, **AT_SIZE)
    for drawing in hlr.draw_views(sheet, [tuple(v) for v in RANDOM_VIEWS], options):
        off, _, forms, _ = measured(drawing, true)
        # What is exact is off only by how finely the measure samples, or, drawn as a straight line, by a twentieth.
        exact = name in EXACT and (perspective is None or EXACT[name] is Arc)
        assert off < (0.06 if exact else 0.25), (drawing.view.direction, forms)
        assert "polyline" not in forms
        curves = {type(line.curve) for line in drawing.lines if line.edge is not None and line.curve is not None}
        assert curves == {EXACT[name] if exact else Bezier}


def test_degrees_say_which_curves_are_exact() -> None:
    parabola = hlr.draw(edge_sheet(conics()["parabola"]), (1, 2, 3), **AT_SIZE)
    assert {line.curve.degree for line in parabola.lines if line.curve} == {2}
    spline = hlr.draw(edge_sheet(conics()["spline"]), (1, 2, 3), **AT_SIZE)
    assert {line.curve.degree for line in spline.lines if line.curve} == {3}


def test_pieces_are_intervals_of_one_curve() -> None:
    """The rim of a cylinder, half of it hidden: two arcs of one ellipse that meet."""
    drawing = hlr.draw(cq.Workplane().cylinder(20, 10), "iso", **AT_SIZE)
    rim = [line for line in drawing.lines if isinstance(line.curve, Arc) and line.points3[:, 2].max() < 0]
    assert {line.visible for line in rim} == {True, False}
    a, b = (line.curve for line in rim)
    assert np.array_equal(a.centre, b.centre) and np.array_equal(a.axes, b.axes)
    # The hidden one begins where the visible one's ink ends beside it.
    turned = sum(abs(c.angles[1] - c.angles[0]) for c in (a, b))
    assert 0.9 * 2 * math.pi < turned <= 2 * math.pi + 1e-9


def test_a_circle_from_above_is_whole_and_edge_on_a_straight_line() -> None:
    body = cq.Workplane().circle(7).extrude(2)
    (line,) = [line for line in hlr.draw(body, "top", **AT_SIZE).lines if line.visible]
    assert isinstance(line.curve, Arc) and line.curve.whole
    assert line.curve.radii == pytest.approx((7.0, 7.0), abs=1e-12)
    drawing = hlr.draw(body, "front", **AT_SIZE)
    assert drawing.bounds == pytest.approx((0.0, 0.0, 14.0, 2.0), abs=1e-9)
    assert all(line.curve is None for line in drawing.lines)
    assert b"<circle" in render(hlr.draw(body, "top", **AT_SIZE), "svg")


def test_a_mirrored_and_moved_part_draws_its_own_curves() -> None:
    body = cq.Workplane().box(20, 10, 4).faces(">Z").workplane().center(4, 2).hole(3).edges("|Z").fillet(1.0)
    shape = body.val().mirror("YZ").moved(cq.Location(cq.Vector(30, -5, 2), cq.Vector(1, 2, 3), 70))
    assembly = cq.Assembly().add(shape, name="m").add(shape, name="n", loc=cq.Location(cq.Vector(0, 0, 9)))
    true = true_curves(open_source(assembly))
    for drawing in hlr.draw_views(assembly, ["iso", "front"], hlr.Options(**AT_SIZE)):
        off, _, forms, _ = measured(drawing, true)
        assert off < 0.05 and forms["Arc"] > 6


@pytest.mark.slow
@pytest.mark.parametrize("name", ["nist_ctc_01_asme1_ap242-e1.stp", "as1-oc-214.stp"])
def test_real_files(name: str) -> None:
    true = true_curves(open_source(DATA / name))
    drawings = [
        hlr.draw(DATA / name, **AT_SIZE),
        hlr.draw(DATA / name, (3, -2, 1), perspective=hlr.Perspective(), **AT_SIZE),
    ]
    for drawing in drawings:
        off, polylines, _, where = measured(drawing, true)
        assert off < 0.5, where
        assert polylines < 1.0


def test_a_drawing_off_by_half_an_accuracy_is_noticed() -> None:
    body = cq.Workplane().cylinder(20, 10)
    drawing = hlr.draw(body, "iso", **AT_SIZE)
    line = next(line for line in drawing.lines if isinstance(line.curve, Arc))
    path = on_paper(drawing, true_curves(open_source(body))(drawing.parts[line.part].name, line.edge))
    accuracy = drawing.accuracy.used
    assert distance(samples(line), path) < 0.01 * accuracy
    assert distance(samples(line) + 0.5 * accuracy, path) > 0.3 * accuracy


def test_points_run_along_the_curve() -> None:
    drawing = hlr.draw(DATA / "nist_ctc_01_asme1_ap242-e1.stp", **AT_SIZE)
    for line in drawing.lines:
        if line.curve is not None:
            assert distance(line.points, samples(line)) <= drawing.accuracy.used
            ends = samples(line)[[0, -1]]
            assert line.points[[0, -1]] == pytest.approx(ends, abs=1e-6)


def test_t_junctions_close() -> None:
    """A pin before a plate with a round hole: the rim vanishes behind the pin's outline, on it."""
    plate = cq.Workplane("XZ").rect(60, 40).circle(12).extrude(-3)
    pin = cq.Workplane("XZ", origin=(9, -30, 0)).circle(8).extrude(10)
    both = cq.Assembly().add(plate, name="plate").add(pin, name="pin")
    drawing = hlr.draw(both, (0.2, -1, 0.3), **AT_SIZE)
    near = [samples(line, DENSE) for line in drawing.lines if line.visible and drawing.parts[line.part].name == "pin"]
    ends = {True: set(), False: set()}
    for line in drawing.lines:
        if drawing.parts[line.part].name == "plate" and isinstance(line.curve, Arc):
            ends[line.visible] |= {tuple(line.points[0]), tuple(line.points[-1])}
    changes = ends[True] & ends[False]
    assert changes
    for change in changes:
        point = np.array([change])
        assert min(distance(point, path) for path in near) < 0.1 * drawing.accuracy.used


def test_a_line_hidden_in_between_is_one_line_interrupted() -> None:
    """The two visible ends of an edge that passes behind a bar lie on it, and so does the hidden piece between them."""
    board = cq.Workplane("XZ").rect(60, 40).extrude(-3)
    bar = cq.Workplane("XZ", origin=(0, -30, 22)).circle(5).extrude(10)
    drawing = hlr.draw(cq.Assembly().add(board, name="board").add(bar, name="bar"), (0.15, -1, 0.1), **AT_SIZE)
    whole: dict[int, list[Any]] = {}
    for line in drawing.lines:
        if drawing.parts[line.part].name == "board":
            whole.setdefault(line.edge, []).append(line)
    broken = [lines for lines in whole.values() if len(lines) == 3]
    assert broken
    rims = [samples(line, DENSE) for line in drawing.lines if line.visible and drawing.parts[line.part].name == "bar"]
    for lines in broken:
        (hidden,) = [line for line in lines if not line.visible]
        for end in hidden.points[[0, -1]]:
            assert any(np.array_equal(end, line.points[k]) for line in lines if line.visible for k in (0, -1))
            assert min(distance(end[None], rim) for rim in rims) < 0.1 * drawing.accuracy.used


def test_json_holds_the_curves() -> None:
    drawing = hlr.draw(DATA / "nist_ctc_01_asme1_ap242-e1.stp", **AT_SIZE)
    lines = json.loads(render(drawing, "json"))["lines"]
    assert len(lines) == len(drawing.lines)
    accuracy = drawing.accuracy.used
    for line, told in zip(drawing.lines, lines, strict=True):
        curve = told.get("curve")
        if line.curve is None:
            assert curve is None
        elif curve["type"] == "arc":
            read = Arc(*(np.array(curve[key]) for key in ("centre", "axes", "angles")))
            t = np.linspace(0.0, 1.0, 9)
            a, b = (c.angles[0] + (c.angles[1] - c.angles[0]) * t for c in (read, line.curve))
            assert np.abs(read.at(a) - line.curve.at(b)).max() < 0.01 * accuracy
        else:
            assert curve["degree"] == line.curve.degree
            assert np.abs(np.array(curve["points"]) - line.curve.points).max() < 0.001 * accuracy


def test_boxes_of_curves_are_exact() -> None:
    random = np.random.default_rng(3)
    arcs = []
    for _ in range(40):
        turn, (a, b) = random.uniform(0, 7), random.uniform(0.1, 5, 2)
        axes = np.array([[a * math.cos(turn), a * math.sin(turn)], [-b * math.sin(turn), b * math.cos(turn)]])
        arcs.append(
            Arc(random.normal(size=2), axes, random.uniform(-7, 7) + np.array([0, random.uniform(-6.28, 6.28)]))
        )
    chains = [Bezier(d, random.normal(size=(d * 3 + 1, 2))) for d in (2, 3) for _ in range(20)]
    for curve in [*arcs, *chains]:
        last = curve.angles if isinstance(curve, Arc) else (0.0, 3.0)
        points = curve.at(np.linspace(*last, 6001))
        box = np.stack([points.min(axis=0), points.max(axis=0)])
        assert curve.bounds == pytest.approx(box, abs=1e-4)
    whole = np.stack([arc.bounds for arc in arcs])
    assert arc_bounds(arcs) == pytest.approx(np.stack([whole[:, 0].min(axis=0), whole[:, 1].max(axis=0)]))
    whole = np.stack([chain.bounds for chain in chains])
    assert bezier_bounds(chains) == pytest.approx(np.stack([whole[:, 0].min(axis=0), whole[:, 1].max(axis=0)]))
    t = np.linspace(0, 3, 50)
    assert raised(chains[0]).at(t) == pytest.approx(chains[0].at(t))


def test_any_number_of_threads_draws_the_same() -> None:
    one, two = (render(hlr.draw(DATA / "as1-oc-214.stp", threads=n, **AT_SIZE), "svg") for n in (1, 3))
    assert one == two


@pytest.mark.parametrize("name", ["M6-1x12-countersunk-screw.step", "nist_ctc_01_asme1_ap242-e1.stp", "as1-oc-214.stp"])
def test_every_line_of_a_brep_has_its_curve(name):
    """The screw's thread runs nine times around, in few spans: the next turn is nearer than the next sample of one."""
    for drawing in hlr.draw_views(DATA / name, ["front", "top", "iso"]):
        found = [line for line in drawing.lines if bends_without_curve(line, drawing.accuracy.used)]
        assert [line for line in found if line.kind != "intersection"] == []


def test_a_polyline_is_told_from_a_straight_line():
    (line, *_) = hlr.draw(cq.Workplane().box(3, 4, 5), "front", **AT_SIZE).lines
    assert not bends_without_curve(line, 0.05)
    start, end = line.points[[0, -1]]
    for inner, bent in (
        (start + 0.3 * (end - start), False),
        (start + [0.1, 0.1], True),
        (start - 0.1 * (end - start), True),
    ):
        points = np.stack([start, inner, end])
        assert bends_without_curve(replace(line, points=points, points3=np.zeros((3, 3))), 0.05) == bent
