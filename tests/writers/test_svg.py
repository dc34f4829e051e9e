import re
import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from writers import golden

from hlr.drawing.pens import usual_pens
from hlr.request.style import LineRule, Style
from hlr.writers.svg import svg
from support.drawings import drawing, line, on_page, part, sample

NS = {"s": "http://www.w3.org/2000/svg", "d": "urn:hlr:drawing:1"}
TOKEN = re.compile(r"([Mlhvz])|(-?(?:\d+\.?\d*|\.\d+))")


def tree(made):
    return ET.fromstring(svg(made))


def points_of(d):
    """A path reader made from the grammar, apart from the writer: list of (x, y), and whether it is closed."""
    points, command, numbers, closed = [], "", [], False
    assert TOKEN.sub("", d).strip() == ""
    for letter, text in TOKEN.findall(d):
        if letter == "z":
            closed = True
        elif letter:
            command = letter
        else:
            numbers.append(float(text))
            x, y = points[-1] if points else (0.0, 0.0)
            if command == "h":
                points.append((x + numbers.pop(), y))
            elif command == "v":
                points.append((x, y + numbers.pop()))
            elif len(numbers) == 2:
                dx, dy = numbers
                points.append((dx, dy) if command == "M" else (x + dx, y + dy))
                numbers = []
    assert not numbers
    return np.array(points), closed


def test_golden():
    golden.check("sample.svg", svg(sample()).decode())
    golden.check("page.svg", svg(on_page()).decode())


def test_the_golden_file_notices_a_hundredth_of_a_millimetre():
    made = sample()
    moved = replace(made.lines[4], points=made.lines[4].points + [[0.01, 0.0], [0.0, 0.0]])
    changed = replace(made, lines=(*made.lines[:4], moved, *made.lines[5:]))
    assert svg(changed).decode() != (golden.GOLDEN / "sample.svg").read_text()


def test_size_is_in_millimetres_and_y_points_down():
    root = tree(drawing([line([[-10, 20], [30, 50]])]))
    assert (root.get("width"), root.get("height")) == ("51mm", "41mm")
    assert root.get("viewBox") == "-15.5 -55.5 51 41"
    assert root.find(".//s:path", NS).get("d") == "M-10-20l40-30"


def test_paths_name_their_part_and_edge():
    root = tree(sample())
    for group, visible in ((root.find("s:g[@id='visible']", NS), True), (root.find("s:g[@id='hidden']", NS), False)):
        drawn = {
            (sub.get("class"), int(of_part.get("data-part")), path.get("data-edge"))
            for sub in group
            for of_part in sub
            for path in of_part
        }
        assert drawn == {
            (entry.kind, entry.part, None if entry.edge is None else str(entry.edge))
            for entry in sample().lines
            if entry.visible is visible
        }


def test_hidden_lines_are_drawn_first_narrow_and_dashed():
    root = tree(sample())
    groups = root.findall("s:g", NS)
    assert [group.get("id") for group in groups] == ["hidden", "visible"]
    hidden, visible = groups
    assert all(path.get("stroke-dasharray") for path in hidden.findall(".//s:path", NS))
    assert not any(path.get("stroke-dasharray") for path in visible.findall(".//s:path", NS))
    assert (hidden.get("stroke-width"), visible.get("stroke-width")) == (".25", ".5")
    widths = {group.get("class"): group.get("stroke-width") for group in visible}
    assert widths["smooth"] == widths["seam"] == ".25"
    assert {widths[kind] for kind in ("sharp", "outline", "boundary", "intersection")} == {None}


def test_widths_are_those_of_the_style():
    rules = [LineRule(kind=kind, width=width) for kind, width in (("sharp", 0.7), ("smooth", 0.13), ("outline", 0.35))]
    made = replace(sample(), style=Style(lines=rules, wide=0.18))
    pens = usual_pens(made.style)
    drawn = [(group, of_kind) for group in tree(made).findall("s:g", NS) for of_kind in group]
    assert len(drawn) == 9
    for group, of_kind in drawn:
        width = of_kind.get("stroke-width") or group.get("stroke-width")
        assert float(width) == pens.pen(of_kind.get("class"), group.get("id") == "visible").width


def test_metadata_names_the_source_the_view_and_the_parts():
    root = tree(sample())
    assert root.find("s:title", NS).text == "box.step, iso, 1:1"
    about = root.find("s:metadata/d:drawing", NS)
    assert about.get("source") == "box.step"
    assert about.get("accuracy") == "0.05"
    names = [(entry.get("name"), entry.get("color")) for entry in about]
    assert names == [("box", None), ('M6 <bolt> & "nut" ü\N{REPLACEMENT CHARACTER}', "#ff8000")]


def test_names_cannot_break_out_of_the_markup():
    made = drawing([line([[0, 0], [1, 1]])], parts=[part("\"><script>'\ud800\x00]]>&")], source="a<b>.step")
    root = tree(made)
    assert root.find(".//d:part", NS).get("name") == "\"><script>'\ufffd\ufffd]]>&"
    assert not root.findall(".//script")


def test_a_scale_is_stated_as_on_paper():
    assert tree(drawing([], scale=0.5)).find("s:title", NS).text.endswith("1:2")
    assert tree(drawing([], scale=2.0)).find("s:title", NS).text.endswith("2:1")


def test_an_empty_drawing_is_a_valid_file():
    root = tree(drawing([]))
    assert root.get("width") == "11mm"
    assert not root.findall(".//s:path", NS)


@pytest.mark.parametrize(
    ("points", "d"),
    [
        ([[12, -0.5], [12.5, -1]], "M12 .5l.5.5"),
        ([[0.5, -0.5], [1, -12]], "M.5.5l.5 11.5"),
        ([[-0.5, 0.5], [-1, 12]], "M-.5-.5l-.5-11.5"),
        ([[0, 0], [5, 0], [9, 0], [9, 1], [9, 2], [8, 3], [7, 5]], "M0 0h5 4v-1-1l-1-1-1-2"),
        ([[0, 0], [0.25, 0], [0.5, 0], [3.5, -0.25]], "M0 0h.25.25l3 .25"),
        ([[100, -0.001], [100.001, 0]], "M100 .001l.001-.001"),
    ],
)
def test_no_character_too_many_and_none_too_few(points, d):
    assert tree(drawing([line(points)])).find(".//s:path", NS).get("d") == d


coordinate = st.one_of(st.integers(-3, 3).map(float), st.floats(-500, 500))
polyline = st.lists(st.tuples(coordinate, coordinate), min_size=2, max_size=8)


@pytest.mark.slow
@settings(max_examples=200)
@given(st.lists(polyline, min_size=1, max_size=5), st.sampled_from([0.5, 0.05, 0.001]))
@example([[(0.0, 0.0), (0.0, 6.103515625e-05)]], 0.001)  # one step of the grid: both ends near both points
def test_paths_run_through_the_points(polylines, accuracy):
    made = drawing([line(points, edge=i) for i, points in enumerate(polylines)], accuracy=accuracy)
    found = {int(path.get("data-edge")): points_of(path.get("d")) for path in tree(made).findall(".//s:path", NS)}
    for i, polyline in enumerate(polylines):
        asked = np.array(polyline) * [1, -1]
        if i not in found:
            assert np.ptp(asked, axis=0).max() < accuracy / 5
            continue
        drawn, closed = found[i]
        if closed:
            drawn = np.vstack([drawn, drawn[:1]])
        # The path passes each asked point, in order, within a tenth of the accuracy; it has no other vertices.
        near = accuracy / 10 * 1.000001
        at = 0
        for point in asked:
            while from_segment(point, *drawn[[at, min(at + 1, len(drawn) - 1)]]) > near:
                at += 1
                assert at < len(drawn)
        assert np.hypot(*(drawn[[0, -1]] - asked[[0, -1]]).T).max() <= near
        assert np.hypot(*np.moveaxis(drawn[:, None] - asked[None], 2, 0)).min(axis=1).max() <= near


def from_segment(point, start, end):
    way, arm = end - start, point - start
    share = np.clip(arm @ way / (way @ way), 0, 1) if way.any() else 0.0
    return np.hypot(*(arm - way * share))


@pytest.mark.parametrize("turn", [0.0, 30.0])
def test_points_of_one_straight_line_are_written_as_its_ends(turn):
    way = np.array([np.cos(np.radians(turn)), np.sin(np.radians(turn))])
    shares = np.array([0.0, 0.01, 0.3, 0.31, 2.0])[:, None]

    def paths(points):
        return [points_of(path.get("d"))[0] for path in tree(drawing([line(points)])).findall(".//s:path", NS)]

    (straight,) = paths(shares * way)
    assert len(straight) == 2
    # One that bends by a thousandth of a millimetre, or runs back, keeps its points.
    bent = shares * way
    bent[2] += 1e-3 * way[::-1] * [-1, 1]
    assert len(paths(bent)[0]) > 2
    assert len(paths(shares[[0, 2, 1, 4]] * way)[0]) > 2


def test_the_same_bytes_again():
    assert svg(sample()) == svg(sample())


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_a_point_that_is_not_finite_is_refused(bad):
    from hlr.errors import WriteError

    with pytest.raises(WriteError, match="not finite"):
        svg(drawing([line([[0, 0], [bad, 1]])]))
