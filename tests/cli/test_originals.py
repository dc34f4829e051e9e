"""No output destroys the model, however it is spelled or linked, nor a file that belongs to it."""

import os
import re

import pytest
import trimesh

from hlr.cli.app import VERBS, command
from hlr.cli.outputs import READ

BOX = trimesh.creation.box((10, 20, 30))
SCRIPT = "import cadquery as cq\nresult = cq.Workplane().box(1, 2, 3)\n"


@pytest.fixture
def refused(hlr_real, tmp_path):
    """Run a command that must be refused and leave everything as it was."""
    (tmp_path / "a.stl").write_bytes(BOX.export(file_type="stl"))
    (tmp_path / "b.py").write_text(SCRIPT)
    (tmp_path / "sub").mkdir()

    def run(*arguments, words="would"):
        before = {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()}
        result = hlr_real(*arguments)
        assert (result.code, result.out) == (2, "")
        assert "cannot write" in result.err and words in result.err
        assert result.err.count("\n") == 1
        assert {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()} == before

    return run


@pytest.mark.parametrize("source", ["a.stl", "b.py"])
@pytest.mark.parametrize("kind", ["svg", "pdf", "json"])
def test_the_source_itself(refused, source, kind):
    refused("draw", source, "-o", source, "--format", kind)


@pytest.mark.parametrize("output", ["./a.stl", "sub/../a.stl", "{stem}.stl", "../{folder}/a.stl", "ABSOLUTE"])
def test_other_spellings(refused, tmp_path, output):
    output = str(tmp_path / "a.stl") if output == "ABSOLUTE" else output.replace("{folder}", tmp_path.name)
    refused("draw", "a.stl", "-o", output, "--format", "svg")


@pytest.mark.parametrize("link", [os.symlink, os.link])
@pytest.mark.parametrize("verb", ["draw", "preview", "depth", "ids", "methods", "study"])
def test_links(refused, tmp_path, link, verb):
    def linked(name):
        link(tmp_path / "a.stl", tmp_path / name)
        return str(tmp_path / name)

    if verb == "draw":
        refused("draw", "a.stl", "-o", linked("x.svg"))
        refused("draw", "a.stl", "-o", "y.svg", "-o", linked("x.pdf"))
    elif verb == "preview":
        refused("preview", "a.stl", "-o", linked("x.png"))
    elif verb in ("depth", "ids"):
        refused("preview", "a.stl", "-o", "y.png", f"--{verb}", linked("x.png"))
    else:
        linked(f"sub/{verb}.csv")
        refused(verb, "a.stl", "-o", "sub")


def test_a_link_to_the_source_as_source(refused, tmp_path):
    (tmp_path / "c.stl").symlink_to(tmp_path / "a.stl")
    refused("draw", "c.stl", "-o", "a.stl", "--format", "svg")
    (tmp_path / "c.svg").symlink_to(tmp_path / "a.stl")
    refused("draw", "c.stl", "-o", "{stem}.svg")


def test_another_model(refused, tmp_path):
    refused("draw", "a.stl", "-o", "b.py", "--format", "svg", words="it is a model")
    (tmp_path / "b.svg").symlink_to(tmp_path / "b.py")
    refused("draw", "a.stl", "-o", "b.svg", words="it is a model")


def test_materials_and_textures(refused, tmp_path):
    (tmp_path / "m.obj").write_text("mtllib my paint.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (tmp_path / "my paint.mtl").write_text("newmtl a\nmap_Kd -s 1 1 1 sub\\wood.png\n")
    (tmp_path / "sub/wood.png").write_bytes(b"wood")
    (tmp_path / "paint.svg").symlink_to(tmp_path / "my paint.mtl")
    refused("draw", "m.obj", "-o", "my paint.mtl", "--format", "svg")
    refused("draw", "m.obj", "-o", "paint.svg")
    refused("preview", "m.obj", "-o", "sub/wood.png")
    refused("preview", "m.obj", "-o", "x.png", "--ids", "sub/wood.png")


def test_the_template_of_a_page(refused, tmp_path):
    (tmp_path / "sheet.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg" width="297mm" height="210mm"/>')
    page = ("draw", "a.stl", "--arrange", "first-angle", "--template", "sheet.svg")
    refused(*page, "-o", "sub/../sheet.svg", words="it is the template, and would be destroyed")
    (tmp_path / "b.svg").symlink_to(tmp_path / "sheet.svg")
    refused(*page, "-o", "b.svg", words="it is the template, and would be destroyed")


STYLED = ("draw", "a.stl", "--style", "my.toml")


@pytest.mark.parametrize("more", [(), ("--arrange", "first-angle"), ("--within", "1s")])
def test_the_style(refused, tmp_path, more):
    (tmp_path / "my.toml").write_text("wide = 1.0\n")
    refused(
        *STYLED, *more, "-o", "my.toml", "--format", "svg", words="my.toml: it is the style, and would be destroyed"
    )
    refused(*STYLED, *more, "-o", "sub/../my.toml", "--format", "pdf", words="it is the style, and would be destroyed")
    (tmp_path / "b.svg").symlink_to(tmp_path / "my.toml")
    refused(*STYLED, *more, "-o", "b.svg", words="it is the style, and would be destroyed")


def test_a_style_by_name_is_no_file(hlr_real, tmp_path):
    (tmp_path / "a.stl").write_bytes(BOX.export(file_type="stl"))
    (tmp_path / "thin").write_text("an earlier drawing")
    assert hlr_real("draw", "a.stl", "--style", "thin", "-o", "thin", "--format", "svg").code == 0
    assert (tmp_path / "thin").read_text().startswith("<?xml")


@pytest.mark.parametrize("side", ["a.svg", "b.svg"])
def test_either_side_of_a_comparison(refused, hlr_real, tmp_path, side):
    (tmp_path / "c.stl").write_bytes(BOX.export(file_type="stl"))
    for name in ("a.svg", "b.svg"):
        assert hlr_real("draw", "c.stl", "-o", name).code == 0
    refused("compare", "a.svg", "b.svg", "-o", "x.json", "-o", side, words="it is the source, and would be destroyed")


def test_all_that_a_command_reads_is_in_one_table():
    """An option that names a file is known as one that is read, or as one that is written."""
    commands = {name: command.get_command(None, name) for name in VERBS}
    files = {
        parameter.name
        for each in commands.values()
        for parameter in each.params
        if parameter.param_type_name == "argument" or re.search("FILE|FOLDER|DIR|PATH", parameter.metavar or "")
    }
    of_batches = {"sources", "baseline"}
    assert files == {*READ, *of_batches, "output", "outputs", "depth", "ids"}


def test_in_python(tmp_path):
    import hlr

    (tmp_path / "b.py").write_text(SCRIPT)
    (tmp_path / "b.svg").symlink_to(tmp_path / "b.py")
    with pytest.raises(hlr.WriteError, match="it is a model"):
        hlr.draw(BOX).save(tmp_path / "b.svg")
    assert (tmp_path / "b.py").read_text() == SCRIPT
