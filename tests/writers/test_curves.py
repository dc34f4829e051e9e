"""Arcs and Bezier curves in SVG and PDF."""

import math
import re
import zlib
from dataclasses import replace

import numpy as np

from hlr.writers.pdf import pdf
from hlr.writers.strokes import strokes
from hlr.writers.svg import svg
from support.drawings import arc, bezier, drawing, line


def drawn(*lines):
    """Elements of the lines, without what ties them to the model."""
    text = svg(drawing(lines)).decode()
    return [re.sub(r' data-\w+="\d+"', "", element) for element in re.findall(r"<(?:path|circle|ellipse)[^>]*>", text)]


def content(*lines):
    return zlib.decompress(re.search(rb"stream\n(.*?)\nendstream", pdf(drawing(lines)), re.S)[1]).decode()


def test_whole_circles_and_ellipses_are_elements():
    assert drawn(arc((5, 5), 3, 3, (0.5, 0.5 + math.tau))) == ['<circle cx="5" cy="-5" r="3"/>']
    assert drawn(arc((5, 5), 3, 1.25, (0, -math.tau))) == ['<ellipse cx="5" cy="-5" rx="3" ry="1.25"/>']
    (turned,) = drawn(arc((5, 5), 3, 1.25, (0, math.tau), turn=math.pi / 6))
    assert turned == '<ellipse cx="5" cy="-5" rx="3" ry="1.25" transform="rotate(-30 5 -5)"/>'


def test_arcs_turn_the_way_they_run():
    quarter = math.pi / 2
    assert drawn(arc((5, 5), 3, 3, (0, quarter))) == ['<path d="M8-5a3 3 0 0 0-3-3"/>']
    assert drawn(arc((5, 5), 3, 3, (quarter, 0))) == ['<path d="M5-8a3 3 0 0 1 3 3"/>']
    assert drawn(arc((5, 5), 3, 3, (0, -quarter))) == ['<path d="M8-5a3 3 0 0 1-3 3"/>']
    assert drawn(arc((5, 5), 3, 3, (0, 3 * quarter))) == ['<path d="M8-5a3 3 0 1 0-3 3"/>']


def test_pieces_of_one_arc_become_one_stroke():
    one, two = arc((5, 5), 3, 3, (0, 1), edge=4), arc((5, 5), 3, 3, (1, 2), edge=4)
    (element,) = drawn(one, two)
    assert element.count("a3 3 0 0 0") == 1
    assert len(re.findall(r"-?\d*\.?\d+", element)) == 2 + 2 * 7


def test_bezier_curves_leave_out_what_goes_without_saying():
    assert drawn(bezier(3, [[0, 0], [1, 2], [3, 2], [4, 0]])) == ['<path d="M0 0c1-2 3-2 4 0"/>']
    smooth = [[0, 0], [1, 2], [3, 2], [4, 0], [5, -2], [7, -2], [8, 0]]
    assert drawn(bezier(3, smooth)) == ['<path d="M0 0c1-2 3-2 4 0s3 2 4 0"/>']
    assert drawn(bezier(2, [[0, 0], [1, 2], [2, 0], [3, -2], [4, 0]])) == ['<path d="M0 0q1-2 2 0t2 0"/>']


def test_a_curve_that_ends_where_it_begins_is_closed():
    loop = bezier(3, [[0, 0], [4, 4], [-4, 4], [0, 0]])
    assert drawn(loop) == ['<path d="M0 0c4-4-4-4 0 0z"/>']


def test_the_page_holds_what_bulges_beyond_the_points():
    half = arc((0, 0), 10, 10, (0, math.pi))
    assert np.ptp(half.points[:, 1]) < 1e-9
    page = strokes(drawing([half]))
    assert (page.bottom, page.height) == (-5.5, 10.0 + 2 * 5.5)


def test_pdf_has_cubic_curves_for_everything():
    quadratic = bezier(2, [[0, 0], [3, 3], [6, 0]])
    assert "0 0 m 2 2 4 2 6 0 c S" in content(quadratic)
    circle = content(arc((5, 5), 3, 3, (0, math.tau)))
    assert len(re.findall(r" c\b", circle)) == 4 and " s\n" in circle and " l" not in circle


def test_curves_that_are_not_finite_are_refused():
    import pytest

    from hlr.errors import WriteError

    broken = arc((math.nan, 5), 3, 3, (0, 1))
    with pytest.raises(WriteError):
        svg(drawing([replace(broken, points=np.array([[0.0, 0.0], [1.0, 1.0]]))]))


def test_a_line_keeps_its_place_among_arcs():
    """One layer of lines and arcs holds the rows of each as if it were alone, one after another."""
    lines = [
        line([[0, 0], [1, 2], [3, 1]], edge=0),
        arc((5, 5), 3, 3, (0, 1), edge=1),
        line([[9, 9], [8, 7]], edge=2),
        arc((20, 5), 3, 2, (0, math.tau), edge=3),
        arc((30, 5), 4, 4, (2, 1), edge=4),
        line([[40, 0], [41, 2], [43, 1], [44, 4]], edge=5),
    ]
    (inked,) = strokes(drawing(lines)).inked
    rows, alone = inked.layer.rows(), [strokes(drawing([each])).inked[0].layer.rows() for each in lines]
    assert inked.layer.ties[:, 1].tolist() == [0, 1, 2, 3, 4, 5]
    assert rows["points"].tolist() == [row for each in alone for row in each["points"].tolist()]
    assert rows["op"].tolist() == [op for each in alone for op in each["op"].tolist()]
    turns = [rows["shapes"][i].tolist() for i in rows["arc"].tolist() if i >= 0]
    assert turns == [each["shapes"][i].tolist() for each in alone for i in each["arc"].tolist() if i >= 0]
