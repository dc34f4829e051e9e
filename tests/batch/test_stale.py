"""Drawings of earlier runs that the batch draws no more are named, and removed only where that is asked for."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest
from batch.models import tetrahedron

from hlr.batch.manifest import manifest_of
from hlr.batch.plan import Plan, plan
from hlr.batch.stale import earlier, remove, told


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("HLR_CACHE", str(tmp_path / "cache"))
    models = tmp_path / "models"
    (models / "sub").mkdir(parents=True)
    monkeypatch.chdir(models)
    for number, name in enumerate(("a", "sub/b", "sub/c")):
        tetrahedron(models / f"{name}.off", number + 1)
    return models


def run(*arguments):
    line = [sys.executable, "-P", "-m", "hlr", "batch", "-j", "1", "--view", "front", *arguments]
    done = subprocess.run(line, check=False, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return done.stderr


def failed(*arguments):
    line = [sys.executable, "-P", "-m", "hlr", "batch", "-j", "1", "--view", "front", *arguments]
    done = subprocess.run(line, check=False, capture_output=True, text=True, timeout=120)
    assert done.returncode == 2, done.stderr
    return done.stderr


def report(folder):
    return json.loads((folder / "drawings/manifest.json").read_text())


@pytest.mark.slow
def test_they_are_named_until_they_are_removed(folder):
    assert "stay" not in run()
    assert (report(folder)["folder"], report(folder)["stale"]) == ("..", [])
    (folder / "sub/b.off").unlink()
    drawing = folder / "drawings/sub/b-front.svg"
    for _ in range(2):
        why = "stays though the batch draws it no more: sub/b-front.svg; --prune removes it."
        assert f"1 drawing in {folder / 'drawings'} {why}" in run() and drawing.exists()
        assert report(folder)["stale"] == [{"file": "sub/b-front.svg", "source": "sub/b.off"}]
        assert "| sub/b-front.svg | sub/b.off |" in (folder / "drawings/summary.md").read_text()
    assert "1 stale drawing removed." in run("--prune") and not drawing.exists()
    assert report(folder)["stale"] == [] and (folder / "drawings/sub/c-front.svg").exists()
    assert "stale" not in run("--prune")


@pytest.mark.slow
def test_where_all_models_are_gone_their_drawings_can_be_removed(folder):
    run()
    for model in folder.rglob("*.off"):
        model.unlink()
    assert failed() == f"hlr: there is no model under {folder}.\n"
    assert failed("*.off").startswith("hlr: *.off names no model")
    assert len(list((folder / "drawings").rglob("*.svg"))) == 3
    run("--prune", "--dry-run")
    assert len(list((folder / "drawings").rglob("*.svg"))) == 3
    assert "3 stale drawings removed." in run("--prune")
    assert list((folder / "drawings").rglob("*.svg")) == [] and report(folder)["sources"] == []
    assert failed("--prune") == f"hlr: there is no model under {folder}.\n"


@pytest.mark.slow
def test_one_pattern_without_a_model_is_refused_all_the_same(folder):
    run()
    (folder / "a.off").unlink()
    (folder / "hlr.toml").write_text('[[source]]\nfiles = "*.off"\n[[source]]\nfiles = "sub/*.off"\n')
    assert "*.off names no model under" in failed("--prune")


@pytest.mark.slow
def test_a_run_of_some_sources_calls_no_other_stale(folder):
    run()
    assert "stay" not in run("a.off", "-o", "drawings")
    assert len(list((folder / "drawings").rglob("*.svg"))) == 3


def planned(folder, *names) -> Plan:
    """A plan of what lies in a folder. names: files of an earlier run, by their source, which is gone."""
    output = folder / "drawings"
    output.mkdir()
    rows = [{"source": "old.off", "drawings": [{"files": {"svg": name}} for name in names]}]
    found = {"folder": "..", "stale": [], "sources": rows}
    (output / "manifest.json").write_text(json.dumps(found))
    return plan(manifest_of({"views": ["front"]}, folder), output)


def test_only_drawings_inside_the_folder_count(folder):
    names = ("x.svg", "../y.svg", "notes.txt", "link.svg", "missing.svg", "a-front.svg", str(folder / "z.svg"))
    asked = planned(folder, *names)
    for name in ("x.svg", "notes.txt", "a-front.svg", "../y.svg", "../z.svg"):
        (folder / "drawings" / name).write_text("")
    (folder / "drawings/link.svg").symlink_to(folder / "y.svg")
    rows = earlier(asked).stale
    assert rows == [{"file": "x.svg", "source": "old.off"}]
    assert remove(rows, asked.output) == [] and remove(rows, asked.output) == rows
    assert (folder / "y.svg").exists() and (folder / "drawings/a-front.svg").exists()


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"folder": null, "stale": [], "sources": []}', "[" * 100_000])
def test_a_broken_report_has_none(folder, text):
    asked = planned(folder, "x.svg")
    (folder / "drawings/x.svg").write_text("")
    (folder / "drawings/manifest.json").write_text(text)
    assert earlier(asked).stale == []


@pytest.mark.slow
def test_a_section_that_is_asked_for_no_more_is_stale(folder):
    def drawn(section, *more):
        (folder / "hlr.toml").write_text(f'formats = ["json"]\n{section}')
        return run(*more)

    drawn('section = { front = true }\nwhole = ["front"]')
    output = folder / "drawings"
    (output / "a-front-B.json").write_text("{}")
    (folder / "sub/c.off").unlink()
    names = ("a-front-A.json", "sub/b-front-A.json", "sub/c-front-A.json", "sub/c-front.json")
    for _ in range(2):
        assert f"stay though the batch draws them no more: {', '.join(names)}; --prune removes them." in drawn("")
    assert report(folder)["stale"] == [{"file": name, "source": f"{name.split('-')[0]}.off"} for name in names]
    assert "4 stale drawings removed." in drawn("", "--prune") and report(folder)["stale"] == []
    left = {path.relative_to(output).as_posix() for path in output.rglob("*-front*.json")}
    assert left == {"a-front.json", "a-front-B.json", "sub/b-front.json"}


def test_a_source_that_is_there_keeps_its_drawings_unless_it_is_drawn(folder):
    asked = planned(folder, "old-top.svg")
    (folder / "drawings/old-top.svg").write_text("")
    tetrahedron(folder / "old.off", 1)
    assert earlier(asked).stale == []
    assert earlier(plan(manifest_of({"views": ["front"]}, folder), asked.output)).stale == [
        {"file": "old-top.svg", "source": "old.off"}
    ]


def test_of_many_some_are_named(tmp_path):
    rows = [{"file": f"{i}.svg", "source": "a.off"} for i in range(7)]
    assert told(rows, tmp_path) == (
        f"7 drawings in {tmp_path} stay though the batch draws them no more: 0.svg, 1.svg, 2.svg, 3.svg, 4.svg "
        "and 2 more; --prune removes them"
    )


@pytest.mark.slow
def test_a_part_of_a_batch_removes_no_views_and_forgets_none(folder):
    """A run of one source, and then one of some views, know of all drawings afterwards."""
    (folder / "hlr.toml").write_text('views = ["front", "top"]')
    whole = [sys.executable, "-P", "-m", "hlr", "batch", "-j", "1"]

    def drawn(*more):
        done = subprocess.run([*whole, *more], check=True, capture_output=True, text=True, timeout=120)
        return done.stdout + done.stderr

    drawn()
    drawings = folder / "drawings"
    assert len(list(drawings.rglob("*.svg"))) == 6
    said = drawn("a.off", "--view", "top", "--prune")
    assert "1 drawing of sources drawn here is not removed, though not drawn here (a-front.svg)" in said
    names = ("a-front.svg", *(f"sub/{name}-{view}.svg" for name in "bc" for view in ("front", "top")))
    assert tuple(row["file"] for row in report(folder)["others"]) == names and report(folder)["stale"] == []
    assert "removed" not in drawn("--view", "top", "--prune")
    assert [row["file"] for row in report(folder)["others"]] == [
        f"{name}-front.svg" for name in ("a", "sub/b", "sub/c")
    ]
    assert len(list(drawings.rglob("*.svg"))) == 6
    (folder / "sub/c.off").unlink()
    drawn("a.off")
    (folder / "hlr.toml").write_text('views = ["top"]')
    gone = ("a-front.svg", "a-iso.svg", "a-right.svg", "sub/b-front.svg", "sub/c-front.svg", "sub/c-top.svg")
    assert "".join(f"to remove  {name}\n" for name in gone) in drawn("--dry-run", "--prune")
    assert "6 stale drawings removed." in drawn("--prune")
    assert sorted(path.name for path in drawings.rglob("*.svg")) == ["a-top.svg", "b-top.svg"]
    assert report(folder)["others"] == report(folder)["stale"] == []


def test_drawings_of_a_source_that_fails_are_known_to_the_next_run(folder):
    asked = planned(folder, "a-front.svg", "old-top.svg")
    for name in ("a-front.svg", "old-top.svg"):
        (folder / "drawings" / name).write_text("")
    found = earlier(asked, ["a-front.svg"])
    assert [row["file"] for row in found.stale] == ["old-top.svg"]
    assert [row["file"] for row in found.others] == ["a-front.svg"]


def test_views_that_the_manifest_names_stay_when_the_command_line_names_others(folder):
    asked = planned(folder, "a-front.svg", "a-top.svg", "a-left.svg")
    report = json.loads((asked.output / "manifest.json").read_text())
    report["sources"][0]["source"] = "a.off"
    (asked.output / "manifest.json").write_text(json.dumps(report))
    for view in ("front", "top", "left"):
        (folder / f"drawings/a-{view}.svg").write_text("")
    usual = plan(manifest_of({"views": ["front", "top"]}, folder), asked.output)
    found = earlier(asked, usual=usual)
    assert [row["file"] for row in found.stale] == ["a-left.svg"]
    assert [row["file"] for row in found.others] == ["a-top.svg"] and not found.spared
    found = earlier(asked, is_part=True)
    assert not found.stale and [row["file"] for row in found.spared] == ["a-left.svg", "a-top.svg"]


def test_sources_are_named_from_the_folder_of_the_new_report(folder):
    asked = planned(folder, "x.svg")
    (folder / "drawings/x.svg").write_text("")
    inside = plan(manifest_of({"views": ["front"]}, folder / "sub"), asked.output)
    assert earlier(inside).stale == [{"file": "x.svg", "source": "../old.off"}]
