"""The promise at other scales, views and accuracies: a small version of `bench.promise`."""

from pathlib import Path

import pytest
from measure.models import frame, pierced

import hlr
from hlr.lab.measure import measured
from hlr.source import open_source
from support.at_size import ALL_LINES, AT_SIZE

DATA = Path(__file__).parents[1] / "data"


@pytest.mark.slow
def test_an_assembly_of_a_metre_at_1_to_10_keeps_it():
    model = open_source(frame())
    drawing = hlr.draw(model, "iso", scale=0.1, **ALL_LINES)
    reached = measured(model, drawing)
    assert reached.accuracy == 0.05
    assert reached.kept(), reached.as_dict()
    assert reached.edges.count > 50 and reached.outlines.count > 20


@pytest.fixture(scope="module")
def screw():
    model = open_source(DATA / "M6-1x12-countersunk-screw.step")
    return measured(model, hlr.draw(model, "front", scale=5.0, **ALL_LINES))


@pytest.mark.slow
def test_a_screw_at_5_to_1_keeps_it(screw):
    assert screw.accuracy == pytest.approx(0.04, abs=0.002)  # a two-thousandth of so small a drawing
    assert max(screw.edges.worst, screw.outlines.worst, screw.lost.worst) <= screw.accuracy
    assert screw.short.worst >= screw.accuracy


@pytest.mark.slow
def test_the_changes_of_a_screw_keep_it(screw):
    assert screw.changes.worst <= screw.accuracy


@pytest.mark.slow
@pytest.mark.parametrize("accuracy", [0.5, 0.1, 0.01])
@pytest.mark.parametrize("perspective", [None, hlr.Perspective()])
def test_every_accuracy_is_kept(accuracy, perspective):
    model = open_source(pierced())
    drawing = hlr.draw(model, (3, -2, 1.5), accuracy=accuracy, perspective=perspective, **AT_SIZE)
    reached = measured(model, drawing, samples=5000)
    assert reached.kept(), reached.as_dict()
