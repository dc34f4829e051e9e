"""Runs on a pool that draws nothing: what is drawn again, what is written, and what the report says."""

import json
import os
import random
import time
from pathlib import Path

import pytest
from batch import reports
from batch.models import FakePool, Silent, tetrahedron

from hlr.batch import markdown
from hlr.batch.kept import Kept
from hlr.batch.keys import Digests
from hlr.batch.manifest import manifest_of
from hlr.batch.plan import plan
from hlr.batch.report import write
from hlr.batch.run import run, tidy
from hlr.cache.store import DRAWINGS, Store
from hlr.drawing import files
from hlr.errors import OptionError, WriteError


@pytest.fixture
def go(tmp_path):
    """Run a batch over the folder's models: its report, and the titles of what was drawn."""

    def go(pool=None, environment=None, cache=tmp_path / "cache", output="out", **found):
        pool = pool or FakePool()
        digests = Digests()
        asked = plan(manifest_of({"exclude": ["cache"], **found}, tmp_path), tmp_path / output)
        done = run(asked, Kept(Store(cache, 10**9, DRAWINGS), digests), pool, Silent())
        return write(done, digests, environment or {}), sorted(pool.asked)

    for name in ("a.off", "b.off", "bad.off", "sub/c.off"):
        tetrahedron(tmp_path / name, size=len(name))
    return go


def times(folder):
    return {path: path.stat().st_mtime_ns for path in folder.rglob("*") if path.is_file()}


def old(folder):
    """Make all files an hour old: what is changed within a run is not kept."""
    for path in folder.rglob("*.*"):
        os.utime(path, (path.stat().st_atime, path.stat().st_mtime - 3600))


def test_what_is_unchanged_is_left_alone(go, tmp_path):
    old(tmp_path)
    report, drawn = go()
    assert drawn == ["a.off", "b.off", "bad.off", "sub/c.off"] and report["counts"]["failed"] == 1
    before = times(tmp_path / "out")
    assert go()[1] == ["bad.off"]
    assert times(tmp_path / "out") == before, "nothing was written, the report included"


def test_what_has_changed_is_drawn_again(go, tmp_path):
    old(tmp_path)
    go()
    tetrahedron(tmp_path / "a.off", size=99)
    old(tmp_path)
    assert go()[1] == ["a.off", "bad.off"]
    assert go(scale=2.0)[1] == ["a.off", "b.off", "bad.off", "sub/c.off"]
    assert go(threads=3)[1] == ["bad.off"], "the number of threads changes no drawing"
    assert go(formats=["pdf"])[1] == ["a.off", "b.off", "bad.off", "sub/c.off"]


def test_when_the_time_of_the_batch_is_up_the_next_run_goes_on(go, tmp_path):
    old(tmp_path)

    def slow(numbers):
        yield numbers[0]
        time.sleep(0.3)
        yield from numbers[1:]

    report, asked = go(FakePool(order=slow), total_time_limit_s=0.2)
    drawn, *left = report["sources"]
    assert (drawn["source"], drawn["state"]) == ("a.off", "drawn") and (tmp_path / "out/a-iso.svg").is_file()
    assert len(left) == report["counts"]["failed"] == 3
    for source in left:
        assert source["error"] == {
            "kind": "TotalTimeLimit",
            "message": f"{source['source']} is not drawn: the batch has taken its 0.2 s; run it again to go on, or "
            "raise total_time_limit_s (--total-time-limit).",
        }
    slowest = (tmp_path / "out/summary.md").read_text("utf-8").partition("## Slowest")[2]
    assert "| a.off | 0.00 |" in slowest and "b.off" not in slowest, "those that were not begun took no time"
    report, asked = go(total_time_limit_s=60.0)
    assert asked == ["b.off", "bad.off", "sub/c.off"] and report["counts"]["failed"] == 1


def test_a_folder_that_cannot_be_written_into_is_refused_before_any_work(go, tmp_path, monkeypatch):
    old(tmp_path)
    (tmp_path / "out").mkdir()
    monkeypatch.setattr(files.os, "access", lambda path, mode: Path(path) != tmp_path / "out")
    pool = FakePool()
    with pytest.raises(WriteError, match=r"manifest\.json: no permission to write into the folder"):
        go(pool)
    assert pool.asked == [] and list((tmp_path / "out").iterdir()) == []


@pytest.mark.parametrize(
    ("there", "words"),
    [
        ("page", "page/data.js: .*page is not a folder"),
        ("index.html/a", "index.html: it is a folder; give a file name"),
        ("junit.xml/a", "junit.xml: it is a folder; give a file name"),
    ],
)
def test_what_is_in_the_place_of_the_report_is_told_before_any_work(go, tmp_path, there, words):
    path = tmp_path / "out" / there
    path.parent.mkdir(parents=True)
    path.write_text("")
    pool = FakePool()
    with pytest.raises(WriteError, match=words):
        go(pool)
    assert pool.asked == []


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs a named pipe")
def test_a_pipe_among_the_models_is_not_waited_for(go, tmp_path):
    os.mkfifo(tmp_path / "pipe.off")
    os.mkfifo(tmp_path / "pipe.py")
    report, asked = go()
    assert "pipe.off" in asked and "pipe.py" not in asked
    (pipe,) = [source for source in report["sources"] if source["source"] == "pipe.off"]
    assert pipe["sha256"] is None


def test_what_a_source_pulls_in_counts(go, tmp_path):
    (tmp_path / "lib.py").write_text("1")
    (tmp_path / "table.csv").write_text("1")
    old(tmp_path)
    wishes = {"files": ["a.off"], "depends": ["table.csv"]}
    go(FakePool(depends=("lib.py",)), **wishes)
    assert go(**wishes)[1] == []
    for name in ("lib.py", "table.csv"):
        (tmp_path / name).write_text("2")
        old(tmp_path)
        assert go(FakePool(depends=("lib.py",)), **wishes)[1] == ["a.off"]
        assert go(**wishes)[1] == []
    (tmp_path / "lib.py").unlink()
    assert go(**wishes)[1] == ["a.off"]


def test_a_file_that_an_option_names_counts(go, tmp_path):
    look = tmp_path / "look.toml"
    look.write_text('background = "none"\n')
    old(tmp_path)
    wishes = {"files": ["a.off"], "style": "look.toml"}
    go(**wishes)
    assert go(**wishes)[1] == []
    look.write_text('background = "white"\n')
    old(tmp_path)
    assert go(**wishes)[1] == ["a.off"]


def test_what_changes_while_it_is_drawn_is_drawn_again(go, tmp_path):
    old(tmp_path)

    class Changing(FakePool):
        def run(self, jobs, *limits):
            tetrahedron(tmp_path / "a.off", size=50)
            yield from super().run(jobs, *limits)

    first = (tmp_path / "a.off").read_text()
    go(Changing(), files=["a.off"])
    # What was drawn is not kept as the drawing of what the file was before.
    (tmp_path / "a.off").write_text(first)
    old(tmp_path)
    assert go(files=["a.off"])[1] == ["a.off"]


def test_lost_and_damaged_files_come_back_without_drawing(go, tmp_path):
    old(tmp_path)
    go(files=["a.off"])
    first, second = tmp_path / "out/a-top.svg", tmp_path / "out/a-iso.svg"
    content = first.read_bytes()
    first.unlink()
    second.write_text("half")
    assert go(files=["a.off"])[1] == [] and first.read_bytes() == content
    assert second.read_text() == "drawn a-iso.svg"
    for entry in (tmp_path / "cache").iterdir():
        entry.write_bytes(entry.read_bytes()[:-1])
    assert go(files=["a.off"])[1] == ["a.off"]


def test_the_order_of_ending_changes_no_byte(go, tmp_path):
    def shuffled(numbers):
        random.Random(7).shuffle(numbers)
        return numbers

    go(FakePool(), cache=tmp_path / "cache/1", output="one")
    go(FakePool(shuffled), cache=tmp_path / "cache/2", output="other", exclude=["cache", "one"])
    one, other = ({p.name: p.read_bytes() for p in (tmp_path / o).rglob("*.*")} for o in ("one", "other"))
    assert one == other and "manifest.json" in one


def test_a_full_disk_costs_its_drawing_alone(go, tmp_path, monkeypatch):
    write_file = files._write

    def full(file, data):
        if data == b"drawn b-top.svg":
            raise OSError(28, "No space left on device")
        write_file(file, data)

    monkeypatch.setattr(files, "_write", full)
    report, _ = go()
    states = {source["source"]: source["state"] for source in report["sources"]}
    assert states == {"a.off": "drawn", "b.off": "failed", "bad.off": "failed", "sub/c.off": "drawn"}
    assert "no space left" in report["sources"][1]["error"]["message"]
    assert not [path for path in (tmp_path / "out").rglob("*") if path.name.startswith((".", "b-"))]
    monkeypatch.undo()
    assert "b.off" in go()[1]


def test_a_full_disk_for_what_is_unchanged_is_told(tmp_path, monkeypatch):
    tetrahedron(tmp_path / "a.off")
    tetrahedron(tmp_path / "b.off")
    old(tmp_path)
    asked = plan(manifest_of({"views": "top"}, tmp_path), tmp_path / "out")

    def go():
        listener, digests = Silent(), Digests()
        done = run(asked, Kept(Store(tmp_path / "cache", 10**9, DRAWINGS), digests), FakePool(), listener)
        return listener, done

    go()
    (tmp_path / "out/a-top.svg").unlink()

    def full(file, data):
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(files, "_write", full)
        listener, done = go()
    assert listener.todo == ["a.off"] and listener.told == [0], "the failure is told"
    assert done.drawn == (0,) and done.outcomes[0].failure is not None and done.outcomes[1].failure is None
    assert go()[1].drawn == ()


def test_options_are_refused_before_anything_is_drawn(go, tmp_path):
    pool = FakePool()
    with pytest.raises(OptionError, match="crease 200 is not a crease angle"):
        go(pool, crease=200)
    assert pool.asked == [] and not (tmp_path / "out").exists()


def test_the_memory_of_a_source_that_was_ended_is_unknown():
    ended = reports.source("ended.py", error="It was ended.")
    whole = reports.source("a.off", reports.drawing("a.svg"))
    ended["cost"] = {"seconds": 9.0, "peak_memory_mb": 0.0}
    slowest = markdown.document(reports.report(ended, whole)).decode().partition("## Slowest")[2]
    assert "| ended.py | 9.00 | unknown |\n| a.off | 0.50 | 1 |" in slowest


def test_the_report_says_all_there_is(go, tmp_path):
    note = {"code": "defects", "text": "It <b>is</b> | open.", "warning": True}
    report, _ = go(FakePool(notes=[note]), {"GITLAB_CI": "true"}, views=["iso"], formats=["svg", "pdf"])
    assert json.loads((tmp_path / "out/manifest.json").read_text()) == json.loads(json.dumps(report))
    assert report["counts"] == {"sources": 4, "drawings": 3, "failed": 1, "warned": 3}
    first = report["sources"][0]
    assert first["drawings"][0]["files"] == {"svg": "a-iso.svg", "pdf": "a-iso.pdf"} and first["state"] == "warned"
    summary = (tmp_path / "out/summary.md").read_text()
    assert "3 drawings of 4 sources, 1 failed, 3 with warnings." in summary
    assert "| a.off | It &lt;b>is&lt;/b> \\| open. |" in summary
    from junitparser import JUnitXml

    (suite,) = JUnitXml.fromfile(str(tmp_path / "out/junit.xml"))
    assert (suite.tests, suite.errors) == (4, 1)
    quality = json.loads((tmp_path / "out/code-quality.json").read_text())
    assert [(row["location"]["path"], row["severity"]) for row in quality][:3] == [
        ("a.off", "minor"), ("b.off", "minor"), ("bad.off", "major")
    ]  # fmt: skip


def test_leftovers_of_killed_runs_are_removed_when_they_are_old(tmp_path):
    names = {".a.svg.01234567.tmp": 4000, ".b.svg.01234567.tmp": 10, "c.tmp": 4000}
    for name, age in names.items():
        (tmp_path / name).touch()
        os.utime(tmp_path / name, (0, os.stat(tmp_path / name).st_mtime - age))
    tidy(tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == [".b.svg.01234567.tmp", "c.tmp"]
