"""Options that cannot change anything: a note says so, or a sentence refuses what is for another use of the verb."""

from pathlib import Path

import click
import pytest

from hlr.cli.app import VERBS, command
from hlr.cli.without_effect import ROWS

SEEDS = Path(__file__).resolve().parents[1] / "fuzz/corpus/seeds"
MESH, STEP = SEEDS / "box.off", SEEDS / "block.step"


def told(done):
    """The notes of a command that has done its work, without what each begins and ends with."""
    assert done.code == 0, done.err
    return [line.removeprefix("hlr: note: ").removesuffix(".") for line in done.err.splitlines()]


@pytest.mark.parametrize(
    ("source", "option", "note"),
    [
        ("a.step", "--circles", "has no effect but on shapes that are made of triangles alone: it is for meshes, and "
         "a.step is a STEP file"),
        ("a.FCStd", "--crease=30", "has no effect but on shapes that are made of triangles alone: it is for meshes, "
         "and a.FCStd is a FreeCAD file"),
        ("a.step", "--hidden-objects", "has no effect: it is for FreeCAD, and a.step is a STEP file"),
        ("a.py", "--annotations", "has no effect: it is for STEP, and a.py is a script"),
        ("a.stl", "--no-smooth", "has no effect: it is for CAD models, and a.stl is a mesh"),
        ("a.stl", "--seam", "has no effect: it is for CAD models, and a.stl is a mesh"),
        ("a.stl", "--no-cache", "has no effect: it is for STEP, IGES, BREP and FreeCAD, and a.stl is a mesh"),
    ],
)  # fmt: skip
def test_an_option_for_other_sources_is_noted(hlr_command, source, option, note):
    name = option.partition("=")[0]
    assert told(hlr_command("draw", source, option)) == [f"{name} {note}"]
    assert hlr_command("draw", source, option, "-q").err == ""


@pytest.mark.parametrize(
    ("source", "options"),
    [
        ("a.stl", ["--circles", "--crease", "20"]),
        ("a.step", ["--annotations", "--no-cache", "--seam", "--smooth"]),
        ("a.FCStd", ["--hidden-objects"]),
    ],
)
def test_an_option_for_such_sources_is_not_noted(hlr_command, source, options):
    assert told(hlr_command("draw", source, *options)) == []
    assert told(hlr_command("draw", source)) == []


def test_an_option_for_other_formats_is_noted(hlr_command):
    def notes(*arguments):
        return told(hlr_command("draw", "a.step", *arguments))

    assert notes("--dpi", "300") == ["--dpi has no effect: it is for PNG, and what is written is SVG"]
    assert notes("--size", "9x9", "-o", "a.svg", "-o", "out/", "--format", "pdf") == [
        "--size has no effect: it is for PNG, and what is written is SVG and PDF"
    ]
    assert notes("--layers", "part", "-o", "a.png") == [
        "--layers has no effect: it is for SVG, PDF, DXF and JSON, and what is written is PNG"
    ]
    assert notes("--background", "red", "-o", "a.dxf") == [
        "--background has no effect: it is for SVG, PDF, PNG and JSON, and what is written is DXF"
    ]
    # Colours of parts keep away from the background, in a DXF as well.
    assert notes("--background", "red", "-o", "a.dxf", "--part-colors", "lines") == []
    # One of several files is enough, and JSON holds the whole style.
    assert notes("--dpi", "300", "-o", "a.svg", "-o", "a.png") == notes("--dpi", "300", "-o", "a.json") == []
    assert notes("--layers", "part", "--background", "red") == notes("--dpi", "300", "--format", "png") == []


def test_a_colour_of_hidden_lines_that_are_not_drawn_is_noted(hlr_command):
    def notes(*arguments):
        return told(hlr_command("draw", "a.step", "--hidden-color", "red", "-o", "{n}.svg", *arguments))

    pictorial = ["--hidden-color has no effect: pictorial views have no hidden lines, unless --hidden asks for them"]
    assert notes() == notes("--view", "1,1,0") == notes("--view", "top", "--perspective") == pictorial
    assert notes("--view", "top", "--no-hidden") == [
        "--hidden-color has no effect: --no-hidden leaves the hidden lines out"
    ]
    cut = ("--section", "front@0.5")
    assert (
        notes(*cut)
        == notes(*cut, "--view", "front")
        == ["--hidden-color has no effect: sections have no hidden lines, unless --hidden asks for them"]
    )
    assert notes(*cut, "--view", "iso") == pictorial
    assert notes(*cut, "--view", "top") == notes(*cut, "--hidden") == []
    assert notes("--hidden") == notes("--view", "iso", "--view", "top") == notes("--view", "0,0,1") == []


def test_a_view_that_is_drawn_whole_besides_its_section_has_hidden_lines(hlr_real):
    asked = ("draw", STEP, "-o", "{view}.svg", "--hidden-color", "red", "--section", "front", "--whole", "front")
    assert told(hlr_real(*asked)) == told(hlr_real(*asked, "--view", "iso")) == []


def test_what_a_plan_and_a_preview_do_without_is_noted(hlr_real):
    plan = hlr_real("plan", MESH, "--strict")
    assert told(plan) == ["--strict has no effect: a plan writes nothing, and has no warnings"]
    small = ("preview", STEP, "-o", "a.png", "--size", "20x20")
    assert told(hlr_real(*small, "--smooth")) == [
        "--smooth has no effect: the picture has no lines, unless --edges asks for them"
    ]
    assert told(hlr_real(*small, "--edges", "--no-antialias", "--look", "wireframe")) == [
        "--edges has no effect: a wireframe look has lines without it",
        "--no-antialias has no effect: a wireframe look has no faces, and lines are always smoothed",
    ]
    assert told(hlr_real(*small, "--smooth", "--edges")) == told(hlr_real(*small, "--no-smooth", "--look=wireframe"))
    # Two reasons are told as one.
    assert len(told(hlr_real("preview", MESH, *small[2:], "--smooth"))) == 1


def test_dry_runs_say_what_is_for_drawing_alone(hlr_real, tmp_path):
    (tmp_path / "a.off").write_bytes(MESH.read_bytes())
    assert told(hlr_real("batch", "--dry-run", "-j", "2", "--strict")) == [
        "--jobs has no effect: --dry-run draws nothing"
    ]
    assert told(hlr_real("batch", "--list", "-j", "2", "--strict")) == [
        "--jobs has no effect: --list draws nothing",
        "--strict has no effect: --list draws nothing",
    ]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["methods", "--view", "top"], "--view is for a model: name one, or leave it out"),
        (["batch", "--init", "--time-limit", "9"],
         "--time-limit is for a batch, and --init draws none: leave it out"),
        (["compare", "a.svg", "b.svg", "--coarse"], "--coarse is for --against: leave it out"),
        (["batch", "--init", "--view", "top"], "--view is for a batch, and --init draws none: leave it out"),
        (["batch", "--init", "--list"], "--list and --init contradict one another: give one of them"),
        (["batch", "--watch", "--fail-on-change", "--baseline", "."],
         "--fail-on-change has no use with --watch, which has no exit code"),
    ],
)  # fmt: skip
def test_options_for_another_use_are_refused(hlr_real, tmp_path, arguments, message):
    assert hlr_real(*arguments) == (2, "", f"hlr: {message}.\n")
    assert list(tmp_path.iterdir()) == []


def test_an_error_stays_one_sentence(hlr_command):
    assert hlr_command("draw", "a.step", "--circles", "-o", "none/a.svg").err.count("\n") == 1


def test_the_table_names_options_that_there_are():
    context = click.Context(command)
    verbs = {name: {each.name for each in command.get_command(context, name).params} for name in VERBS}
    for row in ROWS:
        known = verbs[row.verb] if row.verb else set().union(*verbs.values())
        assert set(row.options) <= known, row
