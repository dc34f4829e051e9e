"""Who is right where a drawing differs from its model: rays say so, for each kind of fault, and never the wrong way."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh

import hlr
from hlr.compare import compare
from hlr.compare.difference import Difference
from hlr.compare.matching.judge import judged as judge
from hlr.compare.reading.model import sides_of
from hlr.compare.verdict.sight import HIDDEN, NOTHING, VISIBLE, truth
from hlr.compare.verdict.true_lines import TrueLines
from hlr.compare.verdict.verdicts import _polyline, with_verdicts
from hlr.drawing.chords import chords
from hlr.source import open_source
from support.drawings import line
from support.fragments import fragment
from support.models import box, parts

SURFACES = Path(__file__).parent.parent / "data/freecad/box.step"


def model():
    """A plate with a block, a pin that stands behind the block, and a groove's worth of room below it."""
    pin = trimesh.creation.cylinder(3.0, 12.0, sections=48)
    pin.apply_translation((-9, 6, 8))
    return parts(box((30, 20, 4)), pin, box((5, 12, 6), (10, -3, 8)))


@pytest.fixture(scope="module")
def drawn():
    return hlr.draw(model(), view="iso", scale=2, hidden=True, accuracy=0.02)


def length(one):
    points = one.points if one.curve is None else chords(one.curve, 0.001)
    return float(np.hypot(*np.diff(points, axis=0).T).sum())


def longest(lines):
    return max(lines, key=length)


def judged(tmp_path, text, view="iso"):
    path = tmp_path / "other.svg"
    path.write_text(text)
    return compare(path, model(), view=view, register="translation")


def test_nothing_is_judged_where_nothing_differs(drawn, tmp_path):
    found = judged(tmp_path, fragment(drawn))
    assert found.same and not found.verdicts_mm


@pytest.mark.parametrize("visible", [True, False])
def test_a_line_with_the_wrong_visibility(visible, drawn, tmp_path):
    wrong = longest(drawn.visible if visible else drawn.hidden)
    found = judged(tmp_path, fragment(drawn, seen=lambda one: one.visible != (one is wrong)))
    (one,) = (each for each in found.differences if each.kind == "visibility changed")
    assert one.verdict == "second right"
    assert ("nothing is in front" in one.reason) == visible
    assert ("a face is in front of it, by" in one.reason) != visible
    assert one.length_mm == pytest.approx(length(wrong), abs=0.3)
    assert found.verdicts_mm == {"second right": pytest.approx(one.length_mm)}
    assert "; by rays on the model: second right " in found.summary


@pytest.mark.parametrize("visible", [True, False])
def test_a_line_that_is_missing(visible, drawn, tmp_path):
    lost = longest(drawn.visible if visible else drawn.hidden)
    found = judged(tmp_path, fragment(drawn, keep=lambda one: one is not lost))
    assert {(each.kind, each.verdict) for each in found.differences} == {("new", "second right")}


def test_a_line_that_is_not_on_the_model(drawn, tmp_path):
    x, y = drawn.bounds.width / 2, drawn.bounds.height / 2
    false = line([[x - 3, y - 4], [x + 5, y + 6]])
    found = judged(tmp_path, fragment(replace(drawn, lines=(*drawn.lines, false))))
    assert {(each.kind, each.verdict) for each in found.differences} == {("gone", "second right")}
    assert {each.reason for each in found.differences} == {"no edge or outline of the model runs there"}


def test_a_line_in_the_wrong_place(drawn, tmp_path):
    right = longest(one for one in drawn.visible if one.curve is None and len(one.points) == 2)
    way = right.points[1] - right.points[0]
    aside = 0.4 * np.array([-way[1], way[0]]) / np.hypot(*way)
    wrong = replace(right, points=right.points + aside)
    lines = tuple(wrong if one is right else one for one in drawn.lines)
    found = judged(tmp_path, fragment(replace(drawn, lines=lines)))
    (one,) = (each for each in found.differences if each.kind == "moved")
    assert (one.verdict, one.moved_mm) == ("second right", pytest.approx(0.4, abs=0.01))


def test_the_model_is_judged_too(drawn, tmp_path):
    """Where the drawing is right and what hlr drew of the model is not, the verdict says so."""
    path = tmp_path / "other.svg"
    path.write_text(fragment(drawn))
    side = compare(path, model(), view="iso", register="translation")
    wrong = longest(drawn.visible)
    before, after = sides_of(path, model(), 0.1, "iso")
    motion = side.motion
    pieces = motion.applied(after.pieces)
    middle = wrong.points.mean(axis=0) + motion.shift
    near = np.hypot(*(0.5 * (pieces.start + pieces.end) - middle).T)
    spoilt = pieces.line == pieces.line[near.argmin()]
    after = replace(after, pieces=replace(pieces, visible=np.where(spoilt, 0, pieces.visible)))
    found = with_verdicts(judge(before, after, 0.1), before, after, motion, 0.1)
    assert {each.verdict for each in found.differences if each.kind == "visibility changed"} == {"first right"}


@pytest.mark.slow
@pytest.mark.parametrize("chord_mm", [0.06, 0.4])
def test_straight_pieces_are_right_as_long_as_they_look_like_the_curve(chord_mm, tmp_path):
    path = tmp_path / "other.svg"
    path.write_text(fragment(hlr.draw(SURFACES, view="iso", scale=2, hidden=True), chord_mm=chord_mm))
    bent = [each for each in compare(path, SURFACES, view="iso", scale=2).differences if each.kind == "polyline"]
    assert sum(each.length_mm for each in bent) > 300
    assert any(each.moved_mm > 0.1 for each in bent) == (chord_mm > 0.1)
    for each in bent:
        assert each.verdict == ("both right" if each.moved_mm <= 0.1 else "second right"), each


@pytest.mark.slow
@pytest.mark.parametrize("first", [True, False])
def test_how_the_drawing_lies_makes_no_difference(first, drawn, tmp_path):
    wrong = longest(drawn.visible)
    text = fragment(drawn, scale=1.5, shift=(30, -20), seen=lambda one: one.visible != (one is wrong))
    text = text.replace('"0.35"', '"0.35" stroke-dasharray="2 1"')
    path = tmp_path / "other.svg"
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg"><g transform="rotate(90)">{text}</g></svg>')
    found = compare(path, model(), view="iso") if first else compare(model(), path, view="iso")
    assert found.motion.turn
    verdicts = {each.verdict for each in found.differences if each.kind == "visibility changed"}
    assert verdicts == {"second right" if first else "first right"}


@pytest.mark.parametrize("view", ["front", "top", "iso", (1.0, -2.0, 0.5)])
def test_rays_agree_with_every_line_that_is_drawn(view):
    """Of exact drawings no line is contradicted in its middle, and a place without lines has none."""
    source = open_source(model())
    drawing = hlr.draw(source, view=view, scale=2, hidden=True, smooth=True, accuracy=0.02)
    lines = [one for one in drawing.lines if length(one) > 1.0]
    points = [one.points if one.curve is None else chords(one.curve, 0.002) for one in lines]
    middle = np.array([each[len(each) // 2 - 1 : len(each) // 2 + 1].mean(axis=0) for each in points])
    ways = np.array([each[len(each) // 2] - each[len(each) // 2 - 1] for each in points])
    known = truth(TrueLines.of(source, drawing, 0.1), middle, ways, 0.1)
    state = np.maximum(known.always, known.optional)
    visible = np.array([one.visible for one in lines])
    assert not (visible & (state == HIDDEN)).any() and not (~visible & (state == VISIBLE) & ~known.hidden).any()
    assert (state != NOTHING).all()
    off = truth(TrueLines.of(source, drawing, 0.1), middle + (500.0, 0.0), ways, 0.1)
    assert (off.always == NOTHING).all() and not np.isfinite(off.away).any()


@pytest.mark.parametrize(
    ("side", "became", "verdict"),
    [
        ("before", "straight pieces", "first right"),
        ("before", "a curve", "second right"),
        ("after", "straight pieces", "second right"),
        ("after", "a curve", "first right"),
    ],
)
def test_the_drawing_with_the_curve_is_right_whichever_it_is_told_of(side, became, verdict):
    bent = Difference("polyline", (0.0, 0.0), 5.0, "sharp", True, None, None, side, became, 0.3)
    assert _polyline(bent, 0.1).verdict == verdict
    assert _polyline(replace(bent, moved_mm=0.05), 0.1).verdict == "both right"
