"""DXF files as sides: ours say all of their lines; of others layers and linetypes do; hostile ones are refused."""

import math
from pathlib import Path

import ezdxf
import pytest

from hlr.compare import compare
from hlr.compare.reading import dxf as dxf_side
from hlr.compare.reading.sides import side_of
from hlr.errors import SourceError
from support.drawings import arc, bezier, drawing, line, on_page, part, sample

DATA = Path(__file__).parents[1] / "data"
FRONT_MM = 1129.9
"""Visible and hidden lines of the view, as FreeCAD counts them."""

CURVES = [
    arc((40, 15), 8, 8, (0, math.tau)),
    arc((10, 15), 8, 3, (0, math.tau), 0.7, visible=False),
    *(arc((30, 40), 9 + n, 4, (0.2, 0.2 + turn), n) for n, turn in enumerate((1.0, -2.0, 4.0, -5.0))),
    bezier(2, [[0, 0], [10, 20], [20, 0], [30, -20], [40, 0], [55, 3], [60, 9]], kind="smooth"),
    bezier(3, [[0, 60], [10, 80], [20, 60], [30, 50], [40, 40], [45, 60], [50, 70]]),
]


def file(tmp_path, fill, units=4, **header):
    """A DXF file whose model space `fill` fills."""
    document = ezdxf.new("R2010", units=units)
    document.linetypes.add("HIDDEN", [0.375, 0.25, -0.125])
    document.linetypes.add("CENTER", [2.0, 1.25, -0.25, 0.25, -0.25])
    fill(document, document.modelspace())
    path = tmp_path / "other.dxf"
    document.saveas(path)
    return path


@pytest.mark.parametrize("version", ["R12", "R2000", "R2018"])
@pytest.mark.parametrize("made", [sample, on_page, lambda: drawing(CURVES)], ids=["sample", "page", "curves"])
def test_our_dxf_and_our_svg_are_the_same(made, version, tmp_path):
    original = made().with_style({"dxf": version})
    found = compare(original.save(tmp_path / "a.svg"), original.save(tmp_path / "a.dxf"), tolerance_mm=0.02)
    assert found.same, found.summary


@pytest.mark.parametrize("layers", ["class", "part"])
def test_our_dxf_tells_part_edge_and_class(layers, tmp_path):
    lines = [line([[0, 0], [10, 0]]), line([[5, 5], [5, 25]], "smooth", visible=False, part=1, edge=7)]
    original = drawing(lines, parts=(part("plate"), part("bolt"))).with_style({"layers": layers})
    (one,) = compare(original.save(tmp_path / "a.dxf"), drawing(lines[:1])).differences
    assert (one.part, one.edge, one.line_class, one.visible) == ("bolt", 7, "smooth", False)
    assert (one.place, one.length_mm) == ((5.0, 15.0), 20.0)


def of_file(path, name="pieces"):
    side = side_of(path, 0.1)
    return side.pieces if name == "pieces" else side.about


def seen(path):
    """Of each line whether it is visible."""
    pieces = of_file(path)
    return dict(zip(pieces.line.tolist(), pieces.visible.tolist(), strict=True))


def test_dashes_are_hidden_lines_by_the_entity_its_layer_or_the_block(tmp_path):
    def fill(document, model):
        document.layers.add("dashed", linetype="HIDDEN")
        document.layers.add("off").off()
        document.layers.add("axes", linetype="CENTER")
        block = document.blocks.new("b")
        block.add_line((0, 0), (1, 0), {"linetype": "BYBLOCK"})
        block.add_line((0, 1), (1, 1))  # on layer 0: that of the insert
        for attributes in ({}, {"linetype": "HIDDEN"}, {"layer": "dashed"}, {"layer": "off"}, {"layer": "axes"}):
            model.add_line((0, 5), (9, 5), attributes)
        model.add_blockref("b", (0, 9), {"linetype": "HIDDEN", "layer": "dashed"})
        model.add_text("a")

    path = file(tmp_path, fill)
    assert seen(path) == {0: 1, 1: 0, 2: 0, 3: 0, 4: 0}
    left_out = {"centre lines": 1, "lines that are not shown": 1, "texts": 1}
    assert of_file(path, "about").left_out == left_out
    found = compare(path, path)
    assert found.left_out == (left_out, left_out) and found.to_dict()["left_out"][0]["texts"] == 1


@pytest.mark.parametrize(
    ("layers", "expected"),
    [(["0", "Front"], [-1, -1]), (["VISIBLE", "x_hidden"], [1, 0]), (["FrontHidden", "HiddenOnly"], [-1, -1])],
)
def test_without_dashes_layers_say_what_is_visible_or_nothing_does(layers, expected, tmp_path):
    path = file(tmp_path, lambda _, model: [model.add_line((0, 0), (9, 0), {"layer": each}) for each in layers])
    assert list(seen(path).values()) == expected


def expected_length(entity):
    return {
        "bulge": math.pi * 5.0,
        "closed": 40.0,
        "upside down": math.pi * 5.0,
        "minsert": 60.0,
        "squeezed": 2.0 * 24.221,  # an ellipse with axes of 10 and 5
        "rational": math.pi * 10.0 / 2.0,
        "quartic": 10.0,
    }[entity]


ENTITIES = {
    "bulge": lambda _, m: m.add_lwpolyline([(0, 0, -1.0), (10, 0, 0)], "xyb"),
    "closed": lambda _, m: m.add_polyline2d([(0, 0), (10, 0), (10, 10), (0, 10)], close=True),
    "upside down": lambda _, m: m.add_arc((5, 0), 5, 0, 180, dxfattribs={"extrusion": (0, 0, -1)}),
    "minsert": lambda d, m: (
        d.blocks.new("b").add_line((0, 0), (10, 0)),
        m.add_blockref("b", (0, 0), {"row_count": 3, "row_spacing": 5, "column_count": 2, "column_spacing": 20}),
    ),
    "squeezed": lambda d, m: (
        d.blocks.new("b").add_circle((0, 0), 5),
        m.add_blockref("b", (0, 0), {"xscale": 2.0}),
    ),
    "rational": lambda _, m: m.add_rational_spline(
        [(10, 0), (10, 10), (0, 10)], [1.0, math.sqrt(0.5), 1.0], degree=2, knots=[0, 0, 0, 1, 1, 1]
    ),
    "quartic": lambda _, m: m.add_open_spline([(2.5 * n, 0) for n in range(5)], degree=4),
}


@pytest.mark.parametrize("entity", ENTITIES)
def test_entities_have_their_length(entity, tmp_path):
    assert of_file(file(tmp_path, ENTITIES[entity])).lengths.sum() == pytest.approx(expected_length(entity), abs=0.01)


def test_a_bulge_to_the_right_lies_on_the_left(tmp_path):
    pieces = of_file(file(tmp_path, ENTITIES["bulge"]))
    assert pieces.start[:, 1].max() == pytest.approx(5.0, abs=0.01) and pieces.start[:, 1].min() > -1e-9


def test_inches_become_millimetres(tmp_path):
    path = file(tmp_path, lambda _, model: model.add_line((0, 0), (2, 0)), units=1)
    assert of_file(path).lengths.sum() == pytest.approx(50.8)


def nested(document, model):
    """Ten blocks, each with ten of the next."""
    for n in range(10):
        block = document.blocks.new(f"b{n}")
        for _ in range(10):
            block.add_blockref(f"b{n + 1}", (0, 0))
    document.blocks.new("b10").add_line((0, 0), (1, 0))
    model.add_blockref("b0", (0, 0))


def itself(document, model):
    document.blocks.new("b").add_blockref("b", (0, 0))
    model.add_blockref("b", (0, 0))


HOSTILE = {
    "nested": nested,
    "itself": itself,
    "rows": lambda d, m: (
        d.blocks.new("b").add_line((0, 0), (1, 0)),
        m.add_blockref("b", (0, 0), {"row_count": 30000, "row_spacing": 1, "column_count": 30000, "column_spacing": 1}),
    ),
    "far": lambda _, m: m.add_line((0, 0), (1e30, 0)),
    "far spline": lambda _, m: m.add_open_spline([(0, 0), (1e30, 0), (0, 1e30), (5, 5), (3, 3)], degree=4),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_files_are_refused(name, tmp_path, monkeypatch):
    monkeypatch.setattr(dxf_side, "MOST_ENTITIES", 500)
    with pytest.raises(SourceError, match=r"^other\.dxf"):
        compare(file(tmp_path, HOSTILE[name]), drawing([]))


@pytest.mark.parametrize(
    "content",
    [
        b"not a dxf",
        b"EOF",
        b"0\nEOF\n",
        b"  0\nSECTION\n  2\nENTITIES\n",
        b"\0\1" * 50,
        b"AutoCAD Binary DXF\r\n\x1a\0EOF\0",
    ],
)
def test_what_is_no_dxf_is_refused_or_empty(content, tmp_path, capfd):
    path = tmp_path / "bad.dxf"
    path.write_bytes(content)
    try:
        assert not len(side_of(path, 0.1).pieces)
    except SourceError as error:
        assert "bad.dxf" in str(error) and "\n" not in str(error)
    assert capfd.readouterr() == ("", "")


def damaged(tmp_path, change):
    whole = drawing([line([[0, n], [10, n]]) for n in range(50)]).save(tmp_path / "a.dxf")
    (tmp_path / "bad.dxf").write_bytes(change(whole.read_bytes()))
    return tmp_path / "bad.dxf"


def test_a_file_that_was_cut_short_is_refused(tmp_path):
    with pytest.raises(SourceError, match=r"bad\.dxf is no DXF, or cut short"):
        side_of(damaged(tmp_path, lambda text: text[: len(text) * 2 // 3]), 0.1)


def test_a_damaged_file_is_read_as_far_as_can_be(tmp_path):
    side = side_of(damaged(tmp_path, lambda text: text.replace(b"AcDbLine\n10\n", b"AcDbLine\n1x\n", 1)), 0.1)
    assert 45 < len(side.pieces) <= 50 and side.about.left_out["damaged entries"] > 0


def test_the_layers_of_a_page_of_freecad_are_its_views():
    side = side_of(DATA / "trolley_assembly.dxf", 0.1)
    views = ("Front", "Top", "Iso", "AxleSetAlone", "LinkAlone", "LeavesOfChassis", "HiddenOnly")
    assert (side.about.views, side.about.foreign, set(side.pieces.visible.tolist())) == (views, True, {-1})
    length = side.pieces.lengths[side.pieces.view == 0].sum()
    assert length == pytest.approx(FRONT_MM, abs=0.5)


def test_a_large_file_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(dxf_side, "MOST_BYTES", 10)
    with pytest.raises(SourceError, match="too much for a DXF"):
        side_of(file(tmp_path, lambda *_: None), 0.1)
