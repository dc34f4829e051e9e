"""Numbers on the command line: what is out of range is said as a person would type it."""

from pathlib import Path

import pytest

BOX = str(Path(__file__).parents[1] / "data" / "freecad" / "box.step")


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("draw", BOX, "--dpi", "1e9"), "'--dpi': 1000000000 is out of range: give a number from 1 to 10000 (see"),
        (("draw", BOX, "--line-width", "0.001"), "0.001 is out of range: give a number from 0.01 to 100 (see"),
        (("draw", BOX, "--crease", "-1e-7"), "-0.0000001 is out of range: give a number from 0 to 180 (see"),
        (("draw", BOX, "--fov", "180"), "180 is out of range: give a number from 0.01 to 170 (see"),
        (("draw", BOX, "--accuracy", "0.0"), "'--accuracy': 0 is out of range: give a number above 0 (see"),
        (("draw", BOX, "--accuracy", "fine"), "'--accuracy': 'fine' is not a number (see"),
        (("draw", BOX, "--accuracy", "nan"), "'--accuracy': 'nan' is not a number (see"),
        (("draw", BOX, "--threads", "-1"), "'--threads': -1 is out of range: give a number of at least 0 (see"),
        (("draw", BOX, "--threads", "1.5"), "'--threads': '1.5' is not a whole number (see"),
        (("draw", BOX, "--threads", "9" * 400), f"'{'9' * 400}' is not a whole number (see"),
        (("info", BOX, "--crease", "181"), "181 is out of range: give a number from 0 to 180 (see"),
        (("batch", "--jobs", "0"), "'-j' / '--jobs': 0 is out of range: give a number from 1 to 1024 (see"),
        (("study", BOX, "-o", "a", "--runs", "0"), "0 is out of range: give a number of at least 1 (see"),
        (("methods", "--limit", "0"), "0 is out of range: give a number above 0 (see"),
        (("compare", "a.svg", "b.svg", "--tolerance", "wide"), "'--tolerance': 'wide' is not a number (see"),
    ],
)
def test_a_number_that_is_refused_is_told_as_people_type_it(hlr_real, arguments, words):
    done = hlr_real(*arguments)
    assert done.code == 2 and words in done.err and len(done.err.splitlines()) == 1


def test_numbers_at_the_end_of_a_range_are_allowed(hlr_real):
    for arguments in (("--crease", "0"), ("--crease", "1.8e2"), ("--threads", " +1 "), ("--dpi", "10000")):
        assert hlr_real("draw", BOX, "--format", "svg", "-o", "a.svg", *arguments).code == 0
