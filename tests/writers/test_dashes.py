"""Dashes of hidden lines: fitted to each stroke, and the same in SVG and PDF."""

import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from math import pi

import numpy as np
import pytest
from writers.pages import content_of, image

import hlr
from hlr.drawing.curve import Arc
from hlr.writers.pdf import pdf
from hlr.writers.svg import svg
from support.at_size import AT_SIZE
from support.drawings import drawing, line

NS = {"s": "http://www.w3.org/2000/svg"}


def patterns_of_svg(made):
    """(lengths, offset) of each hidden element, in the order of drawing."""
    hidden = ET.fromstring(svg(made)).find("s:g[@id='hidden']", NS)
    names = {f"{{{NS['s']}}}{name}" for name in ("path", "circle", "ellipse")}
    elements = [element for element in hidden.iter() if element.tag in names]
    return [(e.get("stroke-dasharray", ""), e.get("stroke-dashoffset", "0")) for e in elements]


def patterns_of_pdf(made):
    """The same of each stroke that is painted in a hidden layer."""
    found, pattern, hidden = [], ("", "0"), False
    for command in content_of(pdf(made)).splitlines():
        if "BDC" in command:
            hidden, pattern = " .25 w 0 J " in command, ("", "0")
        elif command.endswith(" d"):
            lengths, offset = re.fullmatch(r"\[(.*)\] (\S+) d", command).groups()
            pattern = (lengths, offset)
        elif hidden and command.endswith((" S", " s")):
            found.append(pattern)
    return found


def circle(radius, visible=False, turned=0.3, minor=None):
    """A whole circle or ellipse as a line, begun at an angle of its own."""
    s, c = np.sin(turned), np.cos(turned)
    minor = radius if minor is None else minor
    axes = np.array([[radius * c, radius * s], [-minor * s, minor * c]])
    arc = Arc(np.array([30.0, 20.0]), axes, np.array([1.0, 1.0 + 2.0 * pi]))
    points = arc.at(np.linspace(*arc.angles, 65))
    points[-1] = points[0]
    return replace(line(points, visible=visible), curve=arc)


def assert_same_places(made):
    """SVG and PDF have the same dashes, within what an arc and its cubic curves differ in length; how many strokes."""
    found, same = patterns_of_svg(made), patterns_of_pdf(made)
    assert [len(lengths.split()) for lengths, _ in found] == [len(lengths.split()) for lengths, _ in same]
    for ours, theirs in zip(found, same, strict=True):
        assert [*map(float, " ".join(ours).split())] == pytest.approx([*map(float, " ".join(theirs).split())], abs=2e-3)
    return len(found)


@pytest.mark.parametrize("length", [0.5, 1.5, 1.9, 2.5, 3.75, 4.0, 5.0, 7.3, 20.0, 111.1, 500.0])
def test_a_hidden_line_begins_and_ends_with_a_dash(length):
    ink = image(drawing([line([[0, 0], [length, 0]], visible=False)]), 20) < 128
    columns = ink.any(axis=0)[110 : 110 + round(20 * length)]
    assert columns[:6].all() and columns[-6:].all()
    gaps = np.flatnonzero(np.diff(columns.astype(int)) == 1)
    assert len(gaps) > 0 or length < 1.9


def test_hidden_lines_meet_at_a_corner():
    ink = image(drawing([line([[0, 0], [17, 0]], visible=False), line([[17, 0], [17, 11]], visible=False)]), 20)
    assert (ink[-130:-111, 110 + 17 * 20 - 2] < 128).all()
    assert (ink[-111, 110 + 16 * 20 : 110 + 17 * 20] < 128).all()


def test_a_gap_comes_first_where_a_visible_line_goes_on():
    straight = drawing([line([[0, 0], [20, 0]]), line([[20, 0], [40, 0]], visible=False)])
    ink = (image(straight, 20) < 128).any(axis=0)
    # The visible line has a round end of a quarter of a millimetre.
    assert not ink[110 + 20 * 20 + 6 : 110 + 20 * 20 + 12].any()
    assert ink[110 + 40 * 20 - 6 : 110 + 40 * 20 - 2].all()
    turned = drawing([line([[20, -9], [20, 0]]), line([[20, 0], [40, 0]], visible=False)])
    assert (image(turned, 20)[:, 20 * 20 : 20 * 20 + 20] < 128).any(axis=0).all()


@pytest.mark.parametrize("radius", [0.1, 0.3, 0.5, 0.8, 1.0, 2.0, 5.0, 40.0])
def test_a_small_hidden_circle_is_still_a_circle(radius):
    ((lengths, offset),) = patterns_of_svg(drawing([circle(radius)]))
    around = 2 * pi * radius
    if not lengths:
        assert around < 4.5  # drawn through
        return
    dash, gap = map(float, lengths.split())
    times = around / (dash + gap)
    assert times == pytest.approx(round(times), abs=0.05)
    assert round(times) >= 4 and gap >= 0.37 and offset == "0"


def test_dashes_fall_on_the_same_places_in_svg_and_pdf():
    lines = [circle(9.0), circle(5.0, turned=2.0), circle(20.0, turned=-1.2, minor=6.0)]
    lines += [line([[60, 0], [80, 0], [80, 13], [60, 13], [60, 0]], visible=False)]
    lines += [line([[60, 20], [70, 20]]), line([[70, 20], [91, 20]], visible=False)]
    made = drawing(lines)
    assert_same_places(made)
    whole = re.findall(r"^(\S+) (\S+) m (\S+) (\S+) (\S+) (\S+) (\S+) (\S+) c", content_of(pdf(made)), re.MULTILINE)
    starts = [tuple(map(float, row[:2])) for row in whole]
    # A renderer of SVG begins a circle on the right of its centre, an ellipse at the right end of its first axis.
    assert starts[:2] == [pytest.approx((39, 20), abs=1e-3), pytest.approx((35, 20), abs=1e-3)]
    axis = np.array([np.cos(-1.2), np.sin(-1.2)])
    assert starts[2] == pytest.approx(tuple([30, 20] + 20 * axis), abs=2e-3)
    # And goes on clockwise, which is downward there.
    assert all(float(row[3]) < float(row[1]) for row in whole[:2])


def test_dashes_of_a_model_are_the_same_in_svg_and_pdf():
    import cadquery as cq

    part = cq.Workplane().box(60, 40, 20).edges("|Z").fillet(6).faces(">Z").workplane().cboreHole(8, 14, 5)
    part = part.cut(cq.Workplane("XZ").center(0, 2).circle(4).extrude(80, both=True))
    for view in ("iso", "front", (3.0, -1.0, 0.4)):
        made = hlr.draw(part, view=view, **AT_SIZE)
        assert assert_same_places(made) > 5


def test_dashes_of_a_long_line_end_where_it_ends():
    """At a hundred metres on paper, what the rounding of dash and gap adds up to is still less than a gap."""
    ((lengths, _),) = patterns_of_svg(drawing([line([[0, 0], [100_000, 0]], visible=False)]))
    dash, gap = map(float, lengths.split())
    rest = (100_000 + gap) / (dash + gap)
    assert abs(rest - round(rest)) * (dash + gap) < 0.1
