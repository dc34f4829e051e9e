"""getSVG, exportSVG and export: CadQuery's picture with hlr's lines."""

import re
import warnings
import xml.etree.ElementTree as ET
from dataclasses import fields

import numpy as np
import pytest

from hlr.compat.cadquery import export, exportSVG, getSVG
from hlr.compat.cadquery_options import PictureOptions, check_options
from hlr.errors import HlrError, OptionError, SourceError, ViewError, WriteError

cq = pytest.importorskip("cadquery")

from compat.models import MODELS, STRAIGHT, pair, plate  # noqa: E402

SVG = "{http://www.w3.org/2000/svg}"
OPTIONS = [
    {},
    {"width": None, "height": 300, "marginLeft": 30},
    {"width": 500, "height": None, "marginLeft": 50, "marginTop": 10.5},
    {"projectionDir": (1, -1, 1), "strokeWidth": 0.25, "strokeColor": (255, 0, 10), "hiddenColor": (0, 1.5, 2)},
    {"showHidden": False},
    {"showAxes": False, "projectionDir": (0.3, 0.2, 1)},
    {"focus": 300, "marginLeft": 0},
    {"focus": 0},
]


def original(shape, opts=None):
    from cadquery.occ_impl.exporters.svg import getSVG

    return getSVG(shape, opts)


def numbers(text):
    return [float(value) for value in re.findall(r"-?[\d.]+(?:e-?\d+)?", text)]


def facts(svg):
    """What a picture's frame says: sizes, placement, widths, colours, dashes, axes."""
    root = ET.fromstring(svg)
    outer, *rest = root.findall(f"{SVG}g")
    hidden, solid = outer.findall(f"{SVG}g")
    return {
        "size": [float(root.get("width")), float(root.get("height"))],
        "place": numbers(outer.get("transform")),
        "widths": [float(outer.get("stroke-width")), *numbers(hidden.get("stroke-dasharray"))],
        "colors": numbers(hidden.get("stroke")) + numbers(solid.get("stroke")),
        "axes": [
            [(e.tag, *(float(e.get(k)) for k in ("x1", "y1", "x2", "y2") if e.get(k)), e.text) for e in group]
            for group in rest
        ],
        "axes place": [value for group in rest for value in numbers(group.get("transform"))],
        "hidden": bool(list(hidden.iter(f"{SVG}path")) + list(hidden.iter(f"{SVG}ellipse"))),
    }


def whole(model):
    return cq.Compound.makeCompound(model.vals())


@pytest.mark.slow
@pytest.mark.parametrize("opts", OPTIONS, ids=str)
def test_the_frame_is_that_of_cadquery(opts):
    ours, theirs = facts(getSVG(plate().val(), opts)), facts(original(plate().val(), opts))
    perspective = bool(opts.get("focus"))
    for name in ("size", "place", "widths", "axes place"):
        # In perspective OpenCASCADE's curves are coarse polygons.
        assert ours[name] == pytest.approx(theirs[name], rel=1e-3 if perspective else 1e-5, abs=1e-6), name
    for name in ("colors", "axes", "hidden"):
        assert ours[name] == theirs[name], name


@pytest.mark.parametrize("name", MODELS)
def test_the_same_ink(name):
    shape = whole(MODELS[name]())
    ours, theirs = getSVG(shape), original(shape)
    assert facts(ours)["place"] == pytest.approx(facts(theirs)["place"], rel=1e-3)
    for group in (0, 1):
        own, other = ink(ours, group), ink(theirs, group)
        # Hidden lines under visible ones are not drawn twice.
        assert own == pytest.approx(other, rel=0.01 if group else 0.06), "visible" if group else "hidden"
    if name not in STRAIGHT:
        assert len(ours) < 0.3 * len(theirs)


def ink(svg, group):
    """Length of all paths of the hidden (0) or visible (1) group, in model units."""
    paths = pytest.importorskip("svgpathtools")
    outer = ET.fromstring(svg).find(f"{SVG}g")
    total = 0.0
    for element in outer.findall(f"{SVG}g")[group].iter():
        tag = element.tag.removeprefix(SVG)
        if tag == "path":
            total += paths.parse_path(element.get("d")).length(error=1e-6)
        elif tag in ("circle", "ellipse"):
            a, b = (float(element.get(k) or element.get("r")) for k in ("rx", "ry"))
            t = np.linspace(0.0, 2.0 * np.pi, 20000)
            total += float(np.hypot(np.diff(a * np.cos(t)), np.diff(b * np.sin(t))).sum())
    return total


def test_coordinates_are_those_of_the_projected_model():
    svg = getSVG(cq.Workplane().box(4, 2, 6).val(), {"projectionDir": (0, 0, 1)})
    points = {tuple(numbers(d)[:2]) for d in re.findall(r' d="(M[^hvl]*)', svg)}
    assert points <= {(x, y) for x in (-2, 2) for y in (-1, 1)} and points


def test_lines_know_where_they_are_from():
    solid = ET.fromstring(getSVG(pair())).find(f"{SVG}g").findall(f"{SVG}g")[1]
    assert {group.get("class") for group in solid} == {"sharp"}
    assert {of_part.get("data-part") for of_part in solid.find(f"{SVG}g")} == {"0", "1"}


def test_arcs_turn_the_right_way(tmp_path):
    """A file with y up is drawn turned: an arc must bulge where the model does."""
    svg = getSVG(
        cq.Workplane().rect(10, 10).extrude(5).edges(">X and |Z").fillet(3).val(), {"projectionDir": (0, 0, 1)}
    )
    paths = pytest.importorskip("svgpathtools")
    solid = ET.fromstring(svg).find(f"{SVG}g").findall(f"{SVG}g")[1]
    arcs = [s for p in solid.iter(f"{SVG}path") for s in paths.parse_path(p.get("d")) if isinstance(s, paths.Arc)]
    assert len(arcs) == 2
    for arc in arcs:
        middle = arc.point(0.5)
        assert (middle.real, abs(middle.imag)) == pytest.approx((2 + 3 * 0.5**0.5, 2 + 3 * 0.5**0.5), abs=1e-3)


def test_turned_ellipses():
    """So must whole ellipses be turned with the model: seen from here they lean."""
    svg = getSVG(cq.Workplane().circle(5).extrude(1).val(), {"projectionDir": (1, 2, 2)})
    (ellipse,) = ET.fromstring(svg).find(f"{SVG}g").findall(f"{SVG}g")[1].iter(f"{SVG}ellipse")
    assert float(ellipse.get("rx")) == pytest.approx(5) and float(ellipse.get("ry")) == pytest.approx(10 / 3)
    from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt

    # The long axis is horizontal in space and perpendicular to the view.
    plane = gp_Ax2(gp_Pnt(), gp_Dir(1, 2, 2))
    axis = gp_Dir(2, -1, 0)
    expected = np.degrees(np.arctan2(axis.Dot(plane.YDirection()), axis.Dot(plane.XDirection())))
    turn = numbers(ellipse.get("transform"))[0]
    assert (turn - expected + 90) % 180 - 90 == pytest.approx(0, abs=1e-3)


def test_a_face_seen_edge_on_has_a_picture():
    face = cq.Workplane().rect(10, 10).extrude(5).faces(">Z").val()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        facts(getSVG(face, {"projectionDir": (1, 0, 0)}))


def test_large_models_are_no_reason_to_warn():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        getSVG(cq.Workplane().box(1e5, 1e5, 1e5))
        getSVG(cq.Workplane().box(1e-2, 1e-2, 1e-2))


def test_what_a_drawing_notes_is_a_warning():
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.gp import gp_Pln

    endless = cq.Face(BRepBuilderAPI_MakeFace(gp_Pln()).Face())
    with pytest.warns(UserWarning, match="could not be meshed"):
        getSVG(cq.Workplane().box(1, 1, 1).add(endless))


def test_export_svg_takes_the_top_of_the_stack(tmp_path):
    path = tmp_path / "a.svg"
    exportSVG(pair(), str(path), {"width": 300})
    assert path.read_text("utf-8") == getSVG(pair().val(), {"width": 300})


def test_export_takes_all(tmp_path):
    path = tmp_path / "a.svg"
    export(pair(), str(path), opt={"width": 300})
    assert path.read_text("utf-8") == getSVG(pair(), {"width": 300})
    export(iter(pair().vals()), str(tmp_path / "b"), "SVG", opt={"width": 300})
    assert (tmp_path / "b").read_bytes() == path.read_bytes()


def test_pdf_is_the_same_picture(tmp_path):
    pdfium = pytest.importorskip("pypdfium2")
    path, again = tmp_path / "a.pdf", tmp_path / "b.pdf"
    export(plate(), str(path), opt={"strokeColor": (255, 0, 0), "showAxes": False})
    export(plate(), str(again), opt={"strokeColor": (255, 0, 0), "showAxes": False})
    assert path.read_bytes() == again.read_bytes()
    page = pdfium.PdfDocument(path.read_bytes())[0]
    assert page.get_size() == pytest.approx((600, 180))
    image = np.asarray(page.render(scale=96 / 72).to_pil().convert("RGB")).astype(int)
    red = (image[..., 0] > 200) & (image[..., 1] < 160)
    rows, columns = (np.flatnonzero(red.any(axis=axis)) for axis in (1, 0))
    # Three quarters of the height, below a margin of 20 and right of one of 200.
    assert (rows[0], rows[-1], columns[0]) == pytest.approx((20, 200, 200), abs=2)
    grey = (abs(image - 160) < 30).all(axis=2)
    assert grey.any()


def test_pdf_has_the_axes(tmp_path):
    pdfium = pytest.importorskip("pypdfium2")
    export(plate(), str(tmp_path / "a.pdf"))
    page = pdfium.PdfDocument((tmp_path / "a.pdf").read_bytes())[0]
    assert sorted(page.get_textpage().get_text_range().split()) == ["X", "Y", "Z"]


def test_other_types_are_left_to_cadquery(tmp_path):
    export(plate(), str(tmp_path / "a.step"))
    assert (tmp_path / "a.step").read_text().startswith("ISO-10303-21")
    export(plate(), str(tmp_path / "b"), "STL", 0.5, 0.5, opt={"ascii": True})
    assert (tmp_path / "b").read_text().startswith("solid")
    with pytest.raises(ValueError, match="Unknown extensions"):
        export(plate(), str(tmp_path / "a.dwg"))


def test_every_option_of_the_picture_may_be_given():
    usual = PictureOptions()
    assert check_options({each.name: getattr(usual, each.name) for each in fields(usual)}) == usual


@pytest.mark.slow
@pytest.mark.parametrize(
    "opts, error, words",
    [
        ({"widht": 5}, OptionError, "'widht' is no option of getSVG: use width, height, "),
        ({"width": -1}, OptionError, "width must be above zero, not -1"),
        ({"height": "240"}, OptionError, "height needs a finite number, not '240'"),
        ({"width": None, "height": None}, OptionError, "both None"),
        ({"width": None, "height": 40}, OptionError, "leaves nothing between two margins of 20"),
        ({"width": 400, "height": None}, OptionError, "leaves nothing between two margins of 200"),
        ({"marginLeft": None}, OptionError, "marginLeft needs a finite number"),
        ({"projectionDir": (0, 0, 0)}, ViewError, "projectionDir is zero"),
        ({"projectionDir": (0, 1)}, OptionError, "projectionDir needs three finite numbers"),
        ({"strokeWidth": -2}, OptionError, "strokeWidth needs a width in model units, or -1"),
        ({"strokeColor": "red"}, OptionError, "strokeColor needs red, green and blue"),
        ({"hiddenColor": (0, 0, 256)}, OptionError, "hiddenColor needs red, green and blue"),
        ({"focus": -10}, OptionError, "focus must be above zero, not -10"),
        ([1], OptionError, "opts needs a dictionary"),
    ],
)
def test_options_out_of_range(opts, error, words):
    with pytest.raises(error, match=words) as raised:
        getSVG(plate().val(), opts)
    assert isinstance(raised.value, HlrError)


def test_other_errors(tmp_path):
    with pytest.raises(SourceError, match="cannot be drawn"):
        getSVG(5)
    with pytest.raises(WriteError, match="does not exist"):
        exportSVG(plate(), str(tmp_path / "nowhere" / "a.svg"))
