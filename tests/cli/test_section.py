"""`--section` and `--uncut`: which views are cut and where, and what is refused."""

import json
import re
from pathlib import Path

import pytest

from support.brep_shapes import bare_triangles

DATA = Path(__file__).parents[1] / "data"
STEP, HOUSING = DATA / "as1-oc-214.stp", DATA / "housing_body.FCStd"
BOX = DATA / "freecad" / "box.step"


@pytest.fixture
def draw(hlr_real):
    def run(source, *arguments):
        return hlr_real("draw", source, *arguments, "-q")

    return run


def test_a_section_through_the_middle(draw, tmp_path):
    assert draw(STEP, "--section", "front", "-o", "a.svg").code == 0
    svg = (tmp_path / "a.svg").read_text("utf-8")
    assert svg.count('<g class="hatch"') == 1
    assert '<g id="hidden"' not in svg
    assert ' section="90 75 38"' in svg
    assert draw(STEP, "--section", "front@middle", "-o", "b.svg").code == 0
    assert (tmp_path / "b.svg").read_text("utf-8") == svg


@pytest.mark.parametrize("plane", ["front@20", "FRONT@1,20,3", "0,-2,0@0,20,0"])
def test_a_section_at_a_place(draw, tmp_path, plane):
    assert draw(STEP, "--section", plane, "-o", "a.svg").code == 0
    svg = (tmp_path / "a.svg").read_text("utf-8")
    point = svg.partition(' section="')[2].partition('"')[0].split()
    assert float(point[1]) == 20.0


def test_views_beside_a_section_are_whole(draw, tmp_path):
    done = draw(STEP, "--view", "iso", "--view", "top", "--section", "top", "--section", "left", "-o", "{view}.svg")
    assert (done.code, done.err) == (0, "")
    hatched = {path.stem: "hatch" in path.read_text("utf-8") for path in tmp_path.glob("*.svg")}
    assert hatched == {"iso": False, "top": True, "left": True}


def test_parts_stay_whole(draw, tmp_path):
    assert draw(STEP, "--section", "front", "--uncut", "bolt*", "-o", "a.json").code == 0
    import hlr

    drawing = hlr.load(tmp_path / "a.json")
    cut = {drawing.parts[k].name.partition(":")[0] for k in drawing.section.parts}
    assert cut and not any("bolt" in name for name in cut)
    assert any("bolt" in part.name for part in drawing.parts)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--section", "frnt"], "'frnt' is no view: did you mean front?"),
        (["--section", "front@"], "'front@' names no plane: give front, front@12.5 in millimetres, or front@0,12.5,0"),
        (["--section", "front@a"], "'front@a' names no plane"),
        (["--section", "front@1,2"], "'front@1,2' names no plane"),
        (["--section", "front@1,2:"], "'front@1,2:' names no plane"),
        (["--section", "front@1:2"], "'front@1:2' names no plane"),
        (["--section", "front@1,2:3:4"], "or, where it steps, front@12.5,30:40"),
        (["--section", "front@20,200:30"], "section front steps at x = 200, beside the model: as1-oc-214.stp reaches"),
        (["--section", "front@20,9:30,4:8"], "section steps from 9 on, then from 4 on: give its steps in ascending or"),
        (
            ["--section", "front@3", "--section", "front@3"],
            "--section front@3 is asked for twice: give each plane once",
        ),
        (
            ["--section", "front", "--section", "front@middle"],
            "--section front is asked for twice: give each plane once",
        ),
        (["--section", "front", "--section", "front@3"], "2 views cannot share the one file a.svg; put {view} into"),
        (["--section", "front@900"], "section front at y = 900 misses the model: as1-oc-214.stp reaches from 0 to 150"),
        (["--section", "iso@9"], "section iso at 9: the view looks along no axis, so give a point on its plane"),
        (["--section", "front", "--perspective"], "a section has no perspective: leave out --perspective, or"),
        (["--section", "front", "--eye", "1,2,3"], "a section is seen in parallel projection: leave out --eye, or"),
        (["--section", "front", "--report"], "a section has no report: leave out --report, or --section"),
        (["--section", "front", "--uncut", "blot"], '--uncut "blot" matches no part: perhaps "bolt"'),
        (["--uncut", "bolt"], "--uncut is for --section: leave it out, or say what is cut"),
        (["--whole", "left"], "--whole is for --section: leave it out, or say what is cut"),
        (["--section", "front", "--whole", "left"], "--whole left is none of the sections, front: leave it out"),
        (["--section", "front", "--whole", "lft"], "'lft' is no view: did you mean left?"),
        (["--section", "front", "--whole", "front"], "2 views cannot share the one file a.svg"),
    ],
)
def test_what_cannot_be_cut_is_refused_in_one_sentence(draw, tmp_path, arguments, message):
    done = draw(STEP, *arguments, "-o", "a.svg")
    assert done.code == 2
    assert message in done.err
    assert done.err.count("\n") == 1
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("plane", ["front@-5,0:7.5", "FRONT@-5,0:7.5", "0,-1,0@-5,0:7.5"])
def test_a_plane_may_step(draw, tmp_path, plane):
    assert draw(BOX, "--section", plane, "-o", "a.svg").code == 0
    svg = (tmp_path / "a.svg").read_text("utf-8")
    corners = svg.partition(' section-corners="')[2].partition('"')[0].split()
    assert [float(corner) for corner in (*corners[:2], *corners[3:5])] == [0.0, -5.0, 0.0, 7.5]


@pytest.mark.parametrize(
    ("views", "shown"),
    [
        ([], ["front", "top", "left", "iso", "right"]),
        (["--view", "front", "--view", "iso"], ["front", "iso", "right"]),
    ],
)
def test_sections_on_one_page(draw, tmp_path, views, shown):
    asked = ["--arrange", "first-angle", *views, "--section", "front@60", "--section", "right"]
    done = draw(STEP, *asked, "-o", "a.svg")
    assert (done.code, done.err) == (0, "")
    svg = (tmp_path / "a.svg").read_text("utf-8")
    assert re.findall(r'<view name="(\w+)"', svg) == shown
    assert re.findall(r">([^<>]+)</text>", svg) == ["A", "A", "A-A", "B", "B", "B-B"]


def test_several_sections_of_one_view_on_one_page(draw, tmp_path):
    asked = ["--section", "left@60", "--section", "top@10", "--section", "left@180"]
    done = draw(STEP, "--arrange", "first-angle", *asked, "-o", "a.svg")
    assert (done.code, done.err) == (0, "")
    svg = (tmp_path / "a.svg").read_text("utf-8")
    assert re.findall(r'<view name="([\w-]+)".* section="(.*)"', svg) == [
        ("top", "B-B"), ("left", "A-A"), ("left-C", "C-C")
    ]  # fmt: skip


def test_several_sections_of_one_view_are_files_with_names_of_their_own(draw, tmp_path):
    asked = ["--view", "iso", "--section", "left@60", "--section", "top@10", "--section", "left@180", "--same-scale"]
    done = draw(STEP, *asked, "-o", "{n}-{view}.svg", "--json")
    assert (done.code, done.err) == (0, "")
    names = {path.stem: path.read_text("utf-8") for path in tmp_path.iterdir()}
    assert sorted(names) == ["1-iso", "2-left", "3-left-C", "4-top"]
    points = [re.findall(r' section="(\S+) ', svg) for svg in (names["2-left"], names["3-left-C"], names["1-iso"])]
    assert points == [["60"], ["180"], []]
    assert [each["view"] for each in json.loads(done.out)["drawings"]] == ["iso", "left", "left-C", "top"]


@pytest.mark.parametrize(
    ("asked", "drawn"),
    [
        (["--section", "front"], []),
        (["--section", "front@20", "--section", "front@60"], ["front", "front-B"]),
        (["--section", "front@20", "--whole", "front"], ["front", "front-A"]),
    ],
)
def test_one_scale_for_all_is_told_off_where_there_is_one_drawing(hlr_real, asked, drawn):
    done = hlr_real("plan", STEP, *asked, "--same-scale")
    assert ("--same-scale has no effect: there is one view" in done.err) is (not drawn)
    assert not drawn or re.findall(r"^front.*$", done.out, re.M) == drawn


def test_a_view_may_be_drawn_whole_besides_its_sections(draw, tmp_path):
    asked = ["--section", "left@60", "--section", "left@180", "--whole", "left"]
    done = draw(STEP, "--arrange", "first-angle", *asked, "-o", "page.svg")
    assert (done.code, done.err) == (0, "")
    svg = (tmp_path / "page.svg").read_text("utf-8")
    assert re.findall(r'<view name="([\w-]+)"', svg) == [
        "front", "top", "left", "left-A", "left-B", "iso"
    ]  # fmt: skip
    done = draw(STEP, *asked, "-o", "{n}-{view}.svg")
    assert (done.code, done.err) == (0, "")
    assert sorted(path.stem for path in tmp_path.glob("*-*.svg")) == ["1-left", "2-left-A", "3-left-B"]
    assert [" section=" in path.read_text("utf-8") for path in sorted(tmp_path.glob("*-*.svg"))] == [False, True, True]


def test_pages_of_documents_have_their_own_sections(draw):
    done = draw(HOUSING, "--page", "Page", "--section", "front")
    assert done.code == 2
    assert "a page of a document is drawn as it is: leave out --section" in done.err
    assert draw(HOUSING, "--section", "front", "-o", "a.svg").code == 0


@pytest.mark.parametrize(
    ("views", "noted"),
    [
        ([], True),
        (["--view", "front"], True),
        (["--view", "top"], False),
        (["--hidden"], False),
        (["--whole", "front"], False),
    ],
)
def test_the_colour_of_hidden_lines_has_no_effect_where_all_views_are_cut(hlr_real, views, noted):
    done = hlr_real("draw", BOX, "--section", "front", *views, "--hidden-color", "gray", "-o", "{view}.svg")
    note = "hlr: note: --hidden-color has no effect: sections have no hidden lines, unless --hidden asks for them."
    assert (note in done.err) is noted


def test_a_part_that_cannot_be_cut_is_drawn_whole_with_a_warning(hlr_real, tmp_path):
    import cadquery as cq
    from OCP.BRepTools import BRepTools

    from hlr.source.cad.shapes import make_compound

    solid, bare = (cq.Workplane().box(10, 10, 10).translate((x, 0, 0)).val().wrapped for x in (0, 20))
    for name, shapes in (("some", [solid, bare_triangles(bare)]), ("none", [bare_triangles(bare)])):
        BRepTools.Write_s(make_compound(shapes), str(tmp_path / f"{name}.brep"))
    done = hlr_real("draw", tmp_path / "some.brep", "--section", "front", "-o", "a.svg")
    assert done.code == 0
    assert (
        'hlr: warning: section front: "some:loose" stays whole, because its faces are triangles without surfaces: '
        "export it as a solid or as a mesh, or name it in uncut.\n" in done.err
    )
    strict = hlr_real("draw", tmp_path / "some.brep", "--section", "front", "-o", "b.svg", "--strict")
    assert strict.code == 2 and "nothing is written, because of --strict" in strict.err
    refused = hlr_real("draw", tmp_path / "none.brep", "--section", "front", "-o", "b.svg")
    assert refused.code == 2 and refused.err.count("\n") == 1
    assert '"none" cannot be cut by the plane of a section, because its faces are triangles' in refused.err
    assert not (tmp_path / "b.svg").exists()


def test_a_plane_that_only_touches_is_told(hlr_real):
    done = hlr_real("draw", BOX, "--section", "front@-20", "-o", "a.svg")
    assert done.code == 0
    assert "hlr: note: the plane of section front only touches the model: nothing is taken away." in done.err


def test_nothing_of_it_is_loaded_where_no_section_is_asked_for(tmp_path):
    import subprocess
    import sys

    program = (
        "import sys, hlr; hlr.draw(([(0, 0, 0), (30, 0, 0), (0, 20, 0)], [(0, 1, 2)])).save('a.svg'); "
        "print(*(name for name in sys.modules if '.section' in name or 'hatch' in name or 'half_space' in name))"
    )
    done = subprocess.run(
        [sys.executable, "-P", "-c", program], capture_output=True, text=True, check=True, cwd=tmp_path
    )
    assert done.stdout.split() == ["hlr.drawing.section"]
