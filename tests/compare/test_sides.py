"""Sides as files: SVG and JSON of one drawing are the same; what is damaged or hostile is refused in one sentence."""

import numpy as np
import pytest

from hlr.compare import compare
from hlr.errors import SourceError
from support.drawings import arc, bezier, drawing, line, on_page, part, sample

HEAD = '<svg xmlns="http://www.w3.org/2000/svg"><metadata><drawing xmlns="urn:hlr:drawing:1"/></metadata>'
GROUPS = '<g class="visible"><g class="sharp">'


def svg(body):
    return f"{HEAD}{GROUPS}{body}</g></g></svg>"


def curved():
    """Whole circles and ellipses, arcs in both directions, curves of both degrees, chains."""
    return drawing(
        [
            arc((40, 15), 8, 8, (0, 2 * np.pi)),
            arc((10, 15), 8, 3, (0, 2 * np.pi), 0.7, visible=False),
            *(arc((30, 40), 9 + n, 4, (0.2, 0.2 + turn), n) for n, turn in enumerate((1.0, -2.0, 4.0, -5.0))),
            bezier(2, [[0, 0], [10, 20], [20, 0], [30, -20], [40, 0], [55, 3], [60, 9]], kind="smooth"),
            bezier(3, [[0, 60], [10, 80], [20, 60], [30, 50], [40, 40], [45, 60], [50, 70]], part=1, edge=4),
            line([[0, 0], [0, 10], [10, 10], [0, 0]], edge=2),
        ]
    )


@pytest.mark.parametrize("style", ["standard", "dark", {"layers": "part"}])
@pytest.mark.parametrize("made", [sample, on_page, curved], ids=lambda made: made.__name__)
def test_svg_and_json_and_the_drawing_itself_are_the_same(made, style, tmp_path):
    original = made() if style == "standard" else made().with_style(style)
    sides = [original, original.save(tmp_path / "a.svg"), original.save(tmp_path / "a.json")]
    for a in sides:
        for b in sides:
            found = compare(a, b, tolerance_mm=0.02)
            assert found.same, found.summary


def test_svg_tells_part_edge_and_class(tmp_path):
    lines = [line([[0, 0], [10, 0]]), line([[5, 5], [5, 25]], "smooth", visible=False, part=1, edge=7)]
    parts = (part("plate"), part('M6 <bolt> & "nut"'))
    before = drawing(lines, parts=parts).save(tmp_path / "a.svg")
    (one,) = compare(before, drawing(lines[:1], parts=parts)).differences
    assert (one.part, one.edge, one.line_class, one.visible) == ('M6 <bolt> & "nut"', 7, "smooth", False)
    assert (one.place, one.length_mm) == ((5.0, 15.0), 20.0)


REFUSED = {
    "no XML": "<svg",
    "none of ours": '<svg xmlns="http://www.w3.org/2000/svg"/>',
    "another root": "<html/>",
    "entities": '<!DOCTYPE svg [<!ENTITY a "b"><!ENTITY c "&a;&a;">]>' + svg("&c;"),
    "an outside entity": '<!DOCTYPE svg [<!ENTITY a SYSTEM "file:///etc/passwd">]>' + svg("&a;"),
    "too few numbers": svg('<path d="M0 0 C1 2 3"/>'),
    "a number without a command": svg('<path d="1 2"/>'),
    "numbers after the end": svg('<path d="M0 0h1z3"/>'),
    "no path data": svg('<path d="M0 0 $(rm)"/>'),
    "not finite": svg('<path d="M0 0L1e999 0"/>'),
    "NaN": svg('<circle cx="nan" cy="0" r="1"/>'),
    "no number": svg('<circle cx="x" cy="0" r="1"/>'),
    "far away": svg('<path d="M0 0L1e30 0"/>'),
    "too many pieces": svg('<circle cx="0" cy="0" r="900000"/>' * 300),
    "a part that is none": svg('<g data-part="x"><path d="M0 0h1"/></g>'),
    "an edge beyond all": svg('<path d="M0 0h1" data-edge="99999999999999999999"/>'),
    "moved by another program": f'{HEAD}<g transform="scale(2)">{GROUPS}<path d="M0 0h1"/></g></g></g></svg>',
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_damaged_or_hostile_file_is_refused(name, tmp_path):
    path = tmp_path / "bad.svg"
    path.write_text(REFUSED[name])
    with pytest.raises(SourceError, match=r"bad\.svg") as refused:
        compare(path, drawing([]), tolerance_mm=0.001)
    assert "root:" not in str(refused.value)


@pytest.mark.slow
def test_groups_a_hundred_thousand_deep_are_read(tmp_path):
    path = tmp_path / "deep.svg"
    deep = 100_000
    path.write_text(svg("<g>" * deep + '<path d="M0 0h10"/>' + "</g>" * deep))
    assert compare(path, drawing([line([[0, 0], [10, 0]])])).same


@pytest.mark.parametrize("given", ["none.svg", ".", "a.step", 3, None])
def test_what_cannot_be_compared_is_refused(given, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.step").write_text("ISO-10303-21;")
    with pytest.raises(SourceError):
        compare(given, drawing([]))


def test_a_part_number_without_a_name_is_no_error(tmp_path):
    path = tmp_path / "a.svg"
    path.write_text(svg('<g data-part="7"><path d="M0 0h10"/></g>'))
    assert [each.part for each in compare(path, drawing([])).differences] == [None]
