"""Several outputs in one pass, folders, and what contradicts itself."""

import pytest

import hlr
from hlr import Options, Perspective
from hlr.tables.sheets import papers
from support import fake_pipeline as fake


def names(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())


def test_all_outputs_are_written_in_one_pass(hlr_command, tmp_path):
    fake.ASKED.clear()
    result = hlr_command("draw", "a.step", "-o", "a.svg", "-o", "b.pdf", "-o", "-", "--format", "json")
    assert (result.code, result.err) == (0, "")
    assert result.out.startswith('{"format"')
    assert names(tmp_path) == ["a.svg", "b.pdf"]
    assert (tmp_path / "a.svg").read_bytes().startswith(b"<?xml")
    assert (tmp_path / "b.pdf").read_bytes().startswith(b"%PDF")
    assert len(fake.ASKED) == 1


def test_several_outputs_of_several_views(hlr_command, tmp_path):
    import json

    done = hlr_command(
        "draw", "a.step", "-o", "{view}.svg", "-o", "{n}.pdf", "--view", "top", "--view", "FRONT", "--json"
    )
    assert names(tmp_path) == ["1.pdf", "2.pdf", "front.svg", "top.svg"]
    entries = json.loads(done.out)["drawings"]
    assert [(e["file"], e["view"]) for e in entries] == [
        ("top.svg", "top"), ("1.pdf", "top"), ("front.svg", "front"), ("2.pdf", "front"),
    ]  # fmt: skip


@pytest.mark.parametrize("output", ["new/deep/", "there/", "there"])
def test_a_folder_takes_them_by_source_and_view(hlr_command, tmp_path, output):
    (tmp_path / "there").mkdir()
    result = hlr_command("draw", "models/a.step", "-o", output, "--view", "top", "--view", "1,0,0", "--format", "pdf")
    assert (result.code, result.err) == (0, "")
    assert names(tmp_path / output) == ["a-1_0_0.pdf", "a-top.pdf"]


def test_a_folder_is_made_only_for_what_is_written(hlr_command, tmp_path):
    assert hlr_command("draw", "missing.step", "-o", "new/").code == 2
    assert hlr_command("draw", "notes.step", "-o", "new/", "--strict").code == 2
    assert list(tmp_path.iterdir()) == []


def test_a_preview_into_a_folder(hlr_real, tmp_path):
    (tmp_path / "t.off").write_text("OFF\n3 1 0\n0 0 0\n9 0 0\n0 9 0\n3 0 1 2\n")
    assert (
        hlr_real("preview", "t.off", "-o", "shaded/", "--size", "20x20", "--view", "Top", "--ids", "ids.png").code == 0
    )
    assert names(tmp_path) == ["ids.png", "shaded/t-top.png", "t.off"]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["-o", "a.svg", "-o", "a.svg"], "two things would be written to a.svg;"),
        (
            ["-o", "a.svg", "-o", "A.svg"],
            "a.svg and A.svg are one file where large and small letters are the same, as on",
        ),
        (["-o", "a.svg", "-o", "./a.svg"], "two things would be written to"),
        (["-o", "a.svg", "-o", "LINK.svg"], "which is a.svg"),
        (["-o", "-", "-o", "-"], "given twice"),
        (["-o", "a.svg", "--format", "pdf"], "contradict"),
        (["-o", "a.svg", "-o", "b"], "the name has no ending"),
        (["--eye", "1,2,3", "--view", "top"], "--eye and --view contradict"),
        (["--scale", "2", "--scale", "3"], "--scale is given twice"),
        (["--fit", "A7x"], "A4-landscape"),
        (["b.step"], "draw takes SOURCE, and 'b.step' is one more; hlr batch draws many"),
        (["--arrange", "-o", "b.pdf"], "--arrange takes a value, and -o stands there"),
    ],
)
def test_contradictions_are_refused(hlr_command, tmp_path, arguments, words):
    (tmp_path / "LINK.svg").symlink_to(tmp_path / "a.svg")
    result = hlr_command("draw", "a.step", *arguments)
    assert result.code == 2
    assert words in result.err and result.err.count("\n") == 1
    assert names(tmp_path) == []


@pytest.mark.parametrize("verb", ["draw", "preview", "compare", "study", "methods", "batch"])
def test_an_empty_name_is_not_this_folder(hlr_command, tmp_path, verb):
    (tmp_path / "a.step").write_text("")
    result = hlr_command(verb, "a.step", "-o", "")
    assert (result.code, result.err.count("\n")) == (2, 1)
    assert "-o" in result.err and "the name of the output is empty" in result.err
    assert names(tmp_path) == ["a.step"]


def test_flags_may_be_repeated(hlr_command):
    assert hlr_command("draw", "a.step", "-q", "-q", "--hidden", "--no-hidden", "-o", "a.svg").code == 0
    assert not fake.ASKED[-1][2].hidden


@pytest.mark.parametrize("verb", ["plan", "preview"])
def test_an_eye_is_no_named_view(hlr_real, verb):
    result = hlr_real(verb, "a.step", "--eye", "1,2,3", "--view", "top")
    assert result.code == 2 and "--eye and --view contradict" in result.err


@pytest.mark.parametrize(
    ("given", "size"),
    [
        ("A4", (277.0, 190.0)), ("a4-portrait", (190.0, 277.0)), ("A4 landscape", (277.0, 190.0)),
        ("A3-portrait", (277.0, 400.0)), ("A0", (1169.0, 821.0)), ("letter", (259.4, 195.9)), ("120x80", (100.0, 60.0)),
    ],
)  # fmt: skip
def test_paper_sizes(hlr_command, given, size):
    assert hlr_command("draw", "a.step", "--page", given).code == 0
    assert papers(fake.ASKED[-1][2].page)[0].room == pytest.approx(size)
    assert hlr_command("draw", "a.step", "--fit", given).code == 0
    fit = fake.ASKED[-1][2].fit
    assert fit == ((120.0, 80.0) if given == "120x80" else given)


def cube():
    import trimesh

    return trimesh.creation.box((1, 1, 1))


def test_what_an_eye_sees_is_called_so(hlr_real, tmp_path):
    drawing = hlr.draw(cube(), "top", perspective=Perspective(eye=(9.0, -7.0, 5.0)))
    assert drawing.view.name == "eye"
    cube().export(tmp_path / "c.stl")
    assert hlr_real("draw", "c.stl", "--eye", "9,-7,5", "-o", "{view}.svg", "-q").code == 0
    assert names(tmp_path) == ["c.stl", "eye.svg"]


@pytest.mark.parametrize(
    ("views", "options", "words"),
    [
        ([(0.0, 0.0, 0.0)], {}, "the view direction is zero"),
        (["front"], {"up": (0.0, 0.0, 0.0)}, "`up` is zero"),
        (["iso", "front"], {"up": (0.0, 2.0, 0.0)}, "`up` is parallel"),
        ([(0.0, 0.0, 5.0)], {"up": (0.0, 0.0, -1.0)}, "`up` is parallel"),
        (["nowhere"], {}, "no view is called 'nowhere'"),
        (["iso"], {"perspective": Perspective(eye=(1.0, 1.0, 1.0), target=(1.0, 1.0, 1.0))}, "one point"),
        (
            ["iso"],
            {"perspective": Perspective((0, 0, 9), (0, 0, 0)), "up": (0.0, 0.0, 1.0)},
            "`up` is parallel",
        ),
        (["iso", "top"], {"perspective": Perspective(eye=(1.0, 1.0, 1.0))}, "2 views from one eye"),
    ],
)
@pytest.mark.parametrize("ask", ["draw_views", "plan_views", "preview_views", "within"])
def test_directions_are_checked_before_the_model_is_read(tmp_path, ask, views, options, words):
    source = tmp_path / "missing.step"  # which would be the error if it were looked for
    with pytest.raises(hlr.ViewError, match=words):
        if ask == "preview_views":
            hlr.preview_views(source, views, hlr.PreviewOptions(**options))
        elif ask == "within":
            hlr.draw_views(source, views, Options(within=1.0, **options))
        else:
            getattr(hlr, ask)(source, views, Options(**options))


def test_scale_and_fit_contradict_in_python_too():
    with pytest.raises(hlr.OptionError, match="`scale` and `fit` contradict"):
        hlr.draw(cube(), scale=2.0, fit=(10.0, 10.0))


def test_views_in_any_case():
    assert hlr.draw(cube(), "FRONT").view.name == "front"


def test_a_small_cube_is_no_reason_for_strict_to_refuse(hlr_real, tmp_path):
    cube().export(tmp_path / "c.stl")
    result = hlr_real("draw", "c.stl", "--strict", "-o", "c.svg")
    assert result.code == 0
    assert result.err == ""
    result = hlr_real("draw", "c.stl", "--strict", "--scale", "1:1", "--details", "-o", "c.svg")
    assert result.code == 0
    assert result.err.startswith("hlr: note: the drawing is only 2.2 mm large at 1:1") and result.err.count("\n") == 1
    assert hlr.draw(cube(), strict=True, scale=1.0).notes[0].code == "paper-size"
    assert hlr_real("preview", "c.stl", "--strict", "-o", "c.png", "--size", "20x20").code == 0


def test_the_command_line_and_python_agree_on_the_page(hlr_real, tmp_path):
    cube().export(tmp_path / "c.stl")
    for given, options in (
        ([], {}),
        (["--page", "letter"], {"page": "letter"}),
        (["--page", "300x200", "--scale", "20:1"], {"page": (300.0, 200.0), "scale": 20.0}),
        (["--fit", "A5-portrait"], {"fit": "A5-portrait"}),
        (["--hidden", "--no-smooth"], {"hidden": True, "smooth": False}),
    ):
        assert hlr_real("draw", "c.stl", "-o", "c.svg", *given)[:1] == (0,)
        assert (tmp_path / "c.svg").read_text() == hlr.draw(tmp_path / "c.stl", **options).to_svg()


@pytest.mark.parametrize("page", ["A9", "A4-up", "15x300", "x", ""])
def test_a_page_that_does_not_exist_is_refused_in_a_sentence(hlr_real, page):
    result = hlr_real("draw", "a.step", "--page", page)
    assert result.code == 2 and result.err.startswith("hlr: ") and result.err.count("\n") == 1 and "page" in result.err


def test_the_size_is_told_before_the_model_is_meshed(tmp_path):
    told = []
    cube().apply_scale(9000.0).export(tmp_path / "c.stl")
    (drawing,) = hlr.draw_views(
        tmp_path / "c.stl",
        ["front"],
        Options(scale=1.0),
        progress=lambda stage, _done: told.append(stage),
        noted=lambda notes: told.extend(note.code for note in notes),
    )
    assert told.index("paper-size") < told.index("scene")
    assert [note.code for note in drawing.notes] == ["paper-size"]
