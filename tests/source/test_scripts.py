"""CAD scripts: what they show, and how their errors read."""

from __future__ import annotations

import os
import sys

import pytest

from hlr.errors import SourceError
from hlr.source import open_source

pytest.importorskip("cadquery")
CQ = "import cadquery as cq\nbox = cq.Workplane().box(1, 2, 3)\n"


@pytest.fixture
def script(tmp_path):
    def write(text, name="model.py"):
        (tmp_path / name).write_text(text)
        return tmp_path / name

    return write


def shown(path):
    source = open_source(path)
    assert source.kind == "script"
    return {part.name: part.color for part in source.mesh(0.1, 0.3).parts}


def test_show_object(script):
    text = CQ + "show_object(box, name='a', options={'color': (255, 0, 0)})\nshow_object(box)\ndebug(box)\n"
    assert shown(script(text)) == {"a": (1.0, 0.0, 0.0), "model": None}
    assert shown(script(CQ + "show_object(box, 'b', {'color': '#00ff00'})\n")) == {"b": (0.0, 1.0, 0.0)}


def test_variables(script):
    assert len(shown(script(CQ + "result = [box, box]\nother = box\n"))) == 2
    assert len(shown(script(CQ + "part = box.translate((9, 0, 0))\n"))) == 1
    assert len(shown(script(CQ + "thing = 5\n"))) == 1


def test_it_runs_in_its_own_folder_and_leaves_no_trace(script, tmp_path):
    script("width = 4\n", "measures_of_this_test.py")
    path = script("from measures_of_this_test import width\n" + CQ + "open('here.txt', 'w').close()\nresult = box\n")
    before = os.getcwd(), list(sys.path), list(sys.argv)
    shown(path)
    assert (os.getcwd(), sys.path, sys.argv) == before
    assert (tmp_path / "here.txt").exists()


def test_the_main_guard_of_a_program_is_not_run(script):
    assert len(shown(script(CQ + "if __name__ == '__main__':\n    raise RuntimeError\n"))) == 1


def test_build123d(script):
    pytest.importorskip("build123d")
    text = "from build123d import *\nwith BuildPart() as p:\n    Box(1, 2, 3)\n    fillet(p.edges(), 0.2)\n"
    assert len(shown(script(text))) == 1


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("x = 1\ny = x / 0\n", r"model\.py, line 2: ZeroDivisionError: division by zero"),
        ("def f():\n    raise ValueError('too\\n thin')\n\nf()\n", r"line 2: ValueError: too thin"),
        ("x = (\n", "line 1: SyntaxError"),
        ("import no_such_module_at_all\n", "line 1: ModuleNotFoundError"),
        ("import sys\nsys.exit(3)\n", "exit code 3"),
        ("x = 1\n", "shows nothing"),
        ("show_object(5)\n", "shows something that is no shape"),
    ],
)
def test_errors_are_one_sentence(script, text, sentence):
    with pytest.raises(SourceError, match=sentence) as caught:
        open_source(script(text))
    assert "\n" not in str(caught.value)
    assert "Traceback" not in str(caught.value)


def test_leaving_after_showing_is_fine(script):
    assert len(shown(script(CQ + "show_object(box)\nimport sys\nsys.exit(1)\n"))) == 1
