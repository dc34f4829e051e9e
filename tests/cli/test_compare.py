"""`hlr compare`: exit codes as of diff, one line and a table, overlays that say what the colours mean."""

import json
from xml.etree import ElementTree

import pytest
import trimesh
from PIL import Image

from support.drawings import drawing, line
from support.fragments import fragment

SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture
def files(tmp_path):
    """a.svg, and b.svg in which one line is gone, one new, one moved, one hidden and one a seam."""
    kept = line([[0, 0], [80, 0]])
    before = [line([[0, y], [60, y]], edge=y) for y in (10, 20, 30, 40)]
    after = [line([[0, 20.2], [60, 20.2]]), line([[0, 30], [60, 30]], visible=False), line([[0, 40], [60, 40]], "seam")]
    drawing([kept, *before]).save(tmp_path / "a.svg")
    drawing([kept, *after, line([[0, 50], [12, 50]])]).save(tmp_path / "b.svg")


@pytest.mark.usefixtures("files")
def test_what_differs_is_told(hlr_real):
    result = hlr_real("compare", "a.svg", "b.svg")
    assert (result.code, result.err) == (1, "")
    first, _, heading, *rows = result.out.splitlines()
    assert first == "60 mm gone, 12 mm new, 60 mm moved, 60 mm class changed, 60 mm visibility changed"
    assert heading.split() == ["difference", "mm", "at", "x,", "y", "class", "part"]
    assert [" ".join(row.split()) for row in rows] == [
        "gone 60 30.00, 10.00 visible sharp part 0, edge 10",
        "new 12 6.00, 50.00 visible sharp part 0",
        "moved by 0.2 mm 60 30.00, 20.00 visible sharp part 0, edge 20",
        "class changed 60 30.00, 40.00 visible sharp, now seam part 0, edge 40",
        "visibility changed 60 30.00, 30.00 visible sharp, now hidden part 0, edge 30",
    ]


@pytest.mark.usefixtures("files")
def test_the_same_is_zero_and_quiet_says_nothing(hlr_real):
    assert hlr_real("compare", "a.svg", "a.svg") == (0, "same: 320 mm of lines\n", "")
    assert hlr_real("compare", "a.svg", "b.svg", "-q") == (1, "", "")


@pytest.mark.usefixtures("files")
def test_what_is_refused_is_two(hlr_real):
    for arguments in (("a.svg", "none.svg"), ("a.svg",), ("a.svg", "b.svg", "--tolerance", "-1"),
                      ("a.svg", "b.svg", "-o", "d.pdf"), ("a.svg", "b.svg", "-o", "a.svg")):  # fmt: skip
        result = hlr_real("compare", *arguments)
        assert (result.code, result.out, result.err.count("\n")) == (2, "", 1)


@pytest.mark.usefixtures("files")
def test_overlays_and_figures_are_written(hlr_real, tmp_path):
    outputs = [argument for name in ("d.svg", "d.png", "d.json") for argument in ("-o", name)]
    assert hlr_real("compare", "a.svg", "b.svg", *outputs).code == 1
    root = ElementTree.parse(tmp_path / "d.svg").getroot()
    text = [each.text for each in root.iter(f"{SVG}text")]
    for kind in ("gone", "new", "moved", "class changed", "visibility changed", "same"):
        assert any(each.startswith(f"{kind}, ") for each in text)
    assert {"gone", "new", "moved", "class-changed"} < {each.get("class") for each in root.iter(f"{SVG}path")}
    with Image.open(tmp_path / "d.png") as image:
        colors = {color for _, color in image.convert("RGB").getcolors(1 << 20)}
    assert {(214, 34, 34), (22, 96, 208), (224, 138, 0)} <= colors
    figures = json.loads((tmp_path / "d.json").read_text())
    assert figures["same"] is False and figures["mm"]["gone"] == 60.0 and len(figures["differences"]) == 5
    assert figures["differences"][0]["edge"] == 10


@pytest.mark.usefixtures("files")
def test_the_same_bytes_each_time(hlr_real, tmp_path):
    made = []
    for number in range(2):
        outputs = [argument for end in ("svg", "png", "json") for argument in ("-o", f"{number}.{end}")]
        hlr_real("compare", "a.svg", "b.svg", "--register", "translation", *outputs)
        made.append([(tmp_path / f"{number}.{end}").read_bytes() for end in ("svg", "png", "json")])
    assert made[0] == made[1]


@pytest.fixture
def model(tmp_path, hlr_real):
    """pair.glb, of which plate.svg shows one part, the plate, as it was when it was 4 mm wider."""
    for name, wide in (("old", 34), ("pair", 30)):
        made = trimesh.Scene()
        for part, size in (("plate", (wide, 4, 20)), ("bolt", (6, 30, 6))):
            made.add_geometry(trimesh.creation.box(size), geom_name=part, node_name=part)
        made.export(tmp_path / f"{name}.glb")
    for name in ("old", "pair"):
        asked = ("--view", "front", "--scale", "1", "--only", "plate")
        assert hlr_real("draw", f"{name}.glb", *asked, "-o", f"{name}.svg").code == 0


@pytest.mark.usefixtures("model")
def test_what_makes_it_fail(hlr_real, tmp_path):
    asked = ("compare", "old.svg", "pair.glb", "--only", "plate")
    for on, code in (("any", 1), ("ours", 0), ("never", 0)):
        result = hlr_real(*asked, "--fail-on", on, "-o", "d.json")
        assert (result.code, result.err) == (code, "")
        assert json.loads((tmp_path / "d.json").read_text())["model_side"] == "second"
        assert ("hlr's own drawing is nowhere found to be wrong\n" in result.out) == (on == "ours")
    assert hlr_real(*asked).code == 1
    # Nothing speaks for hlr's drawing where rays are not asked: the drawings have little in common.
    other = drawing([line([[0, y], [3 + 7 * y, 40 - y]]) for y in range(1, 20)])
    (tmp_path / "other.svg").write_text(fragment(other))
    result = hlr_real("compare", "other.svg", "pair.glb", "--view", "front", "--fail-on", "ours")
    assert result.code == 1 and "nothing of it was judged" in result.out


@pytest.mark.usefixtures("model")
def test_parts_are_chosen(hlr_real):
    asked = ("compare", "pair.svg", "pair.glb")
    assert [hlr_real(*asked, *more).code for more in ((), ("--only", "plate"), ("--hide", "bo*"))] == [1, 0, 0]
    for more in (("--only", "screw"), ("--param", "size=2"), ("--var", "a")):
        drawn = hlr_real("draw", "pair.glb", *more, "-o", "new.svg")
        assert hlr_real(*asked, *more) == drawn and drawn.code == 2
    assert hlr_real(*asked, "--param", "a=1", "--param", "a=2").err == "hlr: --param gives a twice: give it once.\n"


@pytest.mark.usefixtures("model")
def test_who_is_right_is_asked_of_one_model(hlr_real):
    for sides in (("old.svg", "pair.svg"), ("old.glb", "pair.glb")):
        result = hlr_real("compare", *sides, "--fail-on", "ours")
        assert (result.code, result.out) == (2, "")
        assert result.err.startswith("hlr: --fail-on ours finds out by a model which drawing is right: name one model")


@pytest.mark.usefixtures("model")
def test_what_is_for_other_models_has_no_effect(hlr_real):
    result = hlr_real("compare", "old.glb", "pair.glb", "--hidden-objects")
    assert result.err == (
        "hlr: note: --hidden-objects has no effect: it is for FreeCAD, and old.glb is a mesh and pair.glb is a mesh.\n"
    )
