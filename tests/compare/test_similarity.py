"""Drawings of two programs are laid on one another, and what then differs is named."""

import re
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from hlr.compare import compare
from hlr.compare.lines.motion import Motion
from hlr.compare.lines.strays import without_strays
from hlr.compare.reading.sides import side_of
from support.drawings import arc, drawing, line

BOX = Path(__file__).parent.parent / "data/freecad/box_iso.svg"
MODEL = BOX.with_name("box.step")


def mutated(tmp_path, pattern, replacement, transform=""):
    """FreeCAD's drawing of the box with one thing changed."""
    text, count = re.subn(pattern, replacement, BOX.read_text(), count=1)
    assert count == 1 or not pattern
    path = tmp_path / "mutated.svg"
    path.write_text(f'<g transform="{transform}">{text}</g>' if transform else text)
    return path


def kinds(found):
    return {each.kind for each in found.differences if not found.looks_same(each)}


def test_nothing_is_invented_on_the_untouched_pair():
    found = compare(BOX, BOX)
    assert found.same and not kinds(found) and found.motion == Motion()


@pytest.mark.parametrize(
    ("transform", "inverse"),
    [
        ("rotate(90)", Motion(turn=90)),
        ("rotate(180)", Motion(turn=180)),
        ("rotate(270)", Motion(turn=270)),
        ("scale(-1, 1)", Motion(mirrored=True)),
        ("scale(1.0005)", Motion(scale=1 / 1.0005)),
        ("translate(30, -70) rotate(90) scale(0.25)", Motion(turn=90, scale=4.0)),
        ("scale(1, -1) translate(3, 1)", Motion(mirrored=True, turn=180)),
    ],
)
def test_turned_mirrored_and_scaled_drawings_are_laid_on_one_another(tmp_path, transform, inverse):
    found = compare(BOX, mutated(tmp_path, "", "", transform))
    assert found.same, found.summary
    motion = found.motion
    assert (motion.mirrored, motion.turn) == (inverse.mirrored, inverse.turn)
    assert motion.scale == pytest.approx(inverse.scale, rel=2e-6)
    assert all(word in found.summary for word in inverse.words()[:-1])
    assert motion.scales == (inverse.scale != 1.0)


FIRST_LINE = r'<path id= "2" d=" M -31.1127 6.14405 L 2.82843 25.74 " />'


@pytest.mark.parametrize(
    ("pattern", "replacement", "kind", "mm"),
    [
        (re.escape(FIRST_LINE), "", "gone", 39.19),
        (re.escape(FIRST_LINE), '<path d=" M -31.2127 6.31725 L 2.72843 25.9132 " />', "moved", 39.19),
        (re.escape(FIRST_LINE), FIRST_LINE + '<path d="M 0 0 L 3 4"/>', "new", 5.0),
    ],
)
@pytest.mark.parametrize("transform", ["", "translate(5, 7) rotate(90)"])
def test_a_mutation_is_found_and_named(tmp_path, pattern, replacement, kind, mm, transform):
    found = compare(BOX, mutated(tmp_path, pattern, replacement, transform))
    assert kinds(found) == {kind}, found.summary
    assert found.lengths_mm[kind] == pytest.approx(mm, abs=0.35)
    if kind == "moved":
        assert found.differences[0].moved_mm == pytest.approx(0.2, abs=0.02)


def test_visible_and_hidden_exchanged_is_found_and_named(tmp_path):
    swapped = tmp_path / "swapped.svg"
    swapped.write_text(BOX.read_text().replace('"0.35"', '"?"').replace('"0.7"', '"0.35"').replace('"?"', '"0.7"'))
    found = compare(BOX, swapped)
    assert kinds(found) == {"visibility changed"} and found.lengths_mm["visibility changed"] > 640
    assert found.same_mm < 6  # where lines meet


@pytest.mark.slow
def test_freecads_drawing_of_a_box_beside_ours(tmp_path):
    """What hlr draws and FreeCAD does not are hidden smooth lines and seams; else both are the same."""
    import hlr

    ours = hlr.draw(MODEL, view=(1, -1, 1), scale=1, hidden=True, smooth=True, seam=True, details=True)
    found = compare(BOX, ours)
    only_ours = [each for each in found.differences if not found.looks_same(each)]
    assert {each.kind for each in only_ours} == {"new"} and found.motion.words() == []
    assert {(each.line_class, each.visible) for each in only_ours} <= {
        ("smooth", False),
        ("seam", False),
        ("seam", True),
    }
    assert found.same_mm == pytest.approx(655, abs=2)


def test_an_empty_or_a_tiny_drawing_has_no_motion(tmp_path):
    dot = tmp_path / "dot.svg"
    dot.write_text('<g stroke="#000" fill="none"><path d="M 0 0 L 0.001 0"/></g>')
    assert np.isfinite(compare(BOX, dot).motion.scale) and np.isfinite(compare(dot, BOX).motion.scale)


def test_a_line_to_nowhere_says_nothing_of_the_size(tmp_path):
    """FreeCAD drew an arc of 20 metres beside a part of 170 millimetres: its scale was taken to be 70."""
    stray = mutated(tmp_path, re.escape(FIRST_LINE), FIRST_LINE + '<path d="M 0 0 A 10000 10000 0 1 1 3 4"/>')
    found = compare(BOX, stray)
    assert kinds(found) == {"new"} and not found.motion.words()
    assert len(without_strays(side_of(stray, 0.1).pieces)) == len(side_of(BOX, 0.1).pieces)


def test_lines_along_which_a_drawing_can_slide_are_not_enough(tmp_path):
    """FreeCAD drew loose edges beside a bent sheet: its long lines lay on ours, all others 6 mm beside them."""
    long = [((0, y), (100, y)) for y in range(0, 30, 5)]
    short = [((x, 0), (x, 25)) for x in (0, 31, 47, 68, 100)]
    loose = [((-14, 0), (0, 0)), ((100, 0), (102, 0))]
    path = tmp_path / "theirs.svg"
    body = "".join(f'<path d="M {a + 40} {-b - 7} L {c + 40} {-d - 7}"/>' for (a, b), (c, d) in [*long, *short, *loose])
    path.write_text(f'<g stroke="#000" stroke-width="0.7" fill="none">{body}</g>')
    found = compare(path, drawing([line(ends) for ends in [*long, *short]]), scale=1.0)
    assert found.shift == (40.0, 7.0) and found.lengths_mm["gone"] == pytest.approx(16.0, abs=0.2), found


@pytest.mark.parametrize(("x", "half", "kind"), [(9.8, 3.0, "polyline"), (10.45, 0.1, "moved"), (9.6, 0.2, "moved")])
def test_a_short_line_beside_a_curve_is_no_chord_of_it(tmp_path, x, half, kind):
    """FreeCAD drew a view in another place: a bit of a line there, 0.47 mm beside a curve, was its chord."""
    corners = [(-30, -20), (30, -20), (30, 20), (-30, 20), (-30, -20)]
    sides = [line(ends) for ends in pairwise(corners)]
    path = tmp_path / "theirs.svg"
    theirs = [*pairwise(corners), ((x, -half), (x, half))]
    body = "".join(f'<path d="M {a} {-b} L {c} {-d}"/>' for (a, b), (c, d) in theirs)
    path.write_text(f'<g stroke="#000" stroke-width="0.7" fill="none">{body}</g>')
    ours = drawing([*sides, arc((0, 0), 10, 10, (0.0, 2.0 * np.pi))])
    found = compare(path, ours, scale=1.0)
    assert kinds(found) - {"new"} == {kind}, found
