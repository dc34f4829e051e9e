"""Of several views, a note of some of them names these."""

from dataclasses import replace

import pytest
import trimesh

import hlr
from hlr.cli.telling import of_views
from hlr.drawing.notes import Note, of_each_view
from hlr.errors import StrictError
from support.drawings import drawing, line

SHOWN = Note("script-shape", 'a.py: the variable "result" is drawn.')
OPEN = Note("defects", 'Part "a" is drawn as it is: open: 3 border edges.')
CUT = Note("defects", 'section left, after the cut: Part "a" is drawn as it is: open: 5 border edges.')
THIN = Note("thin-lines", "the lines are close together.")
FEW, MANY = (Note("details-left-out", f"{count} lines are left out.") for count in (87, 90))


def drawn(name, *notes):
    made = drawing([line([[0, 0], [1, 0]])])
    return replace(made, view=replace(made.view, name=name), notes=notes)


def texts(*drawings, told=()):
    return [note.text for note in of_views(drawings, told)]


def test_notes_of_some_views_name_them():
    assert texts(drawn("front", SHOWN, FEW, THIN), drawn("top", SHOWN, MANY, THIN), drawn("iso", SHOWN)) == [
        SHOWN.text,
        "view front: 87 lines are left out.",
        "views front and top: the lines are close together.",
        "view top: 90 lines are left out.",
    ]


def test_one_view_need_not_be_named():
    assert texts(drawn("front", SHOWN, FEW)) == [SHOWN.text, FEW.text]


def test_what_is_said_of_the_model_or_of_a_section_names_no_view():
    assert texts(drawn("front", OPEN), drawn("left", CUT)) == [OPEN.text, CUT.text]


def test_what_is_told_already_is_not_told_again():
    early = of_each_view(["front", "top"], [[FEW], []])
    assert texts(drawn("front", SHOWN, FEW), drawn("top", SHOWN), told=early) == [SHOWN.text]
    early = of_each_view(["front", "top"], [[FEW], [FEW]])
    assert texts(drawn("front", SHOWN, FEW), drawn("top", FEW), told=early) == [f"view front: {SHOWN.text}"]
    (note,) = of_views([drawn("front", FEW), drawn("top")])
    assert note.code == FEW.code


def test_the_command_says_it(hlr_command):
    told = hlr_command("draw", "notes.step", "--view", "top", "--view", "iso").err
    assert told.count("part 3 could not be read") == 1 and "view " not in told
    told = hlr_command("draw", "crowded.step", "--view", "top", "--view", "iso").err
    assert told == "hlr: note: view top: its lines are close together.\n"


@pytest.fixture(scope="module")
def far(tmp_path_factory):
    """Boxes, and one high above them: the view from above is not stretched by it."""
    found = trimesh.Scene()
    for i, centre in enumerate([*((x, 0.0, 0.0) for x in range(0, 30, 3)), (0.0, 500.0, 0.0)]):
        box = trimesh.creation.box((2, 2, 2))
        box.apply_translation(centre)
        box.apply_scale(1e-3)
        found.add_geometry(box, geom_name=f"p{i}", node_name=f"p{i}")
    path = tmp_path_factory.mktemp("far") / "far.glb"  # in metres, y is up
    found.export(path)
    return path


def test_a_preview_says_it(hlr_real, far):
    views = ("--view", "top", "--view", "front", "--size", "40x30", "-o", "{view}.png", "--explain")
    told = hlr_real("preview", far, *views).err
    assert told.count("hlr: note: ") == 1 and 'hlr: note: view front: the part "p10" lies far from the rest' in told
    assert [line for line in told.splitlines() if line in ("top", "front")] == ["top", "front"]
    told = hlr_real("preview", far, "--view", "front", "--size", "40x30", "-o", "a.png", "--explain").err
    assert 'hlr: note: the part "p10" lies far' in told and "front" not in told.splitlines()


@pytest.mark.parametrize(("scale", "view", "size"), [("10:1", "front", "5.03 m"), ("1:10", "top", "only 2.9 mm")])
def test_what_is_told_early_says_it_once(hlr_real, far, scale, view, size):
    told = hlr_real("draw", far, "--view", "top", "--view", "front", "--scale", scale, "-o", "{view}.svg").err
    assert told.count("m large at") == 1 and f"hlr: note: view {view}: the drawing is {size} large at {scale}" in told
    assert told.count("lies far") == 1 and 'hlr: note: view front: the part "p10" lies far' in told


def test_what_all_views_have_is_told_early_without_a_name(hlr_real, far):
    told = hlr_real("draw", far, "--view", "left", "--view", "right", "--scale", "1:200", "-o", "{view}.svg").err
    assert told.count("m large at") == 1 and "hlr: note: the drawing is only 2.5 mm large at 1:200" in told


def test_a_refusal_says_it():
    wedge = trimesh.creation.extrude_triangulation([(0, 0), (30, 0), (0, 20)], [(0, 1, 2)], 20.0)
    options = hlr.Options(scale=1, window=(25, 15, 31, 21), strict=True)
    with pytest.raises(StrictError, match=r"^view top: nothing of the drawing lies in"):
        hlr.draw_views(wedge, ["front", "top"], options)
    far_behind = trimesh.util.concatenate([wedge, wedge.copy().apply_translation((0.0, 1e8, 0.0))])
    picture = hlr.PreviewOptions(size=(40, 30), strict=True)
    with pytest.raises(StrictError, match=r"^view front: Depths within"):
        hlr.preview_views(far_behind, ["top", "front"], picture)
