"""Folders that may not be read, and names of files that are not UTF-8."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

from hlr.batch.discover import models_under
from hlr.batch.job import Job, failed
from hlr.batch.manifest import find, manifest_of
from hlr.batch.plan import Plan
from hlr.cli.batch_progress import told
from hlr.cli.outputs import plan
from support.models import box

ODD = os.fsdecode(b"\xff\xfe.stl")


@pytest.fixture
def locked(tmp_path, monkeypatch):
    """A folder that nobody may look into, whoever runs the test."""
    folder, stat = tmp_path / "locked", os.stat
    folder.mkdir()

    def refused(path, *more, **named):
        if isinstance(path, str | os.PathLike) and Path(path).parent == folder:
            raise PermissionError(13, "Permission denied", str(path))
        return stat(path, *more, **named)

    monkeypatch.setattr(os, "stat", refused)
    return folder


def test_a_locked_folder_has_nothing_in_it(locked):
    assert plan(None, str(locked / "part.step"), ["front"], "svg") == [Path("part.svg")]
    assert find(locked) is None
    assert list(models_under(locked.parent)) == []


@pytest.mark.skipif(sys.platform != "linux", reason="other systems have no such names")
def test_a_name_that_is_not_utf_8(hlr_real, tmp_path):
    source = tmp_path / "in" / ODD
    source.parent.mkdir()
    box((3.0, 2.0, 1.0)).export(str(source), file_type="stl")
    for arguments in (["draw", source, "-o", "a.png"], ["preview", source, "-o", "b.png"], ["batch", "in"]):
        assert hlr_real(*arguments).code == 0
    assert (tmp_path / "a.png").exists() and (tmp_path / "b.png").exists()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("draw", "", "-o", "a.svg"), "hlr: the name of the source is empty: name a model file.\n"),
        (("info", ""), "hlr: the name of the source is empty: name a model file.\n"),
        (("compare", "", ""), "hlr: the name of a side is empty: name a drawing or a model.\n"),
        (("batch", ""), "hlr: the name of a source is empty: name a folder or models, or leave it out.\n"),
    ],
)
def test_an_empty_name_is_not_the_folder_where_one_is(hlr_real, tmp_path, arguments, message):
    """As an unset variable of a shell gives one."""
    done = hlr_real(*arguments)
    assert (done.code, done.err) == (2, message) and not list(tmp_path.iterdir())


def test_a_name_of_several_lines_stays_in_one(tmp_path):
    job = Job(str(tmp_path), "a\nb.off", ("top",), ("svg",), (("a.svg",),))
    found = told(Plan(manifest_of({}, tmp_path), tmp_path, (job,)), 0, failed("SourceError", "no"))
    assert found == "a\\nb.off: failed: no"
