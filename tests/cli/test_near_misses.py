"""What a newcomer types that is nearly right: the message says what was meant."""

from pathlib import Path

import pytest

import hlr

BOX = Path(__file__).parents[1] / "data" / "freecad" / "box.step"


def test_a_model_in_place_of_the_command(hlr_real):
    for name in ("part.step", "draw.py", "A b.STL"):
        done = hlr_real(name, "-o", "part.svg")
        message = f"hlr: {name!r} is a model, not a command: type hlr draw before it (see hlr --help).\n"
        assert done == (2, "", message)


@pytest.mark.parametrize(
    ("view", "message"),
    [
        ("frnt", "'frnt' is no view: did you mean front?"),
        ("front,top", "'front,top' is several views: give the option once for each"),
        ("front, top,iso", "'front, top,iso' is several views: give the option once for each"),
        ("Front top", "'Front top' is several views: give the option once for each"),
        ("vorne", "'vorne' is none of front, back, left, right, top, bottom, iso, iso-se"),
        ("front,1,2", "'front,1,2' is neither a name such as iso nor three numbers"),
    ],
)
def test_names_of_views(hlr_real, view, message):
    done = hlr_real("draw", BOX, "-o", "a.svg", "--view", view)
    assert (done.code, done.out) == (2, "") and message in done.err


def test_an_option_that_takes_one_view(hlr_real):
    done = hlr_real("methods", BOX, "--view", "front,top")
    assert (done.code, done.out) == (2, "") and "'front,top' is several views: give one of them" in done.err


def test_names_of_several_views_in_python():
    with pytest.raises(hlr.ViewError, match=r"^no view is called 'front,top': draw_views draws several\.$"):
        hlr.draw(BOX, view="front,top")


def test_names_of_views_in_python():
    with pytest.raises(hlr.ViewError, match=r"^no view is called 'frnt': did you mean front\?$"):
        hlr.draw(BOX, view="frnt")


def test_a_model_from_standard_input(hlr_real):
    message = "hlr: A model is read from a file, not from standard input: save it to a file first.\n"
    assert hlr_real("draw", "-", "-o", "a.svg") == (2, "", message)


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("box", "box has no ending, and hlr goes by it: it looks like a STEP file; use .step .stp"),
        ("box.igs", "box.igs is not an IGES file (column 73 of its first line is not S): it looks like a STEP file."),
    ],
)
def test_a_step_file_by_another_name(hlr_real, tmp_path, name, message):
    (tmp_path / name).write_bytes(BOX.read_bytes())
    done = hlr_real("draw", name, "-o", "a.svg")
    assert (done.code, done.out) == (2, "") and message in done.err
