"""SVG of other programs: what of it is a line, which lines are hidden, and where they lie on paper."""

import math

import numpy as np
import pytest

from hlr.compare import compare
from hlr.compare.lines.sketch import Sketch
from hlr.compare.reading.affine import transform_of
from hlr.compare.reading.sides import side_of
from hlr.errors import SourceError
from support.drawings import arc, drawing, line

FRAGMENT = """<g fill="none" stroke="#000000" stroke-width="0.7">
<path id= "2" d=" M -30 6 L 20 6 " />
<circle cx ="0" cy ="0" r ="6" /></g>
<g fill="none" stroke="#000000" stroke-width="0.35">
<path id= "2" d=" M 0 -5 L 20 -5 " /></g>
"""

PROJECTION = """<g   fill="none"
   stroke="rgb(0, 0, 0)"
   stroke-dasharray="0.2,0.1)" stroke-width="0.15" transform="scale(1,-1)" >
<path id= "1" d=" M 10 -30 L -8 -30 " /></g>
<g fill="none" stroke="rgb(0, 0, 0)" stroke-width="0.35" transform="scale(1,-1)"><path d="M0,0 L5,0" /></g>
"""

PAGE = """<?xml version="1.0"?>
<svg xmlns="http://www.w3.org/2000/svg" width="297mm" height="210mm" viewBox="0 0 2970 2100">
 <g id="template" transform="scale(10)"><path stroke="#000" fill="none" d="M 10 10 L 287 10"/><text>Title</text></g>
 <g id="DrawingContent" fill="none" stroke="black" stroke-width="1" stroke-linecap="square" stroke-linejoin="bevel">
  <g fill="#ffffff" stroke="none" transform="matrix(1,0,0,1,750,600)"><path d="M0,0 L100,0 L100,100 Z"/></g>
  <g {edge} transform="matrix(1,0,0,1,750,600)"><path d="M0,0 L100,0"/></g>
  <g {edge}{dash} transform="matrix(1,0,0,1,750,600)"><path d="M0,50 L100,50"/></g>
  <g transform="matrix(1,0,0,1,800,500)"><text>100</text></g>
  <g {edge} stroke-width="3.5" transform="matrix(1,0,0,1,750,600)"><path d="M0,0 L0,-80 M0,-70 L100,-70"/></g>
  <g fill="#000000" stroke-width="3.5" transform="matrix(1,0,0,1,750,530)"><path d="M0,0 L10,3 L10,-3 Z"/></g>
  <g stroke="#00ff00" transform="matrix(1,0,0,1,750,600)"><path d="M0,10 L100,20"/></g>
  <g {edge} transform="matrix(1,0,0,1,2000,600)"><path d="M0,0 A40 40 0 0 1 40 40"/></g>
 </g>
</svg>"""
EDGE = 'fill="none" stroke-linecap="round" stroke-linejoin="bevel"'


def read(tmp_path, text, name="other.svg"):
    path = tmp_path / name
    path.write_text(text)
    return side_of(path, 0.1)


def length_of(side, visible):
    return round(float(side.pieces.lengths[side.pieces.visible == visible].sum()), 2)


def test_of_a_fragment_the_thinner_group_is_hidden(tmp_path):
    side = read(tmp_path, FRAGMENT)
    assert length_of(side, 1) == pytest.approx(50 + 12 * math.pi, abs=0.05) and length_of(side, 0) == 20
    assert side.pieces.start[0].tolist() == [-30, -6]  # y down became y up


def test_of_a_projection_the_dashed_group_is_hidden(tmp_path):
    side = read(tmp_path, PROJECTION)
    assert (length_of(side, 1), length_of(side, 0)) == (5, 18)
    assert side.pieces.start[0].tolist() == [10, -30]  # scale(1,-1), and y down


@pytest.mark.parametrize(("dash", "solid", "gaps"), [("", -1, -1), (' stroke-dasharray="4,2"', 1, 0)])
def test_a_page_gives_the_edges_of_its_views_in_millimetres(tmp_path, dash, solid, gaps):
    side = read(tmp_path, PAGE.format(edge=EDGE, dash=dash))
    pieces = side.pieces
    assert pieces.visible[:2].tolist() == [solid, gaps]
    assert np.allclose(pieces.start[:2], [[75, 150], [75, 145]]) and np.allclose(pieces.end[:2], [[85, 150], [85, 145]])
    assert side.about.views == ("at (75, 150)", "at (200, 150)") and set(pieces.view.tolist()) == {0, 1}
    assert float(pieces.lengths[2:].sum()) == pytest.approx(2 * math.pi, rel=1e-3)
    assert side.about.left_out == {
        "faces": 1,
        "texts and pictures": 1,
        "arrows and filled shapes": 1,
        "lines of dimensions and hatches": 2,
    }


@pytest.mark.parametrize("name", ["hidden", "Hidden lines", "layer_HIDDEN"])
def test_names_of_groups_tell_what_is_hidden(tmp_path, name):
    text = f"""<svg xmlns="http://www.w3.org/2000/svg" width="100mm" viewBox="0 0 100 100" stroke="black" fill="none">
    <g id="visible"><line x1="0" y1="0" x2="7" y2="0"/></g><g id="{name}"><polyline points="0,5 9,5"/></g></svg>"""
    side = read(tmp_path, text)
    assert (length_of(side, 1), length_of(side, 0)) == (7, 9)


def test_every_shape_is_read(tmp_path):
    text = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 50 50" width="100mm" style="stroke:#000; fill:none">
    <defs><path d="M0 0 L 9 9"/></defs><clipPath><rect width="5" height="5"/></clipPath>
    <rect x="1" y="1" width="2" height="1"/><polygon points="0,0 3,0 3,4"/><ellipse rx="2" ry="2"/></svg>"""
    assert float(read(tmp_path, text).pieces.lengths.sum()) == pytest.approx(2 * (6 + 12 + 4 * math.pi), rel=1e-3)


def test_transforms_follow_one_another():
    found = transform_of("translate(10, 5) rotate(90) scale(2 -1),skewX(45)")
    assert found.point((1.0, 0.0)) == pytest.approx((10.0, 7.0)) and found.point((0.0, 1.0)) == pytest.approx(
        (11.0, 7.0)
    )
    assert transform_of("rotate(180 3 4)").point((0.0, 0.0)) == pytest.approx((6.0, 8.0))
    for wrong in ("rotate(1, 2)", "turn(3)", "scale(2", "matrix(1 2 3)"):
        with pytest.raises(ValueError, match="no transform"):
            transform_of(wrong)


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("<g><path d='M 0 0 L", "no sound XML"),
        ('<svg xmlns="http://www.w3.org/2000/svg"><text>3</text></svg>', "has no lines"),
        ("<html/>", "its first element is not svg"),
        ('<g stroke="#000" fill="none" transform="turn(3)"><path d="M0 0 L1 1"/></g>', "no transform"),
        ('<g stroke="#000" fill="none"><path d="M0 0 L1"/></g>', "too few numbers"),
        ('<g stroke="#000" fill="none"><path d="M0 0 L1e300 1"/></g>', "a kilometre away"),
        ('<svg width="10mm" viewBox="0 0 0 0"/>', "no width"),
        ('<!DOCTYPE svg [<!ENTITY a "b">]><svg xmlns="http://www.w3.org/2000/svg">&a;</svg>', "entities"),
    ],
)
def test_what_cannot_be_read_is_refused_in_one_sentence(tmp_path, text, why):
    with pytest.raises(SourceError, match=why) as caught:
        read(tmp_path, text)
    assert "other.svg" in str(caught.value) and "\n" not in str(caught.value)


@pytest.mark.parametrize("side", ["before", "after"])
def test_hidden_lines_under_visible_ones_and_lines_drawn_again_are_named_once(side, tmp_path):
    doubled = FRAGMENT.replace('d=" M 0 -5', 'd="M -25 6 L -5 6"/><path d=" M 0 -5')
    doubled = doubled.replace("<circle", '<path d="M 5 6 L 20 6"/><circle')
    ours = [
        line([[-30, -6], [20, -6]]),
        arc((0, 0), 6, 6, (0, 2 * math.pi)),
        line([[0, 5], [20, 5]], visible=False),
    ]
    both = drawing(ours), read_path(tmp_path, doubled)
    found = compare(*(both if side == "after" else reversed(both)))
    assert found.same and found.lengths_mm["doubled"] == pytest.approx(35, abs=0.5)
    assert {(each.visible, each.side) for each in found.differences} == {(True, side), (False, side)}
    assert "drawn twice" in found.summary


def test_a_hidden_arc_under_a_visible_one_that_begins_elsewhere_is_no_difference(tmp_path):
    begins = np.linspace(0.1, 2.9, 15)
    ends = [(9 * math.cos(t), 9 * math.sin(t)) for t in begins]
    arcs = "".join(f'<path d="M {x:.6g} {y:.6g} A 9 9 0 0 1 -9 0"/>' for x, y in ends)
    text = FRAGMENT.replace('<circle cx ="0" cy ="0" r ="6" />', '<circle cx="0" cy="0" r="9"/>').replace(
        '<path id= "2" d=" M 0 -5 L 20 -5 " />', f'<path d="M 0 -5 L 20 -5"/>{arcs}'
    )
    ours = [
        line([[-30, -6], [20, -6]]),
        arc((0, 0), 9, 9, (0, 2 * math.pi)),
        line([[0, 5], [20, 5]], visible=False),
    ]
    found = compare(read_path(tmp_path, text), drawing(ours))
    assert found.same and found.lengths_mm["gone"] == 0.0, found.summary


@pytest.mark.parametrize("pieces", [20, 8])
def test_straight_pieces_instead_of_a_curve_are_named_with_their_error(tmp_path, pieces):
    found = compare(*arc_and_chords(tmp_path, pieces))
    (bent,) = found.differences
    error = 20 * (1 - math.cos(0.25 * math.pi / pieces))
    assert bent.kind == "polyline" and bent.became == "straight pieces" and bent.line_class == "sharp"
    assert bent.moved_mm == pytest.approx(error, abs=0.002) and bent.length_mm == pytest.approx(10 * math.pi, rel=0.01)
    assert found.same


def test_straight_pieces_beyond_the_tolerance_make_a_difference(tmp_path):
    found = compare(*arc_and_chords(tmp_path, 5))
    assert {each.kind for each in found.differences} == {"polyline"} and not found.same
    assert max(each.moved_mm for each in found.differences) == pytest.approx(
        20 * (1 - math.cos(0.05 * math.pi)), abs=0.01
    )


def arc_and_chords(tmp_path, pieces):
    """A quarter of a circle in a frame, by hlr and as a fragment of straight pieces."""
    turns = np.linspace(0.0, 0.5 * math.pi, pieces + 1)
    points = " L ".join(f"{20 * math.cos(t):.6g} {20 * math.sin(t):.6g}" for t in turns)
    square = '<path d="M -30 -30 L 30 -30 L 30 30 L -30 30 Z"/>'
    frame = line([[-30, -30], [30, -30], [30, 30], [-30, 30], [-30, -30]])
    text = f'<g fill="none" stroke="#000" stroke-width="0.7">{square}<path d="M {points}"/></g>'
    return drawing([frame, arc((0, 0), 20, 20, (-0.5 * math.pi, 0))]), read_path(tmp_path, text)


def read_path(tmp_path, text):
    path = tmp_path / "other.svg"
    path.write_text(text)
    return path


def test_what_is_unknown_agrees_with_everything(tmp_path):
    ours = [line([[75, 150], [85, 150]]), line([[75, 145], [85, 145]], "smooth", visible=False)]
    page = PAGE.format(edge=EDGE, dash="").replace("A40 40 0 0 1 40 40", "L100 0")
    found = compare(
        read_path(tmp_path, page), drawing([*ours, line([[200, 150], [210, 150]], "outline")]), register="off"
    )
    assert found.same and not found.differences


def test_a_sketch_counts_its_lines():
    assert len(Sketch()) == 0
