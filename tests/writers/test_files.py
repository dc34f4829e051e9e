import errno
import os
import re
import stat
import threading
from pathlib import Path

import pytest

from hlr.drawing import files
from hlr.drawing.drawing import timed
from hlr.drawing.saving import format_of, render, write
from hlr.errors import WriteError
from hlr.tables.writers import formats
from support.drawings import drawing, sample


@pytest.mark.parametrize(
    ("name", "start"), [("a.svg", b"<?xml"), ("a.PDF", b"%PDF-1.7"), ("a.json", b'{"format": "hlr-drawing"')]
)
def test_the_ending_chooses_the_format(tmp_path, name, start):
    path = write(sample(), tmp_path / name)
    assert path == tmp_path / name
    assert path.read_bytes().startswith(start)
    assert [entry.name for entry in tmp_path.iterdir()] == [name]


def test_a_drawing_saves_itself(tmp_path):
    assert sample().save(str(tmp_path / "a.svg")).exists()


@pytest.mark.parametrize("name", ["a.dwg", "a", "a.svg.gz", ".svg"])
def test_an_unknown_ending_is_refused(tmp_path, name):
    with pytest.raises(WriteError, match=re.escape(f"use {formats('.')}.")):
        write(sample(), tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_an_unknown_format_is_refused():
    with pytest.raises(WriteError, match="dwg"):
        render(sample(), "dwg")


def test_the_time_of_writing_is_counted_once():
    made = timed(timed(drawing([], timings={"total": 1.0}), 0.5), 0.25)
    assert made.timings == {"total": 1.25, "write": 0.25}


def test_a_missing_folder_is_named(tmp_path):
    with pytest.raises(WriteError, match=r"the folder .*none does not exist"):
        write(sample(), tmp_path / "none" / "a.svg")


def test_a_folder_in_the_way_is_named(tmp_path):
    (tmp_path / "a.svg").mkdir()
    with pytest.raises(WriteError, match="it is a folder"):
        write(sample(), tmp_path / "a.svg")


def test_a_file_in_place_of_the_folder_is_named(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(WriteError, match="is not a folder"):
        write(sample(), tmp_path / "file" / "a.svg")


@pytest.mark.parametrize("failing", ["write", "rename"])
def test_a_full_disk_leaves_the_earlier_files(tmp_path, monkeypatch, failing):
    first, second = tmp_path / "1.svg", tmp_path / "2.svg"
    first.write_text("old 1")

    def full(*args, **kwargs):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    if failing == "write":
        # The first file is already complete when the second one fails.
        real = files._write
        monkeypatch.setattr(files, "_write", lambda file, data: (real if data == b"new 1" else full)(file, data))
    else:
        monkeypatch.setattr(files.os, "replace", full)
    with pytest.raises(WriteError, match=r"cannot write .*: no space left on device"):
        files.write_all({first: b"new 1", second: b"new 2"})
    assert [entry.name for entry in tmp_path.iterdir()] == ["1.svg"]
    assert first.read_text() == "old 1"


def test_no_permission_is_said(tmp_path, monkeypatch):
    monkeypatch.setattr(files.os, "access", lambda path, mode: False)
    with pytest.raises(WriteError, match="no permission to write into the folder"):
        write(sample(), tmp_path / "a.svg")
    (tmp_path / "a.svg").write_text("old")
    with pytest.raises(WriteError, match="write-protected"):
        write(sample(), tmp_path / "a.svg")
    assert (tmp_path / "a.svg").read_text() == "old"


def test_a_file_is_not_replaced_in_a_folder_that_cannot_be_written_into(tmp_path, monkeypatch):
    (tmp_path / "real").mkdir()
    (tmp_path / "real/a.svg").write_text("old")
    (tmp_path / "a.svg").symlink_to(tmp_path / "real/a.svg")
    monkeypatch.setattr(files.os, "access", lambda path, mode: Path(path) != tmp_path / "real")
    for path in (tmp_path / "real/a.svg", tmp_path / "a.svg"):
        with pytest.raises(WriteError, match=r"no permission to write into the folder .*real\.$"):
            files.check_writable(path)
    assert files.check_writable(Path(os.devnull)) is not None


def test_a_link_that_leads_nowhere_is_no_folder(tmp_path):
    (tmp_path / "link").symlink_to(tmp_path / "nothing")
    for folder in (tmp_path / "link", tmp_path / "link/sub"):
        with pytest.raises(WriteError, match=r"cannot write into .*: .*/link is not a folder"):
            files.write_all({}, [folder])


def test_a_bug_while_rendering_leaves_nothing(tmp_path, monkeypatch):
    from hlr.drawing import saving

    monkeypatch.setattr(saving, "render", lambda *args: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        write(sample(), tmp_path / "a.svg")
    assert list(tmp_path.iterdir()) == []


def test_the_mode_of_an_earlier_file_is_kept(tmp_path):
    path = tmp_path / "a.svg"
    path.write_text("old")
    path.chmod(0o640)
    write(sample(), path)
    assert stat.S_IMODE(path.stat().st_mode) == 0o640


def test_a_new_file_has_the_usual_mode(tmp_path):
    (tmp_path / "usual").write_text("")
    path = write(sample(), tmp_path / "a.svg")
    assert path.stat().st_mode == (tmp_path / "usual").stat().st_mode


def test_a_link_stays_a_link(tmp_path):
    real, link = tmp_path / "real.svg", tmp_path / "link.svg"
    real.write_text("old")
    link.symlink_to(real)
    write(sample(), link)
    assert link.is_symlink()
    assert real.read_bytes().startswith(b"<?xml")


def test_a_pipe_is_written_to_and_not_replaced(tmp_path):
    path = tmp_path / "pipe.svg"
    os.mkfifo(path)
    read = []
    reader = threading.Thread(target=lambda: read.append(path.read_bytes()))
    reader.start()
    write(sample(), path)
    reader.join(10)
    assert read[0].startswith(b"<?xml")
    assert stat.S_ISFIFO(path.stat().st_mode)


def test_a_long_name_leaves_room_for_the_temporary_one(tmp_path):
    assert write(sample(), tmp_path / ("x" * 250 + ".svg")).exists()


def test_formats_by_name():
    assert [format_of(name) for name in ("a.svg", "b/c.Json")] == ["svg", "json"]
