"""The command line on real models, through the whole pipeline."""

import json
import os
import re
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pypdfium2
import pytest

BOX = """OFF
8 12 0
0 0 0
40 0 0
40 30 0
0 30 0
0 0 20
40 0 20
40 30 20
0 30 20
3 0 2 1
3 0 3 2
3 4 5 6
3 4 6 7
3 0 1 5
3 0 5 4
3 1 2 6
3 1 6 5
3 2 3 7
3 2 7 6
3 3 0 4
3 3 4 7
"""

SCRIPT = """
import cadquery as cq
print("a word from the script")
result = cq.Workplane().box(40, 30, 20).faces(">Z").workplane().hole(10)
"""

# The names of all loaded modules go to standard error when the command has ended.
COMMAND = "import atexit, sys; atexit.register(lambda: print('LOADED', *sys.modules, file=sys.stderr)); "
COMMAND += "from hlr.cli import main; main()"


@pytest.fixture
def run(hlr_real, tmp_path):
    """In this process: standard output and error."""
    (tmp_path / "box.off").write_text(BOX)
    (tmp_path / "plate.py").write_text(SCRIPT)

    def go(*arguments, code=0):
        result = hlr_real(*arguments)
        assert result.code == code, result.err
        return result.out, result.err

    return go


def fresh(folder, *arguments):
    """In a process of its own: standard error, and the top-level modules that were loaded."""
    command = [sys.executable, "-P", "-c", COMMAND, *arguments]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True)
    err, _, loaded = done.stderr.partition("LOADED")
    return err, {name.partition(".")[0] for name in loaded.split()}


def read(tmp_path, name):
    return json.loads((tmp_path / name).read_text())


def test_the_front_view_of_a_box_is_four_lines(run, tmp_path):
    run("draw", "box.off", "-o", "box.json", "--view", "front", "--scale", "1:1")
    lines = read(tmp_path, "box.json")["lines"]
    assert sorted(line["visible"] for line in lines) == [True] * len(lines)
    length = sum(
        abs(a[0] - b[0]) + abs(a[1] - b[1])
        for line in lines
        for a, b in zip(line["points"], line["points"][1:], strict=False)
    )
    assert length == pytest.approx(2 * (40 + 20), abs=0.01)


def test_the_isometric_view_of_a_box_hides_three_edges(run, tmp_path):
    run("draw", "box.off", "-o", "box.json", "--scale", "1:2", "--hidden")
    drawn = read(tmp_path, "box.json")
    hidden = [line for line in drawn["lines"] if not line["visible"]]
    assert len(hidden) == 3
    assert all([0, 30, 0] in line["points3"] for line in hidden)
    assert drawn["scale"] == 0.5
    run("draw", "box.off", "-o", "box.json", "--no-hidden")
    assert all(line["visible"] for line in read(tmp_path, "box.json")["lines"])


def test_json_holds_the_filled_faces(run, tmp_path):
    run("draw", "box.off", "-o", "box.json", "--fill")
    assert len(read(tmp_path, "box.json")["fill"]["part"]) == 3


def test_points_on_paper_are_the_projected_model_points(run, tmp_path):
    run("draw", "box.off", "-o", "box.json", "--view", "-1,2,.5", "--scale", "2")
    drawn = read(tmp_path, "box.json")
    right, up, origin = drawn["view"]["right"], drawn["view"]["up"], drawn["origin"]
    for line in drawn["lines"]:
        for paper, point in zip(line["points"], line["points3"], strict=True):
            for axis, got, shift in zip((right, up), paper, origin, strict=True):
                assert got == pytest.approx(2 * sum(a * b for a, b in zip(axis, point, strict=True)) - shift, abs=1e-3)


@pytest.mark.slow
def test_a_mesh_never_loads_the_cad_kernel(tmp_path):
    (tmp_path / "box.off").write_text(BOX)
    err, loaded = fresh(tmp_path, "draw", "box.off", "-o", "box.svg")
    assert err == ""
    assert "numpy" in loaded
    assert loaded & {"trimesh", "scipy", "networkx", "OCP", "cadquery", "build123d", "rich", "pydyf"} == set()


@pytest.mark.parametrize("ending", ["stl", "obj", "ply", "off", "glb", "3mf"])
def test_mesh_files(run, tmp_path, ending):
    import trimesh

    trimesh.creation.box().export(tmp_path / f"cube.{ending}")
    run("draw", f"cube.{ending}", "-o", "cube.json", "--view", "top")
    (box,) = {tuple(part["name"] for part in read(tmp_path, "cube.json")["parts"])}
    assert len(box) == 1
    assert json.loads(run("info", f"cube.{ending}", "--json")[0])["parts"][0]["triangles"] == 12


def test_text_that_is_not_utf_8(run, tmp_path):
    mesh = "# Größe\no Gehäuse\nv 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
    (tmp_path / "latin.obj").write_bytes(mesh.encode("latin-1"))
    assert run("draw", "latin.obj", "-o", "-")[0].startswith("<?xml")


def test_several_views_in_several_formats(run, tmp_path):
    for ending in ("svg", "pdf", "json"):
        views = ("--view", "top", "--view", "1,2,3")
        run("draw", "box.off", "-o", "{stem}-{view}." + ending, *views, "--scale", "1")
    assert len(list(tmp_path.glob("box-*"))) == 6
    size = pypdfium2.PdfDocument(tmp_path / "box-top.pdf")[0].get_size()
    assert size == pytest.approx((51 * 72 / 25.4, 41 * 72 / 25.4), abs=0.1)
    assert 'width="51mm" height="41mm"' in (tmp_path / "box-top.svg").read_text()


@pytest.mark.slow
@pytest.mark.skipif(find_spec("cadquery") is None, reason="the script is one of CadQuery")
def test_the_same_bytes_from_run_to_run_and_for_any_number_of_threads(run, tmp_path):
    for ending in ("svg", "pdf"):
        run("draw", "plate.py", "-o", f"1.{ending}", "--threads", "1")
        run("draw", "plate.py", "-o", f"2.{ending}", "--threads", "2")
        fresh(tmp_path, "draw", "plate.py", "-o", f"3.{ending}")
        assert len({(tmp_path / f"{name}.{ending}").read_bytes() for name in "123"}) == 1


@pytest.mark.skipif(find_spec("cadquery") is None, reason="the script is one of CadQuery")
def test_a_script_is_drawn_and_what_it_prints_stays_out(run):
    out, err = run("draw", "plate.py", "-o", "-")
    assert out.startswith("<?xml")
    assert out.endswith("</svg>\n")
    assert "a word from the script" in err
    assert 'class="outline"' in out or 'class="sharp"' in out
    assert re.search(r'<g data-part="0">\n<path d="M[^"]*" data-edge="\d+"', out)


def test_perspective(run, tmp_path):
    run("draw", "box.off", "-o", "box.json", "--eye", "100,-100,80", "--target", "20,15,10", "--fov", "40")
    view = read(tmp_path, "box.json")["view"]
    assert view["projection"] == "perspective"
    assert (view["eye"], view["target"], view["fov"]) == ([100, -100, 80], [20, 15, 10], 40)


def test_info(run):
    out, err = run("info", "box.off")
    assert err == ""
    assert "40 x 30 x 20 mm" in out
    (part,) = json.loads(run("info", "box.off", "--json")[0])["parts"]
    assert (part["triangles"], part["closed"], part["oriented"], part["defects"]) == (12, True, True, [])


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("missing.step", None),
        ("empty.step", b""),
        ("broken.stp", b"ISO-10303-21;\nHEADER;\nnonsense"),
        ("broken.igs", b"nonsense"),
        ("broken.brep", b"nonsense"),
        ("broken.stl", b"nonsense"),
        ("broken.obj", b"nonsense"),
        ("broken.ply", b"ply\nnonsense"),
        ("broken.off", b"OFF\n3 1 0\n0 0"),
        ("broken.3mf", b"nonsense"),
        ("broken.glb", b"nonsense"),
        ("broken.py", b"1 / 0"),
        ("nothing.py", b"x = 1"),
        ("drawing.dwg", b"nonsense"),
    ],
)
@pytest.mark.parametrize("verb", ["draw", "info"])
def test_what_cannot_be_read_is_refused_in_one_sentence(run, tmp_path, verb, name, content):
    if content is not None:
        (tmp_path / name).write_bytes(content)
    before = set(os.listdir(tmp_path))
    out, err = run(verb, name, code=2)
    assert out == ""
    assert err.startswith("hlr: ")
    assert name in err
    assert err.count("\n") == 1
    assert set(os.listdir(tmp_path)) - {"__pycache__"} == before


def test_views_that_contradict_are_refused(run, tmp_path):
    _, err = run("draw", "box.off", "--view", "0,0,0", code=2)
    assert err.startswith("hlr: ")
    _, err = run("draw", "box.off", "--view", "top", "--up", "0,0,1", code=2)
    assert err.startswith("hlr: ")
    assert not list(Path(tmp_path).glob("*.svg"))


def test_strict(run, tmp_path):
    degenerate = BOX.replace("8 12 0", "8 13 0") + "3 1 1 2\n"
    (tmp_path / "bad.off").write_text(degenerate)
    _, err = run("draw", "bad.off", "-o", "bad.svg")
    assert err.startswith("hlr: warning: ")
    _, err = run("draw", "bad.off", "-o", "strict.svg", "--strict", code=2)
    assert err.startswith("hlr: ")
    assert err.count("\n") == 1
    assert (tmp_path / "bad.svg").exists()
    assert not (tmp_path / "strict.svg").exists()


@pytest.mark.slow
def test_as_a_module(run, tmp_path):
    run("draw", "box.off", "-o", "one.svg")
    command = [sys.executable, "-P", "-m", "hlr", "draw", "box.off", "-o", "two.svg"]
    subprocess.run(command, cwd=tmp_path, check=True)
    assert (tmp_path / "one.svg").read_bytes() == (tmp_path / "two.svg").read_bytes()
