"""`assert_same_drawing` as users have it: in a run of pytest of its own, with the plugin and its flag."""

import os
import re
import subprocess
import sys
import tomllib
from importlib import import_module
from pathlib import Path

import pytest

from hlr.errors import OptionError
from hlr.testing import assert_same_drawing
from support.drawings import drawing, line

PART = """
from hlr.testing import assert_same_drawing

def tetrahedron(size):
    return [(0, 0, 0), (size, 0, 0), (0, 10, 0), (0, 0, 10)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]

def test_part():
    assert_same_drawing(tetrahedron({size}), "golden/part.svg", view="front", scale=1)
"""


@pytest.fixture
def run(tmp_path):
    """A run of pytest on a test of a part of this size: exit code and text."""

    def run(*arguments, size=20.0):
        test = tmp_path / "tests/test_part.py"
        test.parent.mkdir(exist_ok=True)
        test.write_text(PART.format(size=size))
        command = [sys.executable, "-m", "pytest", "-p", "hlr.testing.plugin", "-q", "-p", "no:cacheprovider"]
        env = {k: v for k, v in os.environ.items() if not k.startswith("PYTEST")}
        done = subprocess.run(
            [*command, f"--basetemp={tmp_path / 'base'}", *arguments, str(test)],
            cwd=tmp_path,
            env=env | {"PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"},
            check=False,
            capture_output=True,
            text=True,
            timeout=120,
        )
        return done.returncode, done.stdout + done.stderr

    return run


@pytest.mark.slow
def test_a_golden_drawing_is_written_kept_and_tells_of_changes(run, tmp_path):
    golden = tmp_path / "tests/golden/part.svg"
    code, text = run()
    assert code == 1 and f"{golden} is not there: pytest --hlr-update writes it" in text
    assert not golden.exists()
    assert run("--hlr-update")[0] == 0
    before = golden.read_bytes()
    assert run()[0] == 0
    code, text = run(size=21.0)
    assert code == 1 and golden.read_bytes() == before
    assert f"differs from {golden}: " in text and "mm new" in text and "visible sharp" in text
    overlay, picture = re.search(r"overlay: (\S+) and (\S+)", text).groups()
    assert Path(overlay).is_relative_to(tmp_path / "base") and "<svg" in Path(overlay).read_text()
    assert Path(picture).read_bytes().startswith(b"\x89PNG")
    assert Path(re.search(r"drawing: (\S+)", text)[1]).read_bytes() != before
    assert "golden.py" not in text, "the traceback ends in the test"
    assert run("--hlr-update", size=21.0)[0] == 0
    assert golden.read_bytes() != before and run(size=21.0)[0] == 0


def test_what_is_no_golden_drawing_is_refused(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    made = drawing([line([[0, 0], [10, 0]])])
    for arguments in ({"golden": "part.pdf"}, {"golden": "a.svg", "view": "front"}, {"golden": "a.svg", "scale": 1}):
        with pytest.raises(OptionError):
            assert_same_drawing(made, **arguments)


def test_a_drawing_where_no_pytest_runs(tmp_path, monkeypatch):
    from hlr.testing import golden, session

    monkeypatch.setattr(golden, "SESSION", session.Session())
    monkeypatch.chdir(tmp_path)
    made = drawing([line([[0, 0], [10, 0]])])
    made.save("a.json")
    assert_same_drawing(made, "a.json")
    assert_same_drawing(drawing([line([[5, 0], [15, 0]])]), "a.json")
    with pytest.raises(AssertionError, match="5 mm gone, 5 mm new"):
        assert_same_drawing(drawing([line([[5, 0], [15, 0]])]), "a.json", register="off")


def test_the_plugin_is_registered_and_light():
    root = Path(__file__).resolve().parents[2]
    with open(root / "pyproject.toml", "rb") as file:
        (module,) = tomllib.load(file)["project"]["entry-points"]["pytest11"].values()
    assert hasattr(import_module(module), "pytest_addoption")
    program = f"import pytest, sys, {module}; print(' '.join(sys.modules))"
    done = subprocess.run([sys.executable, "-P", "-c", program], capture_output=True, text=True, check=True)
    assert not {"numpy", "OCP", "hlr._kernel", "PIL"} & set(done.stdout.split())
