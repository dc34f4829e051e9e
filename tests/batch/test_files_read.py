"""What a script reads beside its modules: its drawing is made again when that changes."""

import json
import os
import sys
from pathlib import Path

import pytest

from hlr.batch.carry_out import carry_out
from hlr.batch.files_read import FilesRead, recording
from hlr.batch.kept import Kept
from hlr.batch.keys import Digests
from hlr.batch.manifest import manifest_of
from hlr.batch.plan import plan
from hlr.cache.store import DRAWINGS, Store


def noted(folder, work):
    """What is read in a folder while this works."""
    found = FilesRead([folder], lambda path: "packages" in path.parts)
    with recording(found):
        work()
    return found


def test_files_that_are_read_count_and_those_that_are_written_do_not(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("a.json", "b.txt", "log.txt", "gone.txt", "packages/c.txt"):
        Path(name).parent.mkdir(exist_ok=True)
        Path(name).write_text("1")

    def work():
        json.loads(Path("a.json").read_bytes())
        os.close(os.open("b.txt", os.O_RDONLY))
        for name in ("log.txt", "packages/c.txt", "gone.txt", __file__):
            Path(name).read_text()
        with open("log.txt", "a") as file:
            file.write("2")
        Path("gone.txt").unlink()
        Path("new.txt").write_text("3")
        Path("new.txt").read_text()

    assert noted(tmp_path, work).files == [tmp_path / "a.json", tmp_path / "b.txt"]
    assert noted(tmp_path, lambda: None).files == []
    Path("a.json").read_text()  # nobody notes it any more


def test_modules_that_are_not_there_are_noted_with_the_places_where_they_would_be(tmp_path, monkeypatch):
    script = tmp_path / "part.py"
    script.write_text("try:\n    import no_settings\nexcept ImportError:\n    pass\n")
    installed = tmp_path / "packages/lib.py"
    monkeypatch.setattr(sys, "path", [str(tmp_path), *sys.path])
    code = script.read_text()
    missed = noted(tmp_path, lambda: exec(compile(code, str(script), "exec"), {})).missed
    assert missed[:2] == [tmp_path / "no_settings.py", tmp_path / "no_settings/__init__.py"]
    of_package = noted(tmp_path, lambda: exec(compile(code, str(installed), "exec"), {})).missed
    assert of_package == [], "what a package tries to import is its own affair"


def test_files_that_are_not_there_are_noted(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def work():
        for name in ("settings.json", "packages/a.json", str(tmp_path.parent / "elsewhere.json")):
            with pytest.raises(FileNotFoundError):
                Path(name).read_text()

    found = noted(tmp_path, work)
    assert (found.files, found.missed) == ([], [tmp_path / "settings.json"])


def test_a_file_that_gets_its_name_when_it_is_whole_was_written(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def work():
        Path("new.tmp").write_text("1")
        os.replace("new.tmp", "new.json")
        Path("new.json").read_text()

    found = noted(tmp_path, work)
    assert (found.files, found.missed) == ([], [])


def test_what_no_file_can_be_called_is_left_out(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("loop").symlink_to("loop")

    def work():
        for name in ("x" * 5000, "loop"):
            with pytest.raises(OSError):
                Path(name).read_text()

    found = noted(tmp_path, work)
    assert (found.files, found.missed) == ([], [])


SCRIPT = """
import importlib.util, json, pathlib
import cadquery as cq
try:
    from settings import width
except ImportError:
    width = 10
here = pathlib.Path(__file__).parent
spec = importlib.util.spec_from_file_location("named", here / "named.py")
named = importlib.util.module_from_spec(spec)
spec.loader.exec_module(named)
(here / "log.txt").open("a").write("drawn")
screw = cq.importers.importStep(str(here / "screw.step"))
result = cq.Workplane().box(width, json.loads((here / "data.json").read_text()), named.height).add(screw)
"""


@pytest.mark.slow
def test_a_script_is_drawn_again_when_what_it_reads_changes(tmp_path):
    cq = pytest.importorskip("cadquery")
    models = tmp_path / "models"
    models.mkdir()

    def put(name, text):
        (models / name).write_text(text)
        old(models / name)

    def old(path):
        os.utime(path, (1e9, 1e9))  # what is changed within a run is not kept

    put("part.py", SCRIPT)
    put("named.py", "height = 5\n")
    put("data.json", "20")
    cq.exporters.export(cq.Workplane().box(1, 2, 3), str(models / "screw.step"))
    old(models / "screw.step")
    (job,) = plan(manifest_of({"files": "part.py", "views": "top"}, models), tmp_path / "out").jobs
    store = Store(tmp_path / "cache", 10**9, DRAWINGS)

    def is_unchanged():
        """Whether the script is unchanged; it is drawn where it is not."""
        kept = Kept(store, Digests())
        if kept.find(job) is not None:
            return True
        outcome = carry_out(job)
        assert outcome.failure is None and outcome.depends[0] == "data.json" and "log.txt" not in outcome.depends
        kept.keep(job, outcome)
        return False

    assert [is_unchanged(), is_unchanged()] == [False, True]
    screw = (models / "screw.step").read_text()
    for name, text in (
        ("data.json", "30"),
        ("named.py", "height = 6\n"),
        ("settings.py", "width = 11\n"),
        ("screw.step", screw.replace("Open CASCADE", "open cascade")),
    ):
        put(name, text)
        assert [is_unchanged(), is_unchanged()] == [False, True], name
    (models / "settings.py").unlink()
    assert [is_unchanged(), is_unchanged()] == [False, True]
