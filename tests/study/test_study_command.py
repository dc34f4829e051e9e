"""`hlr study`: its files, failures in sentences, refused options, and what Ctrl-C leaves."""

import contextlib
import csv
import os
import signal
import subprocess
import sys
import time

import pytest

from hlr.errors import OptionError
from hlr.lab.study import plot, report, table
from hlr.lab.study.job import HLR, Cost, Job, Point
from hlr.lab.study.process import answer
from hlr.lab.study.sweep import Scope, Study, study

BOX = """solid box
{}endsolid box
"""
CORNERS = [(x, y, z) for x in (0, 40) for y in (0, 30) for z in (0, 20)]
QUADS = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))


@pytest.fixture
def box(tmp_path):
    facets = ""
    for quad in QUADS:
        for three in ((0, 1, 2), (0, 2, 3)):
            vertices = "".join(f"vertex {x} {y} {z}\n" for x, y, z in (CORNERS[quad[k]] for k in three))
            facets += f"facet normal 0 0 0\nouter loop\n{vertices}endloop\nendfacet\n"
    path = tmp_path / "box.stl"
    path.write_text(BOX.format(facets))
    return path


def command(*arguments):
    return [sys.executable, "-P", "-m", "hlr", "study", *map(str, arguments)]


@pytest.mark.slow
def test_files_and_figures(box, tmp_path):
    folder = tmp_path / "out" / "figures"
    wishes = (
        "--accuracy",
        "200",
        "--accuracy",
        "0.5",
        "--pixels",
        "64",
        "--runs",
        "1",
        "--no-reached",
        "--limit",
        "99",
    )
    done = subprocess.run(command(box, "-o", folder, *wishes), check=False, capture_output=True, text=True, timeout=120)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    names = ["arithmetic.csv", "error.png", "stages.png", "study.csv", "study.md"]
    assert sorted(path.name for path in folder.iterdir()) == names
    rows = {(row["who"], row["setting"]): row for row in csv.DictReader((folder / "study.csv").open())}
    assert "too coarse" in rows["hlr", "200"]["failure"]
    assert "mesh" in rows["OCCT exact", "0"]["failure"]
    ours, pixels = rows["hlr", "0.5"], rows["z-buffer", "64"]
    assert ours["lines"] == "12" and float(ours["ink_worst"]) < 0.5 and float(ours["wall_s"]) > 0
    assert float(pixels["ink_p99"]) < 277 / 64 * 2 and float(pixels["mb"]) > 1
    text = (folder / "study.md").read_text()
    assert "too coarse" in text and "What there is not" in text and "exact" in text
    kinds = list(csv.DictReader((folder / "arithmetic.csv").open()))
    assert [k["arithmetic"] for k in kinds] == ["exact", "f64", "f32"]
    assert (folder / "error.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["no.stl", "-o", "out"], "does not exist"),
        (["box.stl"], "--output"),
        (["box.stl", "-o", "box.stl"], "not a folder"),
        (["box.stl", "-o", "out", "--scale", "1:2", "--fit", "20x20"], "contradict"),
        (["box.stl", "-o", "out", "--runs", "0"], "runs"),
        (["text.step", "-o", "out"], "cannot be studied"),
        (("box.stl", "-o", "out", "--accuracy", "nan"), "'nan' is not a number"),
        (("box.stl", "-o", "out", "--accuracy", "inf"), "'inf' is not a number"),
        (("box.stl", "-o", "out", "--accuracy", "1e-15", "--no-rivals", "--runs", "1"), "is too fine for a drawing"),
    ],
)
def test_refusals(box, tmp_path, arguments, words):
    (tmp_path / "text.step").write_text("no model")
    done = subprocess.run(command(*arguments), check=False, capture_output=True, text=True, cwd=tmp_path, timeout=120)
    assert done.returncode == 2 and done.stdout == ""
    assert done.stderr.count("\n") == 1 and words in done.stderr
    assert sorted(path.name for path in tmp_path.iterdir()) == ["box.stl", "text.step"]


COST = Cost(1.0, 1.0, 1.0)
LOOK = {"name": "box", "scale": 1.0, "width": 9.0, "height": 9.0, "parts": 1, "notes": []}


@pytest.mark.slow
def test_a_stopped_study_keeps_what_is_finished(box, tmp_path, monkeypatch):
    from hlr.cli.commands.study import study as verb
    from hlr.cli.signals import Stopped
    from hlr.lab.study import sweep

    def fake(job):
        if job.work == "look":
            return LOOK
        if job.work == HLR and job.setting == 0.5:
            return Point(HLR, 0.5, 0.5, stages={"source": COST, "visibility": COST}, counts={"lines": 12}).as_dict()
        raise Stopped(signal.SIGINT)

    monkeypatch.setattr(sweep, "answer", fake)
    folder = tmp_path / "figures"
    with pytest.raises(Stopped):
        verb.main([str(box), "-o", str(folder), "--accuracy", "0.5", "--accuracy", "0.1"], standalone_mode=False)
    assert "was stopped" in (folder / "study.md").read_text()
    rows = list(csv.DictReader((folder / "study.csv").open()))
    assert [(row["setting"], row["lines"]) for row in rows] == [("0.5", "12")]


@pytest.mark.skipif(not hasattr(os, "fork"), reason="signals end processes differently here")
def test_ctrl_c_ends_it_at_once_and_its_processes_with_it(box, tmp_path):
    child = subprocess.Popen(
        command(box, "-o", tmp_path / "figures", "--runs", "999"), stderr=subprocess.DEVNULL, start_new_session=True
    )
    try:
        time.sleep(2.0)
        child.send_signal(signal.SIGINT)
        assert child.wait(timeout=30) == -signal.SIGINT
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(child.pid, signal.SIGKILL)


def test_a_point_that_takes_too_long_says_so(box):
    # No process starts in so short a time, on the fastest machine.
    found = answer(Job("look", str(box), setting=0.1, limit=0.0001))
    assert found == {"failure": "not finished in 0.002 s by the clock"}


def test_finer_points_are_not_tried_after_one_that_took_too_long(box, monkeypatch):
    from hlr.lab.study import sweep

    asked = []

    def fake(job):
        asked.append((job.work, job.setting))
        if job.work == "look":
            return LOOK
        if job.work == HLR and job.setting > 0.2:
            return Point(HLR, job.setting, job.setting, stages=dict.fromkeys(("source", "scene"), COST)).as_dict()
        return {"failure": f"not finished in {job.limit:g} s"}

    monkeypatch.setattr(sweep, "answer", fake)
    found = study(str(box), scope=Scope((0.5, 0.2, 0.1), (), (), rivals=False, reached=False), limit=7, runs=1)
    assert [p.failure for p in found.points] == [None, "not finished in 7 s", "not tried: 0.2 was not finished"]
    assert (HLR, 0.1) not in asked and found.truth is None and "could not be drawn" in found.notes[0]
    assert "not tried: 0.2" in report.markdown(found)


def test_without_matplotlib_one_sentence_names_the_extra(monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with pytest.raises(OptionError, match=r"hlr-drawing\[plot\]"):
        plot.available()


def test_a_study_needs_time(box):
    with pytest.raises(OptionError, match="positive limit"):
        study(str(box), limit=0.0)


@pytest.mark.slow
def test_the_frontier_is_marked():
    points = [
        Point(
            HLR,
            a,
            a,
            stages={"source": Cost(1.0, 1.0, 9.0), "visibility": Cost(t, t, 9.0)},
            errors={"ink_p99": e, "wrong": 0.0},
            counts={"lines": 3},
        )
        for a, t, e in ((0.5, 1.0, 0.1), (0.05, 3.0, 0.01), (0.02, 4.0, 0.02))
    ]
    found = Study("box.stl", "iso", 60.0, 1, look=LOOK, truth=0.01, points=points, finished=True)
    text = report.markdown(found)
    assert "hlr, 0.5 mm * |" in text and "hlr, 0.05 mm * |" in text and "hlr, 0.02 mm |" in text
    again = table.points_of(table.comma_separated(found))
    assert [(p.who, p.setting, p.processor, p.errors) for p in again] == [
        (p.who, p.setting, p.processor, p.errors) for p in points
    ]
    for picture in (plot.error_plot(again, "box"), plot.stage_plot(again, "box")):
        assert picture.startswith(b"\x89PNG")
