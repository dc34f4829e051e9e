"""Messages spell options as they are typed, in Python as Python does, and in a manifest as its keys."""

from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path

import pytest

import hlr
from hlr.errors import respelled

BOX = Path(__file__).parents[1] / "data" / "freecad" / "box.step"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--see-through", "--report"], "a report measures what all parts hide: leave out --report, or --see-through."),
        (["--page", "A4", "--fit", "A3"], "--page and --fit both name a sheet, 'A4' and 'A3': give one of them."),
        (["--section", "front", "--perspective"], "leave out --perspective, or --section."),
        (["--only", "zz"], '--only "zz" matches no part: there are "box".'),
        (["--param", "a=1"], "--param names variables of a script, and box.step is no script: leave it out."),
        (["--up", "0,0,0"], "--up is zero: give a direction such as 1,-1,1."),
        (
            ["--hidden-color", "papier"],
            "--hidden-color needs a colour such as black, #1a2b3c or currentColor, not 'papier'.",
        ),
        (["--section", "front", "--fov", "40"], "a section has no perspective: leave out --fov, or --section."),
        (
            ["--arrange", "first-angle", "--text", "A=b"],
            "--text is for the fields of a template: give --template as well, or leave it out.",
        ),
        (["--arrange", "first-angle", "--fill"], "only a view by itself has fill: leave out --fill, or --arrange."),
    ],
)
def test_on_the_command_line(hlr_real, arguments, message):
    done = hlr_real("draw", BOX, *arguments, "-o", "a.svg")
    assert (done.code, done.out) == (2, "")
    assert done.err.endswith(f"{message}\n") and "`" not in done.err


def test_an_option_that_was_not_typed_is_named_as_it_would_be():
    from hlr.cli.commands.draw import draw
    from hlr.cli.without_effect import Asked

    asked = Asked(draw.make_context("draw", [str(BOX)]))
    names = [asked.as_typed(name) for name in ("parameters", "texts", "see_through", "perspective", "only_in_python")]
    assert names == ["--param", "--text", "--see-through", "--perspective", "--only-in-python"]


def test_a_source_without_a_name(hlr_real):
    for verb in ("draw", "preview", "info"):
        assert hlr_real(verb, "") == (2, "", "hlr: the name of the source is empty: name a model file.\n")


def test_in_python():
    with pytest.raises(hlr.OptionError, match="leave out `report`, or `see_through`"):
        hlr.draw(BOX, see_through=True, report=True)


def test_in_a_manifest(hlr_real):
    Path("box.step").write_bytes(BOX.read_bytes())
    Path("hlr.toml").write_text('files = ["*.step"]\nfit = "A3"\npage = "A4"\n')
    done = hlr_real("batch")
    assert done.code == 2
    assert "hlr.toml, line 3, page: page and fit both name a sheet" in done.err


def test_in_the_report_of_a_batch(hlr_real):
    Path("box.step").write_bytes(BOX.read_bytes())
    Path("hlr.toml").write_text('files = ["*.step"]\nonly = ["zz"]\n')
    done = hlr_real("batch", "--no-cache")
    assert done.code == 1
    assert 'only "zz" matches no part' in done.err and "`" not in done.err + Path("drawings/manifest.json").read_text()


def test_in_a_comparison(hlr_real):
    hlr.draw(BOX).save("a.svg")
    done = hlr_real("compare", "a.svg", "a.svg", "--param", "a=1", "--hidden-objects")
    assert done.code == 2
    assert "hlr: --param and --hidden-objects are for a model, and both sides are drawings: leave them out" in done.err


def test_only_whole_names_are_spelled_anew():
    assert respelled("`a_b` and `c`, not ` d` or `E`", str.upper) == "A_B and C, not ` d` or `E`"


def test_a_comparison_of_folders_names_the_command_for_it(hlr_real, tmp_path):
    (tmp_path / "old").mkdir()
    for sides in (("old", BOX), (BOX, "old"), ("old", "old")):
        done = hlr_real("compare", *sides)
        assert (done.code, done.out) == (2, "")
        assert done.err == (
            "hlr: old is a folder: name a file in it; to compare all drawings of a folder with new ones, draw their "
            "models with hlr batch MODELS --baseline FOLDER.\n"
        )


def test_a_text_in_memory_takes_the_result(tmp_path, monkeypatch):
    from hlr.cli import main

    monkeypatch.chdir(tmp_path)
    (tmp_path / "box.step").write_bytes(BOX.read_bytes())
    with redirect_stdout(StringIO()), pytest.raises(SystemExit) as left:
        main(["compare", "box.step", "box.step"])
    assert left.value.code == 0
