"""project_to_viewport: build123d's own edges, in the plane and place where its method puts them."""

import math

import ezdxf
import pytest
from ezdxf import bbox

from hlr.compat.build123d import project_to_viewport
from hlr.errors import HlrError, OptionError, SourceError, ViewError

bd = pytest.importorskip("build123d")

from compat import originals  # noqa: E402

VIEWS = [
    ((100, -80, 70), {}),
    ((100, -80, 70), {"viewport_up": (0, 1, 0.2), "look_at": (1, 2, 3)}),
    ((0, 5, 100), {"viewport_up": (0, 1, 0)}),
]


def plate():
    block = bd.Box(40, 30, 20)
    return bd.fillet(block.edges().filter_by(bd.Axis.Z), 5) - bd.Cylinder(7, 20)


def turned():
    return bd.Pos(50, 60, 70) * bd.Rot(10, 20, 30) * (bd.Box(10, 20, 30) + bd.Cylinder(3, 50))


MODELS = {"plate": plate, "turned": turned, "cylinder": lambda: bd.Rot(20, 30, 10) * bd.Cylinder(10, 30)}


def bounds(edges):
    return originals.box(edge.wrapped for edge in edges)


def length(edges):
    return sum(originals.length(edge.wrapped) for edge in edges)


@pytest.mark.parametrize("view", VIEWS, ids=["centre", "look_at", "top"])
@pytest.mark.parametrize("name", MODELS)
def test_the_same_lines_in_the_same_place(name, view):
    shape, (origin, how) = MODELS[name](), view
    ours, theirs = project_to_viewport(shape, origin, **how), shape.project_to_viewport(origin, **how)
    assert bounds(ours[0]) == pytest.approx(bounds(theirs[0]), abs=0.01)
    assert length(ours[0]) == pytest.approx(length(theirs[0]), rel=0.006)
    assert length(ours[1]) <= 1.001 * length(theirs[1])


@pytest.mark.parametrize(("height", "up"), [(100, 1.0), (-100, -1.0)])
def test_from_above_and_below_y_points_up(height, up):
    """build123d turns such a view by some angle."""
    seen, hidden = project_to_viewport(bd.Pos(30, 7, 0) * bd.Box(10, 20, 5), (30, 7, height))
    left, lower, _, right, upper, _ = bounds(seen)
    assert (right - left, upper - lower) == pytest.approx((10.0, 20.0))
    assert length(seen) == pytest.approx(60.0) and not hidden
    # A hole toward +y is in the upper half of the picture, seen from below in the lower one.
    plate = bd.Box(10, 20, 5) - bd.Pos(0, 6, 0) * bd.Cylinder(1, 9)
    seen, _ = project_to_viewport(plate, (0, 0, height), look_at=(0, 0, 0))
    (rim,) = [edge for edge in seen if edge.geom_type == bd.GeomType.CIRCLE]
    assert rim.arc_center.Y * up > 1.0


@pytest.mark.parametrize("focus", [90, 400])
def test_perspective(focus):
    shape, origin = bd.Pos(1, 2, 3) * bd.Box(10, 20, 30), (100, -80, 70)
    ours, theirs = project_to_viewport(shape, origin, focus=focus), shape.project_to_viewport(origin, focus=focus)
    assert bounds(ours[0]) == pytest.approx(bounds(theirs[0]), abs=1e-6)
    for own, other in zip(ours, theirs, strict=True):
        assert length(own) == pytest.approx(length(other), rel=1e-6)


def test_a_sphere_in_perspective():
    """Where OpenCASCADE draws a coarse polygon, seen from another eye, a hundredth too short."""
    centre, origin, focus, radius = (1, 2, 3), (100, -80, 70), 90, 9
    visible, hidden = project_to_viewport(bd.Pos(*centre) * bd.Sphere(radius), origin, focus=focus)
    away = math.dist(centre, origin) + focus
    expected = radius / math.sqrt(away**2 - radius**2) * focus
    assert bounds(visible) == pytest.approx((-expected, -expected, 0, expected, expected, 0), abs=2e-3)
    assert length(visible) == pytest.approx(math.tau * expected, rel=1e-4)
    assert not hidden


def test_edges_are_of_build123ds_types():
    visible, hidden = project_to_viewport(plate(), (0, 5, 100), viewport_up=(0, 1, 0))
    assert isinstance(visible, bd.ShapeList) and isinstance(hidden, bd.ShapeList)
    assert {type(edge) for edge in visible + hidden} == {bd.Edge}
    visible, _ = project_to_viewport(plate(), (0, 0, 100), viewport_up=(0, 1, 0))
    circles = visible.filter_by(bd.GeomType.CIRCLE)
    assert sorted(round(edge.radius, 9) for edge in circles) == [5, 5, 5, 5, 7]
    assert len(visible.filter_by(bd.GeomType.LINE)) == 4 == len(visible) - len(circles)
    tilted, _ = project_to_viewport(plate(), (100, -80, 70))
    assert {edge.geom_type for edge in tilted} == {bd.GeomType.LINE, bd.GeomType.ELLIPSE}


def test_splines_stay_splines():
    outline = bd.Spline((0, 0), (5, 8), (15, 6), (20, 0)) + bd.Line((20, 0), (0, 0))
    shape = bd.extrude(bd.make_face(outline), 5)
    visible, _ = project_to_viewport(shape, (30, -40, 80))
    assert {edge.geom_type for edge in visible} <= {bd.GeomType.LINE, bd.GeomType.BEZIER, bd.GeomType.BSPLINE}
    assert visible.filter_by(bd.GeomType.BEZIER) + visible.filter_by(bd.GeomType.BSPLINE)


def test_labels_tell_part_and_edge():
    bolt, nut = bd.Cylinder(3, 20), bd.Pos(20, 0, 0) * bd.Box(6, 6, 6)
    bolt.label, nut.label = "bolt", "nut"
    visible, _ = project_to_viewport(bd.Compound(label="both", children=[bolt, nut]), (100, -80, 70))
    labels = {edge.label for edge in visible}
    assert {label.partition("/")[0] for label in labels} == {"bolt", "nut"}
    assert {"bolt/edge 0", "bolt/face 0", "nut/edge 0"} <= labels


def test_where_parts_run_into_one_another_both_are_named():
    rod, block = bd.Cylinder(2, 20), bd.Box(10, 10, 6)
    rod.label, block.label = "rod", "block"
    visible, _ = project_to_viewport(bd.Compound(children=[rod, block]), (100, -80, 70))
    assert {"rod/block", "block/rod"} & {edge.label for edge in visible}


def test_a_builder_is_what_it_has_built():
    with bd.BuildPart() as builder:
        bd.Box(10, 20, 30)
    ours = project_to_viewport(builder, (100, -80, 70))
    assert [len(edges) for edges in ours] == [9, 3]


def test_the_exporters_take_them(tmp_path):
    visible, hidden = project_to_viewport(turned(), (100, -80, 70))
    dxf = bd.ExportDXF()
    dxf.add_layer("hidden", line_type=bd.LineType.ISO_DASH)
    dxf.add_shape(visible)
    dxf.add_shape(hidden, layer="hidden")
    dxf.write(str(tmp_path / "a.dxf"))
    box = bbox.extents(ezdxf.readfile(tmp_path / "a.dxf").modelspace())
    assert (*box.extmin, *box.extmax) == pytest.approx(bounds(visible), abs=0.02)
    svg = bd.ExportSVG()
    svg.add_layer("hidden", line_type=bd.LineType.ISO_DASH)
    svg.add_shape(visible)
    svg.add_shape(hidden, layer="hidden")
    svg.write(str(tmp_path / "a.svg"))
    assert (tmp_path / "a.svg").read_text().count("<") > 10


def test_the_drawing_of_the_tutorial(tmp_path):
    """As build123d's tutorial has it: both kinds of line on layers of their own, by either exporter."""
    with bd.BuildPart() as block:
        bd.Box(80, 60, 20)
        bd.fillet(block.edges().filter_by(bd.Axis.Z), 8)
        with bd.GridLocations(60, 40, 2, 2):
            bd.CounterBoreHole(3, 6, 6)
    kinds = {}
    origin = (-100, -50, 30)
    projected = {"ours": project_to_viewport(block.part, origin), "theirs": block.part.project_to_viewport(origin)}
    for name, (visible, hidden) in projected.items():
        longest = max(*bd.Compound(children=visible + hidden).bounding_box().size)
        exporters = {"svg": bd.ExportSVG(scale=100 / longest, margin=5), "dxf": bd.ExportDXF()}
        for ending, exporter in exporters.items():
            exporter.add_layer("Visible")
            exporter.add_layer("Hidden", line_type=bd.LineType.ISO_DOT)
            exporter.add_shape(visible, layer="Visible")
            exporter.add_shape(hidden, layer="Hidden")
            exporter.write(str(tmp_path / f"{name}.{ending}"))
        model = ezdxf.readfile(tmp_path / f"{name}.dxf").modelspace()
        kinds[name] = {entity.dxftype() for entity in model if entity.dxf.layer == "Visible"}
        assert {entity.dxf.layer for entity in model} == {"Visible", "Hidden"}
        assert 'id="Hidden"' in (tmp_path / f"{name}.svg").read_text()
    assert kinds["ours"] == {"LINE", "ELLIPSE"} <= kinds["theirs"]


@pytest.mark.parametrize(
    "how, error, words",
    [
        ({"viewport_origin": (0, 0, 0)}, ViewError, "move it away from look_at"),
        ({"viewport_origin": "front"}, OptionError, "viewport_origin needs three finite numbers"),
        ({"viewport_origin": (0, 0, math.inf)}, OptionError, "viewport_origin needs three finite numbers"),
        ({"viewport_up": (0, 0, 0)}, ViewError, "`up` is zero"),
        ({"viewport_up": (2, 2, 2)}, ViewError, "`up` is parallel"),
        ({"look_at": "here"}, OptionError, "look_at needs three finite numbers"),
        ({"focus": -4}, OptionError, "focus must be above zero"),
        ({"focus": "near"}, OptionError, "focus needs a finite number"),
    ],
)
def test_errors(how, error, words):
    given = {"viewport_origin": (10, 10, 10), **how}
    with pytest.raises(error, match=words) as raised:
        project_to_viewport(bd.Box(1, 1, 1), **given)
    assert isinstance(raised.value, HlrError)


@pytest.mark.parametrize("thing", [5, None, [1]])
def test_what_is_no_shape(thing):
    with pytest.raises(SourceError, match="pass a build123d shape"):
        project_to_viewport(thing, (1, 1, 1))


@pytest.mark.parametrize("empty", [bd.Part, bd.Sketch, bd.Compound])
def test_what_is_empty(empty):
    with pytest.raises(SourceError, match="holds no shapes: there is nothing to project"):
        project_to_viewport(empty(), (1, 1, 1))
