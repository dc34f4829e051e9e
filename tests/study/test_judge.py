"""The study's judge, on lines whose errors are known; and the Pareto front."""

import numpy as np
import pytest

from hlr.drawing.chords import chords
from hlr.drawing.curve import Arc, Bezier
from hlr.lab.judge import Judge
from hlr.lab.measure.classes import ModelJudge
from hlr.lab.polylines import gathered, load
from hlr.lab.study.frontier import frontier
from hlr.lab.study.job import HLR, POLY, Cost, Point
from hlr.lab.study.judge import LineJudge
from hlr.lab.study.watch import Watch


def ink(*lines):
    return gathered([(kind, visible, np.array(points, float)) for kind, visible, points in lines])


TRUE = ink(
    ("sharp", True, [[0, 0], [100, 0]]), ("sharp", False, [[100, 0], [150, 0]]), ("sharp", True, [[0, 9], [50, 9]])
)


def test_the_truth_has_no_errors():
    found = LineJudge(TRUE).judge(TRUE)
    assert max(found["ink_worst"], found["off_worst"], found["wrong"]) == pytest.approx(0.0, abs=1e-12)
    assert found["true_visible"] == pytest.approx(150)


def test_a_line_beside_its_place():
    drawn = ink(("sharp", True, [[0, 0.03], [100, 0.03]]), ("sharp", True, [[0, 9], [50, 9]]))
    found = LineJudge(TRUE).judge(drawn)
    assert found["ink_worst"] == pytest.approx(0.03) and found["ink_p99"] == pytest.approx(0.03)
    assert found["ink_mean"] == pytest.approx(0.02, rel=1e-3) and found["wrong"] == 0.0


@pytest.mark.parametrize("end", [97.0, 103.0])
def test_a_displaced_change(end):
    drawn = ink(
        ("sharp", True, [[0, 0], [end, 0]]), ("sharp", False, [[end, 0], [150, 0]]), ("sharp", True, [[0, 9], [50, 9]])
    )
    found = LineJudge(TRUE).judge(drawn)
    assert found["off_worst"] == pytest.approx(0.0, abs=1e-12)
    assert found["ink_worst"] == pytest.approx(3.0)
    assert found["mislabelled"] == pytest.approx(3.0 - 0.1, abs=0.01)
    assert found["too_much" if end > 100 else "missing"] == pytest.approx(2.9, abs=0.01)


def test_lost_and_false_lines():
    drawn = ink(("sharp", True, [[0, 0], [100, 0]]), ("sharp", True, [[0, 29], [10, 29]]))
    found = LineJudge(TRUE).judge(drawn)
    assert found["missing"] == pytest.approx(50) and found["too_much"] == pytest.approx(10)
    assert found["off_worst"] == pytest.approx(20) and found["wrong"] == pytest.approx(60 / 150)


def test_tangent_edges_may_be_drawn_and_need_not():
    true = ink(("sharp", True, [[0, 0], [100, 0]]), ("smooth", True, [[0, 5], [100, 5]]))
    assert LineJudge(true).judge(ink(("sharp", True, [[0, 0], [100, 0]])))["wrong"] == 0.0
    assert (
        LineJudge(true).judge(ink(("sharp", True, [[0, 0], [100, 0]]), ("sharp", True, [[0, 5], [100, 5]])))["wrong"]
        == 0.0
    )


def test_an_empty_drawing_misses_everything():
    found = LineJudge(TRUE).judge(ink())
    assert found["missing"] == pytest.approx(150) and found["wrong"] == pytest.approx(1.0)


@pytest.mark.slow
@pytest.mark.parametrize("chord", [0.1, 1e-4])
def test_chords_stay_as_near_as_asked(chord):
    arc = Arc(np.zeros(2), np.array([[30.0, 0.0], [0.0, 20.0]]), np.array([0.2, 4.0]))
    curve = Bezier(3, np.array([[0, 0], [10, 30], [40, -30], [50, 0], [60, 30], [70, 0], [80, 5]], float))
    for shape, start, end in ((arc, *arc.angles), (curve, 0.0, 2.0)):
        drawn = gathered([("sharp", True, chords(shape, chord))])
        dense = gathered([("sharp", True, shape.at(np.linspace(start, end, 5001)))])
        assert LineJudge(dense).judge(drawn)["ink_worst"] < 1.05 * chord + 1e-4


def test_lines_are_kept(tmp_path):
    TRUE.save(tmp_path / "a.npz")
    again = load(tmp_path / "a.npz")
    assert (again.points == TRUE.points).all() and (again.offsets == TRUE.offsets).all()
    assert (again.visible == TRUE.visible).all() and (again.kind == TRUE.kind).all()


def test_the_frontier():
    def point(who, seconds, error):
        return Point(who, 0.0, stages={"visibility": Cost(seconds, seconds, 1.0)}, errors={"ink_p99": error})

    a, b, c, d = point(HLR, 1, 0.5), point(HLR, 2, 0.1), point(POLY, 3, 0.3), point(POLY, 0.5, 2.0)
    assert frontier([a, b, c, d, Point(HLR, 0.1, failure="late")], "ink_p99") == [d, a, b]


def test_stages_are_told_apart():
    watch = Watch()
    watch("a")
    kept = np.ones(4_000_000)
    watch("a", 0.5)
    watch("b")
    watch.stop()
    assert set(watch.stages) == {"a", "b"} and kept.sum() > 0
    assert all(cost.wall >= 0.0 and cost.memory > 1.0 for cost in watch.stages.values())


def test_what_a_user_needs_in_a_sentence():
    from hlr.lab.study.advice import advice

    def ours(setting, seconds):
        return Point(HLR, setting, stages={"tessellate": Cost(seconds, seconds, 1.0)})

    said = advice([ours(2, 0.1), ours(0.05, 0.4), ours(0.02, 0.7), ours(0.001, 12), Point(HLR, 0.0005, failure="late")])
    assert said == (
        "0.05 mm (the default) costs 400 ms of processor time, the coarsest drawing (2 mm) 100 ms; "
        "for at most twice that there is 0.02 mm; 0.001 mm costs 12 s."
    )
    assert advice([ours(0.05, 1)]) == ""


def test_judges_have_one_form():
    """Made from a truth, asked drawing by drawing; each answer is of its own drawing alone."""
    assert isinstance(LineJudge(TRUE), Judge) and isinstance(ModelJudge("box.step"), Judge)
    judge = LineJudge(TRUE)
    first = judge.judge(TRUE)
    judge.judge(ink(("sharp", True, [[0, 5], [100, 5]])))
    assert judge.judge(TRUE) == first
