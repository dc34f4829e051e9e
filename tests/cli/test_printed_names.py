"""Names out of files do not control the terminal: what cannot be printed is escaped, in all that people read."""

import io
import json
import re
import sys
from pathlib import Path

import numpy as np
import pytest
import trimesh

from hlr import cli
from hlr.cli.streams import show_path
from hlr.common.printable import printable

NAME = "bolt\x1b[2J\x07\n\u202e"
"""It clears the screen, rings the bell, begins a line of its own, and writes from right to left."""

SHOWN = r"bolt\x1b[2J\x07\n\u202e"

FILE = "a\x1b[2Jb\nc"

posix = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such names of files")


@pytest.fixture(autouse=True)
def models(tmp_path):
    """A box without its lid, with that name, and files of such names."""
    box = trimesh.creation.box((10, 20, 30))
    box.update_faces(np.arange(len(box.faces)) > 0)
    scene = trimesh.Scene()
    scene.add_geometry(box, node_name=NAME, geom_name=NAME)
    (tmp_path / "open.glb").write_bytes(scene.export(file_type="glb"))
    if sys.platform != "win32":
        (tmp_path / "in").mkdir()
        (tmp_path / f"in/{FILE}.off").write_text(box.export(file_type="off"))
        (tmp_path / f"in/{FILE}2.off").write_text("no model")


def harmless(text):
    return all(c == "\n" or c.isprintable() for c in text)


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("plain", "plain"),
        (NAME, SHOWN),
        ("größe 5 \\ 厚さ", "größe 5 \\ 厚さ"),
        ("\x9b\udcff\t\r", r"\x9b\udcff\t\r"),
        ("", ""),
    ],
)
def test_what_cannot_be_printed_is_escaped_as_by_repr(text, shown):
    assert printable(text) == shown


@pytest.mark.parametrize(
    "arguments",
    [
        ["info"],
        ["draw", "-o", "a.svg"],
        ["draw", "-o", "a.svg", "--strict"],
        ["plan", "--only", f"{NAME}2"],
        ["preview", "-o", "a.png", "--size", "90x90", "--strict"],
    ],
)
def test_names_of_parts(hlr_real, arguments):
    verb, *others = arguments
    done = hlr_real(verb, "open.glb", *others)
    assert harmless(done.out) and harmless(done.err)
    assert r"bolt\x1b[2J\x07" in done.out + done.err


def test_a_name_is_one_cell_of_a_table(hlr_real):
    rows = hlr_real("info", "open.glb").out.splitlines()
    assert rows[3].startswith(f"{SHOWN}  ") and len(rows) == 4


def test_json_has_the_name_as_it_is(hlr_real):
    (part,) = json.loads(hlr_real("info", "open.glb", "--json").out)["parts"]
    assert part["name"] == NAME
    done = hlr_real("draw", "open.glb", "-o", "a.svg", "--strict", "--json")
    assert NAME[:9] in json.loads(done.out)["error"]["message"] and harmless(done.err)


@posix
@pytest.mark.parametrize(
    "arguments",
    [
        ["info", f"in/{FILE}.off"],
        ["draw", f"in/{FILE}.off", "-o", "a.svg", "--report", "--explain"],
        ["draw", f"in/{FILE}2.off", "-o", "a.svg"],
        ["draw", "open.glb", "-o", f"no/{FILE}.svg"],
        ["compare", f"in/{FILE}.off", f"in/{FILE}2.off"],
        ["batch", "in", "-o", "out"],
        ["batch", "in", "-o", "out", "--dry-run"],
        ["batch", f"in/{FILE}.off", "-o", f"in/{FILE}"],
    ],
)
def test_names_of_files(hlr_real, arguments):
    done = hlr_real(*arguments)
    assert harmless(done.out) and harmless(done.err)
    assert r"a\x1b[2Jb" in done.out + done.err


@posix
def test_the_comparison_of_two_drawings(hlr_real):
    for view in ("front", "top"):
        assert hlr_real("draw", "open.glb", "-o", f"in/{FILE}{view}.svg", "--view", view).code == 0
    done = hlr_real("compare", f"in/{FILE}front.svg", f"in/{FILE}top.svg")
    assert done.code == 1 and harmless(done.out)
    assert "bolt\ufffd[2J\ufffd\\n\\u202e" in done.out  # SVG has no control characters


@posix
@pytest.mark.slow
def test_the_methods_side_by_side(hlr_real):
    done = hlr_real("methods", f"in/{FILE}.off", "--size", "32x32", "--method", "ray casting, flat")
    assert done.code == 0 and harmless(done.out) and r"a\x1b[2Jb\nc" in done.out


@posix
def test_the_folder_of_the_cache(hlr_real, monkeypatch, tmp_path):
    monkeypatch.setenv("HLR_CACHE", str(tmp_path / FILE))
    for verb in ("info", "clear"):
        done = hlr_real("cache", verb)
        assert harmless(done.out) and r"a\x1b[2Jb\nc" in done.out


@posix
def test_the_line_about_what_is_written(on_terminal):
    shown, code = on_terminal("draw", "a.step", "-o", "b\x1b[31m.svg")
    assert code == 0 and r"b\x1b[31m.svg" in shown and "\x1b[31m" not in shown


@posix
def test_a_list_of_files_is_exact_for_programs_and_escaped_for_people(hlr_real, tmp_path, monkeypatch):
    done = hlr_real("batch", f"in/{FILE}.off", "-o", "out", "--view", "top", "--format", "svg", "--list")
    assert done.out == f"{tmp_path}/out/in/{FILE}-top.svg\n"
    terminal = io.StringIO()
    terminal.isatty = lambda: True
    monkeypatch.setattr(sys, "stdout", terminal)
    show_path(Path(FILE))
    assert terminal.getvalue() == r"a\x1b[2Jb\nc" + "\n"


def test_nothing_is_printed_past_the_functions_that_escape():
    past = re.compile(r"click\.(echo|secho)\(|(?<!console\.)\bprint\(|sys\.std(out|err)\.write")
    root = Path(cli.__file__).parent
    found = [path.name for path in root.rglob("*.py") if past.search(path.read_text("utf-8"))]
    assert found == ["streams.py"]
