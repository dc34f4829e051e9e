import json

import pytest

from support import fake_pipeline as fake


def options(command, *arguments):
    result = command("draw", "a.step", *arguments)
    assert (result.code, result.err) == (0, "")
    return fake.ASKED[-1][2]


def views(command, *arguments):
    assert command("draw", "a.step", *arguments).code == 0
    return fake.ASKED[-1][1]


def test_transparent_parts_are_seen_through_on_request(hlr_command):
    assert options(hlr_command, "--see-through").see_through and not options(hlr_command).see_through


def test_draws_a_file_and_says_nothing(hlr_command, tmp_path):
    result = hlr_command("draw", "a.step", "-o", "out.svg")
    assert result == (0, "", "")
    assert (tmp_path / "out.svg").read_bytes().startswith(b"<?xml")
    assert fake.ASKED[-1][:2] == ("a.step", ["iso"])


def test_without_a_name_the_file_is_named_after_the_source(hlr_command, tmp_path):
    assert hlr_command("draw", "models/a.b.step").code == 0
    assert hlr_command("draw", "a.step", "--format", "pdf", "--view", "top", "--view", "1,0,0").code == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a-1_0_0.pdf", "a-top.pdf", "a.b.svg"]


@pytest.mark.parametrize("name", ["a.svg", "a.pdf", "a.json"])
def test_the_ending_chooses_the_format(hlr_command, tmp_path, name):
    assert hlr_command("draw", "a.step", "-o", name).code == 0
    assert (tmp_path / name).read_bytes()[:4] in (b"<?xm", b"%PDF", b'{"fo')


def test_views_by_name_and_by_direction(hlr_command):
    asked = views(hlr_command, "--view", "front", "--view", "-1,1,1", "--view=-.5, 2e0,+3", "-o", "{view}.svg")
    assert asked == ["front", (-1.0, 1.0, 1.0), (-0.5, 2.0, 3.0)]


@pytest.mark.parametrize(("text", "scale"), [("1:2", 0.5), ("2:1", 2.0), ("0.5", 0.5), ("2", 2.0), ("1:2.5", 0.4)])
def test_scales(hlr_command, text, scale):
    assert options(hlr_command, "--scale", text).scale == pytest.approx(scale)


def test_the_defaults_are_those_of_the_options(hlr_command):
    from hlr.request.options import Options

    assert options(hlr_command) == Options()


def test_every_option_arrives(hlr_command):
    from hlr.request.options import Options, Perspective

    asked = options(
        hlr_command, "--no-hidden", "--smooth", "--seam", "--fit", "200x150.5", "--accuracy", "0.01", "--crease", "20",
        "--same-scale", "--up", "0,-1,0", "--eye", "-1,2,3", "--target", "0,0,-1", "--fov", "40", "--threads", "2",
        "--strict", "-q",
    )  # fmt: skip
    assert asked == Options(
        hidden=False,
        smooth=True,
        seam=True,
        fit=(200.0, 150.5),
        same_scale=True,
        accuracy=0.01,
        crease=20.0,
        up=(0.0, -1.0, 0.0),
        perspective=Perspective((-1.0, 2.0, 3.0), (0.0, 0.0, -1.0), 40.0),
        threads=2,
        strict=True,
    )
    assert options(hlr_command, "--perspective").perspective == Perspective()


def test_single_options_override_the_style(hlr_command):
    from hlr.drawing.pens import usual_pens
    from hlr.request.styles import STYLES

    assert options(hlr_command, "--style", "dark").style == STYLES["dark"]
    style = options(
        hlr_command, "--style", "dark", "--line-width", "0.3", "--color", "Gold", "--hidden-color", "#123",
        "--background", "none", "--layers", "part", "--part-colors", "lines", "--size", "800x600", "-q",
    ).style  # fmt: skip
    pens = [usual_pens(style).pen("sharp", visible) for visible in (True, False)]
    assert [(pen.width, pen.color) for pen in pens] == [(0.3, "#ffd700"), (0.15, "#112233")]
    assert (style.background, style.layers, style.part_colors, style.size) == (None, "part", "lines", (800, 600))


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--view", "isso"], "'isso' is no view: did you mean iso?"),
        (["--view", "1,2"], "three numbers"),
        (["--view", "1,2,x"], "three numbers"),
        (["--view", "1,nan,1"], "three numbers"),
        (["--scale", "0"], "not a scale"),
        (["--scale", "1:0"], "not a scale"),
        (["--scale", "big"], "not a scale"),
        (["--fit", "200"], "200x150"),
        (["--fit", "200x-1"], "200x150"),
        (["--fit", "10x10", "--scale", "2"], "contradict"),
        (["--accuracy", "0"], "--accuracy"),
        (["--accuracy", "fine"], "--accuracy"),
        (["--fov", "180"], "--fov"),
        (["--threads", "-1"], "--threads"),
        (["--nonsense"], "--nonsense"),
        (["--style", "darc"], "there is no style 'darc': give iso, asme"),
        (["--color", '"/><script>'], "--color needs a colour such as black"),
        (["--size", "800x600", "--dpi", "100"], "--size and --dpi contradict one another"),
        (["--background", "papier"], "--background needs a colour such as white"),
        (["--background", "rgb(300,0,0)"], "--background needs a colour such as white"),
        (["--color", "hsl(0,100%,150%)"], "--color needs a colour such as black"),
        (["-o", "a.dwg"], "use .svg, .pdf, "),
        (["-o", "none/a.svg"], "the folder none does not exist"),
        (["-o", "{name}.svg"], "unknown field {name}"),
        (["-o", "{n:02d}.svg"], "unknown field {n:02d}"),
        (["--param", "a=1", "--param", "a=2"], "--param gives a twice"),
        (["-o", "a.svg", "--view", "top", "--view", "front"], "put {view} into its name, for example a-{view}.svg"),
        (["-o", "{view}.svg", "--view", "top", "--view", "top"], "two views would be written to top.svg"),
        (["-o", "-", "--view", "top", "--view", "front"], "standard output takes one view"),
        (["-o", "-", "--json"], "both want standard output"),
        (["b.step"], "b.step"),
    ],
)
def test_what_cannot_be_is_refused_in_one_sentence_before_any_work(hlr_command, tmp_path, arguments, words):
    fake.ASKED.clear()
    result = hlr_command("draw", "a.step", *arguments)
    assert result.code == 2
    assert result.out.startswith("{") == ("--json" in arguments) == bool(result.out)
    assert result.err.startswith("hlr: ")
    assert words in result.err
    assert result.err.count("\n") == 1
    assert fake.ASKED == []
    assert list(tmp_path.iterdir()) == []


def test_a_source_is_needed(hlr_command):
    result = hlr_command("draw")
    assert result.code == 2
    assert result.err == "hlr: missing argument 'SOURCE' (see hlr draw --help).\n"


def test_a_source_that_cannot_be_read(hlr_command, tmp_path):
    result = hlr_command("draw", "missing.step", "-o", "a.svg")
    assert result == (2, "", "hlr: cannot read missing.step: there is no such file.\n")
    assert list(tmp_path.iterdir()) == []


def test_names_of_several_views(hlr_command, tmp_path):
    views(hlr_command, "--view", "top", "--view", "-1,1,1", "--view", "iso-nw", "-o", "{n}-{stem}-{view}.json")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["1-a-top.json", "2-a--1_1_1.json", "3-a-iso-nw.json"]


@pytest.mark.parametrize(("format", "start"), [(None, "<?xml"), ("svg", "<?xml"), ("json", '{"format"')])
def test_standard_output(hlr_command, tmp_path, format, start):
    result = hlr_command("draw", "a.step", "-o", "-", *(["--format", format] if format else []))
    assert result.code == 0
    assert result.out.startswith(start)
    assert result.err == ""
    assert list(tmp_path.iterdir()) == []


def test_what_a_script_prints_does_not_end_up_in_the_drawing(hlr_command):
    result = hlr_command("draw", "prints.py", "-o", "-")
    assert result.out.startswith("<?xml")
    assert "printed" not in result.out


def test_warnings(hlr_command, tmp_path):
    result = hlr_command("draw", "notes.step", "--view", "top", "--view", "iso")
    assert result.code == 0
    assert result.err == "hlr: warning: part 3 could not be read.\nhlr: warning: part 4 is open.\n"
    assert len(list(tmp_path.iterdir())) == 2


def test_strict_warnings_are_errors_and_nothing_is_written(hlr_command, tmp_path):
    result = hlr_command("draw", "notes.step", "--strict")
    assert result.code == 2
    assert result.err.startswith("hlr: part 3 could not be read (and 1 more)")
    assert list(tmp_path.iterdir()) == []


def test_a_summary_for_machines(hlr_command):
    result = hlr_command("draw", "a.step", "--view", "top", "--view", "iso", "-o", "{view}.pdf", "--json")
    first, second = json.loads(result.out)["drawings"]
    assert (first["file"], first["format"], first["view"]) == ("top.pdf", "pdf", "top")
    assert second["lines"] == {"visible": 6, "hidden": 4}
    assert second["counters"] == {"segments": 10}
    assert second["timings"]["total"] == pytest.approx(0.75 + second["timings"]["write"])


def test_format_wins_over_the_ending(hlr_command, tmp_path):
    assert hlr_command("draw", "a.step", "-o", "a.txt", "--format", "json").code == 0
    assert json.loads((tmp_path / "a.txt").read_text())["format"] == "hlr-drawing"


def test_a_failure_to_write_leaves_the_earlier_file(hlr_command, tmp_path, monkeypatch):
    import errno
    import os

    from hlr.drawing import files

    def full(*args):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    (tmp_path / "a.svg").write_text("old")
    monkeypatch.setattr(files, "_write", full)
    result = hlr_command("draw", "a.step", "-o", "a.svg")
    assert result == (2, "", "hlr: cannot write a.svg: no space left on device.\n")
    assert (tmp_path / "a.svg").read_text() == "old"


def test_fill_is_for_every_format(hlr_command):
    assert options(hlr_command, "--fill", "-o", "a.svg").fill
    assert options(hlr_command, "--fill", "-o", "a.json").fill
