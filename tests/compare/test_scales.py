"""The scale of a drawing of another program: found although one has lines that the other has not, or said."""

import numpy as np
import pytest

import hlr
from hlr.compare import compare
from hlr.compare.matching.scales import voted_scales
from hlr.compare.reading.sides import side_of
from hlr.errors import OptionError
from support.drawings import drawing, line
from support.fragments import fragment
from support.models import box, parts

LOOSE = "".join(f'<path d="M {x} {-x} L {x + 7} {2 * x - 90}"/>' for x in range(20, 60, 4))
"""Lines far outside the part: FreeCAD draws edges of a file that belong to no face, hlr leaves them out."""


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    path = tmp_path_factory.mktemp("model") / "step.stl"
    parts(box((30, 20, 4)), box((8, 6, 10), (-9, 5, 7)), box((5, 12, 3), (10, -3, 3.5))).export(path)
    return path


def with_loose_lines(model, path, scale=1.0):
    drawn = hlr.draw(model, view="iso", scale=1, hidden=True)
    text = fragment(drawn, scale=scale)
    path.write_text(text.replace("</g>", LOOSE + "</g>", 1))
    return path


@pytest.mark.parametrize("view", ["iso", None])
def test_lines_that_one_drawing_has_alone_say_nothing_of_the_scale(view, model, tmp_path):
    found = compare(with_loose_lines(model, tmp_path / "a.svg", 0.5), model, view=view)
    assert found.motion.scale == pytest.approx(1.0, abs=1e-4) and found.badly_laid is None, found
    assert {(each.kind, each.side) for each in found.differences} == {("gone", "before")}
    assert len(found.differences) == 10


def test_two_drawings_of_which_one_has_lines_alone_are_laid_on_one_another(model, tmp_path):
    path = with_loose_lines(model, tmp_path / "a.svg", 0.37)
    found = compare(path, hlr.draw(model, view="iso", scale=1, hidden=True))
    assert found.motion.scale == pytest.approx(0.37, rel=1e-4) and set(found.lengths_mm) - {"gone"}, found
    assert {each.kind for each in found.differences if not found.looks_same(each)} == {"gone"}


def test_the_ratio_that_most_lines_have_is_the_scale(model, tmp_path):
    one = hlr.draw(model, view="iso", scale=1, hidden=True)
    other = tmp_path / "a.svg"
    other.write_text(fragment(one, scale=0.35))
    (scale,) = voted_scales(side_of(one, 0.1).pieces, side_of(other, 0.1).pieces)
    assert scale == pytest.approx(0.35, rel=5e-3)


def test_a_scale_that_is_said_is_kept(model, tmp_path):
    path = tmp_path / "a.svg"
    path.write_text(fragment(hlr.draw(model, view="top", scale=1, hidden=True), scale=1.001))
    found = compare(path, model, view="top")
    assert found.same and found.motion.scale == pytest.approx(1.001, abs=1e-5)
    exact = compare(path, model, view="top", scale=1.0, tolerance_mm=0.005)
    assert not exact.same and exact.motion.scale == 1.0
    assert compare(path, model, view="top", scale=1.001, tolerance_mm=0.005).same


def test_a_scale_is_refused_where_both_drawings_say_theirs(model, tmp_path):
    drawn = hlr.draw(model, view="top").save(tmp_path / "a.svg")
    for given in ((drawn, drawn), (drawn, model), (model, model)):
        with pytest.raises(
            OptionError, match="a scale is for a drawing of another program, which does not say its own"
        ):
            compare(*given, scale=0.5)
    with pytest.raises(OptionError, match="give a positive number"):
        compare(drawn, drawn, scale=0.0)


def test_nothing_is_judged_where_few_lines_lie_on_one_another(model, tmp_path):
    path = tmp_path / "other.svg"
    spokes = "".join(f'<path d="M 0 0 L {3 * x} {70 - x * x}"/>' for x in range(1, 30))
    path.write_text(f'<g stroke="#000" stroke-width="0.7" fill="none">{spokes}</g>')
    found = compare(path, model, view="iso")
    assert 0.01 < found.motion.scale < 100.0  # small enough, a drawing lies on any line
    assert found.badly_laid is not None and found.badly_laid < 0.3 and not found.verdicts_mm
    assert "too few to say who is right" in found.summary and found.to_dict()["badly_laid"] == found.badly_laid


def test_a_curve_of_many_pieces_beside_a_curve_is_no_chord(tmp_path):
    """Where two surfaces meet, hlr draws a line of many pieces: it is displaced, and not drawn as straight pieces."""
    angle = np.linspace(0.0, 1.5, 40)
    ours = [line(np.stack([20 * np.cos(angle), 20 * np.sin(angle)], axis=1)), line([[0, 0], [40, 0]])]
    path = tmp_path / "a.svg"
    body = '<path d="M 20.2 0 A 20.2 20.2 0 0 1 1.42889 20.1494"/><path d="M 0 0 L 40 0"/>'
    path.write_text(f'<g transform="scale(1,-1)" stroke="#000" stroke-width="0.7" fill="none">{body}</g>')
    found = compare(path, drawing(ours), register="off")
    assert {each.kind for each in found.differences} == {"moved"}, found
