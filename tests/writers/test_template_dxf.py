"""The template of a page in DXF: lines, areas and texts where SVG has them, on a layer of their own."""

from __future__ import annotations

import io
from dataclasses import replace
from math import hypot
from pathlib import Path

import ezdxf
import pytest
from writers.pages import with_template

import hlr
from hlr.errors import WriteError
from hlr.request.style import Style

SEEDS = Path(__file__).resolve().parents[1] / "fuzz/corpus/seeds"

TEMPLATE = """<svg width="100" height="80" viewBox="0 0 200 160">
<rect width="200" height="160" fill="white"/>
<g transform="translate(20 0)" style="stroke:#ff0000;stroke-width:1;fill:none">
<rect x="20" y="20" width="100" height="60"/>
<path d="M 20 100 A 20 20 0 0 1 60 100 Q 80 80 100 100 z" fill="#0000ff" stroke="none"/>
</g>
<path d="M 0 150 h 200" stroke="#000" stroke-width=".5" stroke-dasharray="20 10"/>
<path d="M 120 140 m 20 0 a 20 20 0 0 1 -40 0" stroke="#000" fill="none"/>
<text x="40" y="140" font-size="10">a &lt; b</text>
<text x="180" y="140" font-size="10" text-anchor="end">Ünal <tspan display="none">not</tspan></text>
<text transform="translate(10 100) rotate(-90)" font-size="10" text-anchor="middle">up</text>
</svg>"""


def document(data, encoding="utf-8"):
    read = ezdxf.read(io.TextIOWrapper(io.BytesIO(data), encoding))
    assert not read.audit().errors
    return read


def on_its_layer(made):
    encoding = "cp1252" if made.style.dxf == "R12" else "utf-8"
    found = document(made.to_dxf(), encoding).modelspace()
    return [entity for entity in found if entity.dxf.layer == "TEMPLATE"]


def printed(dxf="R2010"):
    return on_its_layer(replace(with_template(TEMPLATE), style=Style(dxf=dxf)))


def at(x, y):
    """A place in the drawing, given in millimetres from the upper left corner of the page."""
    return pytest.approx((x, 80.0 - y), abs=1e-3)


def of_kind(found, *kinds):
    return [entity for entity in found if entity.dxftype() in kinds]


def test_lines_lie_where_svg_has_them():
    found = printed()
    (dashed,) = of_kind(found, "LINE")
    assert tuple(dashed.dxf.start.vec2) == at(0, 75) and tuple(dashed.dxf.end.vec2) == at(100, 75)
    assert (dashed.dxf.linetype, dashed.dxf.lineweight) == ("TEMPLATE_10_5", 25)
    rectangle, arc = of_kind(found, "LWPOLYLINE")
    assert rectangle.closed and not arc.closed and rectangle.dxf.color == 1
    for corner, place in zip(rectangle.get_points("xy"), ((20, 10), (70, 10), (70, 40)), strict=False):
        assert corner == at(*place)
    corners = [tuple(point) for point in arc.get_points("xy")]
    assert corners[0] == at(70, 70) and corners[-1] == at(50, 70) and len(corners) > 8
    assert [hypot(x - 60, y - 10) for x, y in corners] == pytest.approx([10] * len(corners), abs=0.02)


def test_what_is_filled_is_solid_but_for_paper():
    (area,) = of_kind(printed(), "HATCH")
    assert (area.dxf.solid_fill, area.dxf.color) == (1, 5)


@pytest.mark.parametrize("version", ["R12", "R2010"])
def test_texts_are_texts(version):
    found = printed(version)
    left, right, up = of_kind(found, "TEXT")
    assert (left.dxf.text, right.dxf.text, up.dxf.text) == ("a < b", "Ünal", "up")
    assert tuple(left.dxf.insert.vec2) == at(20, 70) and tuple(right.dxf.align_point.vec2) == at(90, 70)
    assert (right.dxf.halign, up.dxf.halign) == (2, 1)
    assert left.dxf.height == pytest.approx(3.5) and up.dxf.rotation == pytest.approx(90)


def test_r12_has_lines_and_no_areas():
    found = printed("R12")
    assert len(of_kind(found, "POLYLINE")) == 2 and not of_kind(found, "HATCH", "LWPOLYLINE")


def test_a_part_of_that_name_has_another_layer():
    made = with_template(TEMPLATE)
    parts = tuple(replace(part, name="template") for part in made.parts)
    data = replace(made, parts=parts, style=Style(layers="part")).to_dxf()
    assert "template_2" in {entity.dxf.layer for entity in document(data).modelspace()}


def test_the_symbol_of_the_method_is_there():
    page = hlr.draw_arranged(SEEDS / "block.step", "third-angle", views=["front"])
    assert of_kind(on_its_layer(page), "LWPOLYLINE", "LINE")


def test_what_is_no_svg_is_refused():
    with pytest.raises(WriteError, match="template of the page cannot be drawn in DXF"):
        with_template('<svg viewBox="0 0 1 1"><path d="M 0 0 L 1').to_dxf()
