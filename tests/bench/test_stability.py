"""The measure of stability: zero where nothing moved, and the length known from geometry where something did."""

from __future__ import annotations

from pathlib import Path

import cadquery as cq
import numpy as np
import pytest
from bench import stability, stability_plot
from bench.stability_child import Measurement
from bench.stability_hlr import Model, nodes, turn
from bench.stability_measure import COVER, NEAR, STEP, Change, change

from support.ink import ink, strokes

ACCURACY = 0.05
NOTHING = Change(0.0, 0.0, 0.0, 0.0, 0.0)


def test_samples_stand_for_the_length_of_the_lines() -> None:
    bent, straight = np.array([[0.0, 0.0], [3.0, 4.0], [3.0, 4.5]]), np.array([[0.0, 0.0], [2.0, 0.0]])
    found = ink([(True, bent), (False, straight)], 0.3)
    assert found.total(True) == pytest.approx(5.5) and found.total(False) == pytest.approx(2.0)
    assert found.length.max() <= 0.3
    # The longer side is cut into 17 parts; the first sample is the middle of the first.
    assert found.points[0] == pytest.approx(np.array([0.6, 0.8]) * 5.0 / 17 / 2)


def test_a_line_that_turns_hidden_is_lost_and_gained() -> None:
    stays, turns = np.array([[0.0, 0.0], [10.0, 0.0]]), np.array([[0.0, 5.0], [10.0, 5.0]])
    cut = np.array([4.0, 5.0])
    before = ink([(True, stays), (True, turns)], STEP * ACCURACY)
    after = ink([(True, stays), (True, np.array([turns[0], cut])), (False, np.array([cut, turns[1]]))], STEP * ACCURACY)
    found = change(before, after, ACCURACY)
    # Near the end of the visible line three accuracies are tolerated.
    assert found.lost_visible == pytest.approx(6.0 - NEAR * ACCURACY, abs=ACCURACY)
    # The hidden line begins beneath the ink of the visible one.
    assert found.gained_hidden == pytest.approx(6.0 - COVER * ACCURACY, abs=ACCURACY)
    assert found.under == pytest.approx(COVER * ACCURACY, abs=ACCURACY)
    assert found.gained_visible == found.lost_hidden == 0.0


def test_hidden_ink_beneath_visible_ink_is_told_apart() -> None:
    edge = np.array([[0.0, 0.0], [10.0, 0.0]])
    before = ink([(True, edge), (False, edge + [0.0, 0.2])], STEP * ACCURACY)
    after = ink([(True, edge)], STEP * ACCURACY)
    assert change(before, after, ACCURACY) == Change(0.0, 0.0, 0.0, 0.0, pytest.approx(10.0))
    away = ink([(True, edge), (False, edge + [0.0, 0.3])], STEP * ACCURACY)
    assert change(away, after, ACCURACY) == Change(0.0, 0.0, pytest.approx(10.0), 0.0, 0.0)


def test_a_disturbance_is_as_large_as_asked_and_grows_along_one_way() -> None:
    points = [np.zeros((500, 3)), np.ones((7, 3))]
    small, large = nodes(points, 1e-6, 4), nodes(points, 1e-3, 4)
    for p, a, b in zip(points, small, large, strict=True):
        assert 0.5e-6 < np.abs(a - p).max() <= 1e-6 * (1 + 1e-6)
        assert b - p == pytest.approx((a - p) * 1e3, abs=1e-12)
    assert not np.array_equal(nodes(points, 1e-6, 5)[0], small[0])
    rotation = turn(1e-3, 1.0, 4)
    assert rotation @ rotation.T == pytest.approx(np.eye(3), abs=1e-15)
    assert np.linalg.norm(rotation - np.eye(3), 2) == pytest.approx(2e-3, rel=1e-3)


@pytest.fixture(scope="module")
def two_boxes() -> Model:
    """A large box, and far behind it a small one that stands out above by half: seen from the front."""
    shapes = [cq.Solid.makeBox(60, 10, 40), cq.Solid.makeBox(20, 10, 20, cq.Vector(20, 50, 30))]
    return Model(cq.Workplane(obj=cq.Compound.makeCompound(shapes)), "front", fit=None)


def test_no_disturbance_is_no_change(two_boxes: Model) -> None:
    measure = Measurement(two_boxes, lambda amount, seed: strokes(two_boxes.jiggled(amount, seed)))
    for seed in (0, 1):
        found = measure(0.0, seed)
        assert Change(*(found[name] for name in vars(NOTHING))) == NOTHING
    # At front the large box gives 200 mm; of the small one 40 mm stand out, and 40 mm lie behind.
    assert measure.rest.total(True) == pytest.approx(200.0 + 40.0, abs=0.2)
    assert measure.rest.total(False) == pytest.approx(40.0, abs=0.4)


@pytest.mark.parametrize(
    ("moved", "expected"),
    [
        # Down by 4 mm: of two visible sides 4 mm are no more, two hidden ones grow by it, top and bottom lie elsewhere.
        ((0.0, 0.0, -4.0), (28.0, 20.0, 20.0, 28.0)),
        # Drawn out before the large box: 40 mm turn visible, and 20 mm of the large one's rim turn hidden.
        ((0.0, -80.0, 0.0), (20.0, 40.0, 40.0, 20.0)),
        # Two accuracies are tolerated.
        ((0.0, 0.0, -0.1), (0.0, 0.0, 0.0, 0.0)),
    ],
)
def test_a_part_that_moves_changes_what_geometry_says(
    two_boxes: Model, moved: tuple[float, float, float], expected: tuple[float, float, float, float]
) -> None:
    step = STEP * two_boxes.accuracy
    large, small = two_boxes.points
    before = ink(strokes(two_boxes.drawn([large, small])), step)
    after = ink(strokes(two_boxes.drawn([large, small + np.array(moved)])), step)
    found = change(before, after, two_boxes.accuracy)
    lengths = (found.lost_visible, found.gained_visible, found.lost_hidden, found.gained_hidden)
    # Four ends; at each the width of the visible ink beside it is tolerated.
    slack = 4 * COVER * two_boxes.accuracy if any(expected) else 0.0
    assert lengths == pytest.approx(expected, abs=slack)


def test_curves_take_shares_of_all_that_is_drawn() -> None:
    row = {"drawer": "hlr", "amount": 1e-6, "visible": 60.0, "hidden": 40.0, "lost_visible": 1.0, "gained_visible": 2.0}
    row |= {"lost_hidden": 0.0, "gained_hidden": 0.5}
    rows = [row, row | {"amount": 1e-7}, {"drawer": "hlr", "failure": "no drawing in 1 s"}]
    assert stability_plot.shares(rows, "visible") == {1e-7: [0.03], 1e-6: [0.03]}
    assert stability_plot.shares(rows, "hidden") == {1e-7: [0.005], 1e-6: [0.005]}


@pytest.mark.slow
def test_a_drawer_that_fails_is_a_row(tmp_path: Path) -> None:
    rows = list(stability.measured(tmp_path / "nothing.step", "hlr", 1, 60, 60.0))
    assert len(rows) == 1 and "failure" in rows[0]
    stability.write(tmp_path / "stability.csv", rows)
    assert stability.read(tmp_path / "stability.csv") == rows


def test_a_head_on_a_plate_does_not_depend_on_rounding() -> None:
    plate, head = cq.Solid.makeBox(60, 60, 10), cq.Solid.makeCylinder(10, 6, cq.Vector(30, 30, 10))
    model = Model(cq.Workplane(obj=cq.Compound.makeCompound([plate, head])), fit=None)
    measure = Measurement(model, lambda amount, seed: strokes(model.jiggled(amount, seed)))
    changed = [measure(1e-6, seed) for seed in range(3)]
    assert [(found["lost_visible"], found["gained_visible"]) for found in changed] == [(0.0, 0.0)] * 3
