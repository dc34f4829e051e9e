"""Of several views, a note of some of them names these."""

from dataclasses import replace

from hlr.cli.telling import of_views
from hlr.drawing.notes import Note, of_each_view
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
