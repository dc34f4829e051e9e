"""The modules of a script's own project are imported anew each time that it is drawn in one process."""

from __future__ import annotations

import multiprocessing
import os
import py_compile
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from hlr.errors import SourceError
from hlr.source import open_source

pytest.importorskip("cadquery")
PARTS = "import cadquery as cq\ndef part():\n    return cq.Workplane().box({}, 1, 1)\n"
SCRIPT = "from parts_of_this_test import part\nresult = part()\n"


def width(path: Path) -> float:
    low, high = open_source(path).bounds()
    return round(float(high[0] - low[0]), 3)


def project(folder: Path, parts: str, script: str = SCRIPT) -> Path:
    folder.mkdir(exist_ok=True)
    (folder / "parts_of_this_test.py").write_text(parts)
    (folder / "model.py").write_text(script)
    return folder / "model.py"


def test_two_projects_with_a_module_of_one_name(tmp_path):
    first = project(tmp_path / "one", PARTS.format(3))
    second = project(tmp_path / "two", PARTS.format(4))
    assert [width(first), width(second), width(first)] == [3, 4, 3]


def test_a_module_that_has_changed(tmp_path):
    path = project(tmp_path, PARTS.format(3))
    assert width(path) == 3
    assert width(project(tmp_path, PARTS.format("30.5"))) == 30.5


def test_a_module_that_shows_by_a_viewer(tmp_path):
    parts = PARTS.format(3) + "from ocp_vscode import show\n"
    path = project(tmp_path, parts, "from parts_of_this_test import part, show\nshow(part())\n")
    assert [width(path), width(path)] == [3, 3]


def test_a_module_inside_a_package(tmp_path):
    (tmp_path / "kit_of_this_test").mkdir()
    (tmp_path / "kit_of_this_test" / "__init__.py").write_text("")
    (tmp_path / "model.py").write_text("from kit_of_this_test.parts import part\nresult = part()\n")
    for size in (3, 45.25):
        (tmp_path / "kit_of_this_test" / "parts.py").write_text(PARTS.format(size))
        assert width(tmp_path / "model.py") == size


@pytest.mark.parametrize(
    ("parts", "script", "sentence"),
    [
        ("def part():\n\n    return 1 / 0\n", SCRIPT, r"^model\.py, line 2 \({}, line 3\): ZeroDivisionError: div"),
        ("\nraise ValueError('thin')\n", SCRIPT, r"^model\.py, line 1 \({}, line 2\): ValueError: thin"),
        ("\n\nx = (\n", SCRIPT, r"^model\.py, line 1 \({}, line 3\): SyntaxError: '\(' was never closed"),
        (PARTS.format("'a'"), SCRIPT, r"^model\.py, line 2 \({}, line 3\): "),  # what fails is CadQuery in it
        (PARTS.format(1), SCRIPT + "x = (\n", r"^model\.py, line 3: SyntaxError: '\(' was never closed"),
        (PARTS.format(1), SCRIPT + "1 / 0\n", r"^model\.py, line 3: ZeroDivisionError: division by zero"),
        (
            "def call(f):\n    return f()\n",
            "from parts_of_this_test import call\ncall(lambda: 1 / 0)\n",
            "line 2: Zero",
        ),
    ],
)
def test_a_failure_names_the_line_of_the_module_that_fails(tmp_path, parts, script, sentence):
    with pytest.raises(SourceError, match=sentence.format(r"parts_of_this_test\.py")):
        width(project(tmp_path, parts, script))


def test_nothing_is_left_also_where_a_script_fails(tmp_path):
    before = set(sys.modules)
    width(project(tmp_path, PARTS.format(3)))
    with pytest.raises(SourceError, match="line 3: ZeroDivisionError"):
        width(project(tmp_path, PARTS.format(3), SCRIPT + "1 / 0\n"))
    assert not {name for name in set(sys.modules) - before if "this_test" in name}


def test_what_the_caller_has_imported_and_what_is_installed_stays(tmp_path, monkeypatch):
    path = project(tmp_path, PARTS.format(3), "import cadquery.occ_impl.exporters.dxf\n" + SCRIPT)
    monkeypatch.syspath_prepend(str(tmp_path))
    import parts_of_this_test

    assert width(path) == 3
    assert sys.modules.pop("parts_of_this_test") is parts_of_this_test
    assert "cadquery.occ_impl.exporters.dxf" in sys.modules


def test_the_caller_may_have_imported_a_module_of_another_project_under_that_name(tmp_path, monkeypatch):
    project(tmp_path / "one", PARTS.format(3))
    second = project(tmp_path / "two", PARTS.format(4))
    monkeypatch.syspath_prepend(str(tmp_path / "one"))
    import parts_of_this_test

    assert width(second) == 4
    assert sys.modules.pop("parts_of_this_test") is parts_of_this_test


def test_folders_that_are_packages_without_a_file_of_their_own(tmp_path):
    for name, size in (("one", 3), ("two", 4), ("one", 3)):
        (tmp_path / name / "folder_of_this_test").mkdir(parents=True, exist_ok=True)
        (tmp_path / name / "folder_of_this_test" / "parts.py").write_text(PARTS.format(size))
        (tmp_path / name / "model.py").write_text("from folder_of_this_test import parts\nresult = parts.part()\n")
        assert width(tmp_path / name / "model.py") == size


def test_modules_that_are_bytecode_alone(tmp_path):
    for name, size in (("one", 3), ("two", 4)):
        path = project(tmp_path / name, PARTS.format(size))
        parts = tmp_path / name / "parts_of_this_test.py"
        py_compile.compile(str(parts), cfile=str(parts.with_suffix(".pyc")))
        parts.unlink()
        assert width(path) == size


def test_a_module_that_changes_within_a_second_and_stays_as_long(tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "dont_write_bytecode", False)
    for size in (3, 4, 5):
        path = project(tmp_path, PARTS.format(size))
        os.utime(tmp_path / "parts_of_this_test.py", (time.time() // 1, time.time() // 1))
        assert width(path) == size


@pytest.mark.parametrize("attribute", ["return self", "raise ImportError(name)"])
def test_objects_among_the_modules_that_take_any_attribute(tmp_path, attribute):
    start = f"import sys\nclass Lazy:\n    def __getattr__(self, name):\n        {attribute}\n"
    start += "sys.modules['lazy_of_this_test'] = Lazy()\n"
    try:
        assert width(project(tmp_path, PARTS.format(3), start + SCRIPT)) == 3
    finally:
        sys.modules.pop("lazy_of_this_test", None)


def test_two_threads_draw_one_script_each(tmp_path):
    wait = "import time\ntime.sleep(0.1)\n"
    paths = [project(tmp_path / str(size), wait + PARTS.format(size), wait + SCRIPT) for size in (3, 4)]
    before = list(sys.path), os.getcwd()
    with ThreadPoolExecutor(2) as pool:
        assert list(pool.map(width, paths * 3)) == [3, 4] * 3
    assert (list(sys.path), os.getcwd()) == before


@pytest.mark.skipif("fork" not in multiprocessing.get_all_start_methods(), reason="needs fork")
def test_a_process_that_is_forked_while_another_thread_draws_draws_as_well(tmp_path):
    wait = "import os, time\nwhile not os.path.exists('end'):\n    time.sleep(0.01)\n"
    slow, other = project(tmp_path / "slow", PARTS.format(3), wait + SCRIPT), project(tmp_path / "one", PARTS.format(4))
    with ThreadPoolExecutor(1) as pool:
        drawn = pool.submit(width, slow)
        try:
            time.sleep(0.5)
            with multiprocessing.get_context("fork").Pool(1) as children:
                assert children.apply_async(width, (other,)).get(20) == 4
        finally:
            (tmp_path / "slow" / "end").touch()
        assert drawn.result() == 3


def test_relative_imports_of_a_script_in_a_package(tmp_path):
    folder = tmp_path / "outer_of_this_test" / "inner"
    folder.mkdir(parents=True)
    for each in (folder, folder.parent):
        (each / "__init__.py").write_text("")
    (folder / "parts.py").write_text(PARTS.format(3))
    (folder.parent / "sizes.py").write_text("size = 2\n")
    (folder / "model.py").write_text("from .parts import part\nfrom ..sizes import size\nresult = part()\n")
    assert width(folder / "model.py") == 3
    (folder.parent / "__init__.py").unlink()
    with pytest.raises(SourceError, match="line 2: ImportError: attempted relative import beyond top-level package"):
        width(folder / "model.py")


def test_an_exception_whose_text_cannot_be_made_is_named(tmp_path):
    text = "class Odd(Exception):\n    def __str__(self):\n        return 1\nraise Odd()\n"
    with pytest.raises(SourceError, match=r"^model\.py, line 4: Odd\.$"):
        width(project(tmp_path, "", text))
