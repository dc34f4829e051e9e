"""The finest drawing that fits into a time. What decides is tested on a clock of its own, without waiting."""

import contextlib
import os
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import pytest

import hlr
from hlr import Options
from hlr.errors import OptionError
from hlr.pipeline import within
from hlr.pipeline.session import Session
from hlr.source import open_source
from support.at_size import AT_SIZE

DATA = Path(__file__).parents[1] / "data"
AS1 = DATA / "as1-oc-214.stp"


class World:
    """A pipeline whose passes take a known time."""

    def __init__(self, monkeypatch, cost, stop_at=None, meshing=0.5):
        self.now, self.asked = 0.0, []
        cheap = hlr.draw(box(), "iso", accuracy=0.5, **AT_SIZE)

        def drawn(opened, views, options, progress, noted=None):
            accuracy = options.accuracy
            self.asked.append(accuracy)
            if accuracy == stop_at:
                raise KeyboardInterrupt
            took = cost(accuracy)
            timings = {"tessellate": meshing * took, "scene": 0.2 * took, "total": took}
            for stage, share in (("tessellate", 0.0), ("scene", meshing), ("visibility", 0.2), (None, 0.8 - meshing)):
                self.now += share * took
                if progress is not None and stage is not None:
                    progress(stage, 0.0)
            used = replace(cheap.accuracy, used=accuracy, asked=accuracy)
            return [replace(cheap, accuracy=used, timings=timings) for _ in views]

        monkeypatch.setattr(within, "draw_views", drawn)
        monkeypatch.setattr(within, "perf_counter", lambda: self.now)

    def draw(self, seconds, **options):
        finished = []
        (drawing,) = within.draw_within(
            box(), ["iso"], Options(within=seconds, **AT_SIZE | options), None, finished.append
        )
        assert finished[-1] == [drawing]
        return drawing


def box():
    import cadquery as cq

    return cq.Workplane("XY").box(100, 80, 60)


def linear(seconds):
    """Time of a pass that grows as fast as the drawing gets finer; so long at 0.5 mm."""
    return lambda accuracy: seconds * 0.5 / accuracy


def test_it_refines_while_time_lasts(monkeypatch):
    world = World(monkeypatch, linear(0.1))
    drawing = world.draw(10.0)
    assert world.asked[0] == 0.5
    assert world.asked == sorted(world.asked, reverse=True)
    assert drawing.accuracy.used == world.asked[-1] <= 0.02
    assert drawing.accuracy.asked is None and drawing.accuracy.within == 10.0
    assert world.now <= 10.0
    assert not drawing.notes


@pytest.mark.parametrize("power", [0.5, 1.0, 1.5, 2.5])
@pytest.mark.parametrize("budget", [0.3, 1.0, 3.0, 30.0])
def test_the_time_is_kept_whatever_the_growth(monkeypatch, power, budget):
    world = World(monkeypatch, lambda accuracy: 0.1 * (0.5 / accuracy) ** power)
    world.draw(budget)
    assert world.now <= 1.1 * budget


def test_a_pass_that_takes_longer_than_foreseen_is_given_up(monkeypatch):
    world = World(monkeypatch, lambda accuracy: 0.1 if accuracy > 0.3 else 100.0)
    drawing = world.draw(2.0)
    assert len(world.asked) == 2
    assert drawing.accuracy.used == 0.5


def test_a_first_stage_of_next_to_nothing_tells_nothing(monkeypatch):
    """That of a mesh takes a moment, now a shorter, now a longer one."""
    world = World(monkeypatch, linear(0.1), meshing=1e-4)
    tick = within.draw_views

    def slow_to_begin(opened, views, options, progress, noted=None):
        def late(stage, done):
            world.now += 0.01 if stage == "scene" else 0.0
            progress(stage, done)

        return tick(opened, views, options, late if progress is not None else None)

    monkeypatch.setattr(within, "draw_views", slow_to_begin)
    assert world.draw(10.0).accuracy.used <= 0.02


def test_it_is_not_refined_beyond_the_accuracy(monkeypatch):
    world = World(monkeypatch, linear(0.001))
    assert world.draw(1000.0, accuracy=0.03).accuracy.used == 0.03
    assert world.asked[-1] == 0.03
    assert world.now < 1.0


def test_the_excess_is_stated(monkeypatch):
    world = World(monkeypatch, linear(5.0))
    drawing = world.draw(2.0)
    assert world.asked == [0.5]
    (note,) = drawing.notes
    assert note.text.startswith("3.0 s over the 2 s") and note.text.endswith("of 0.5 mm, 5.0 s")


def test_what_reading_took_counts_and_is_said(monkeypatch):
    """The command hands over when it was started; a caller of `hlr.draw` has the file opened within the time."""
    world = World(monkeypatch, linear(0.5))
    world.now = 4.0
    (drawing,) = within.draw_within(box(), ["iso"], Options(within=3.0), started=0.0)
    assert world.asked == [0.5]
    (note,) = drawing.notes
    assert (
        note.text.startswith("1.5 s over the 3 s")
        and "reading the model, which cannot be cut short, took 4.0 s" in note.text
    )


@pytest.mark.parametrize("scale", [1.0, 30.0, 1000.0])
def test_the_first_drawing_is_bounded_by_its_size_on_paper(monkeypatch, scale):
    """No more steps of the accuracy across the model than on an A4 sheet, however large the drawing is."""
    world = World(monkeypatch, lambda _: 1e-6)
    world.draw(1.0, scale=scale)
    (placement,) = Session(open_source(box()), ["iso"], Options(scale=scale)).placements
    across = placement.diagonal
    assert 100 * scale < across < 200 * scale
    assert across / world.asked[0] <= within.FIRST_SIZE * (1 + 1e-9)
    assert world.asked[0] == pytest.approx(max(0.5, across / within.FIRST_SIZE))
    # Then down the ladder, as far as ever on a sheet of this size.
    assert world.asked == sorted(set(world.asked), reverse=True)
    assert world.asked[-1] == pytest.approx(within.FINEST * 0.05)


def test_a_large_view_beside_a_small_one_does_not_make_that_a_blot():
    """A long bar from its end: an accuracy for the side view alone would be larger than the end."""
    bar = open_source(box().faces(">X").workplane().rect(20, 20).extrude(100_000))
    first, _ = within._range(bar, ["left", "front"], Options(scale=1.0, within=1.0))
    assert first == pytest.approx(1.0)


def test_the_ladder_has_accuracies_as_people_name_them():
    assert within._rungs(0.5, 0.002) == [0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2]
    assert within._rungs(57.3, 3.0) == [3.0, 5.0, 10.0, 20.0, 50.0]
    assert within._rungs(0.03, 0.03) == [0.03]


def test_what_is_finished_survives_an_interruption(monkeypatch):
    drawing = World(monkeypatch, linear(0.01), stop_at=0.1).draw(100.0)
    assert drawing.accuracy.used == 0.5
    with pytest.raises(KeyboardInterrupt):
        World(monkeypatch, linear(0.01), stop_at=0.5).draw(100.0)


def test_the_result_is_that_of_its_accuracy():
    drawing = hlr.draw(box(), "iso", within=60.0, accuracy=0.1, **AT_SIZE)
    plain = hlr.draw(box(), "iso", accuracy=0.1, **AT_SIZE)
    assert [x.points.tolist() for x in drawing.lines] == [x.points.tolist() for x in plain.lines]


def test_the_model_is_read_once(monkeypatch):
    from hlr.public import draw as drawings

    opened = []
    monkeypatch.setattr(drawings, "open_selected", lambda s, _: opened.append(s) or open_source(s))
    hlr.draw(box(), within=30.0, accuracy=0.2, **AT_SIZE)
    assert len(opened) == 1


@pytest.mark.parametrize("seconds", [0.0, -1.0, float("nan"), "soon"])
def test_no_time_is_refused(seconds):
    with pytest.raises(OptionError, match="seconds"):
        hlr.draw(box(), within=seconds, **AT_SIZE)


def command(*arguments):
    code = "from hlr.cli import main; main()"
    return [sys.executable, "-P", "-c", code, "draw", str(AS1), "--fit", "5000x4000", *arguments]


@pytest.fixture
def started():
    """Start the command in a group of its own; what still runs of it after the test is killed."""
    processes = []

    def start(*arguments):
        processes.append(subprocess.Popen(command(*arguments), start_new_session=True))
        return processes[-1]

    yield start
    for process in processes:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="signals")
def test_after_ctrl_c_the_finished_drawing_is_there(started, tmp_path):
    target = tmp_path / "a.svg"
    running = started("-o", str(target), "--within", "10min")
    end = time.monotonic() + 120.0
    while not target.exists() and time.monotonic() < end:
        assert running.poll() is None
        time.sleep(0.02)
    os.killpg(running.pid, signal.SIGINT)
    assert running.wait(30.0) in (-signal.SIGINT, 130)
    assert target.read_text().endswith("</svg>\n")
    assert [p.name for p in tmp_path.iterdir()] == ["a.svg"]


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="signals")
def test_before_the_first_drawing_ctrl_c_writes_nothing(started, tmp_path):
    target = tmp_path / "a.svg"
    running = started("-o", str(target), "--within", "10min")
    time.sleep(0.3)
    os.killpg(running.pid, signal.SIGINT)
    running.wait(30.0)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_standard_output_gets_one_drawing():
    done = subprocess.run(
        command("-o", "-", "--within", "60s", "--accuracy", "0.2"), capture_output=True, text=True, check=True
    )
    assert done.stdout.count("<svg") == 1 and done.stdout.endswith("</svg>\n")
    assert 'accuracy="0.2"' in done.stdout
