"""A script may share its work out to processes, which find its functions however they are started."""

from __future__ import annotations

import multiprocessing

import pytest

from hlr.source import open_source

pytest.importorskip("cadquery")
WORK = """
import multiprocessing
import cadquery as cq
from ocp_vscode import show
from dataclasses import dataclass
size = 1
@dataclass
class Plate:
    length: float
def plate(number):
    return Plate(number * size)
def shared():
    with multiprocessing.get_context("METHOD").Pool(2) as pool:
        return pool.map_async(plate, [1, 2]).get(30)
"""


def width(path, text, method):
    path.write_text(WORK.replace("METHOD", method) + text)
    low, high = open_source(path, parameters={"size": 5}).bounds()
    return round(float(high[0] - low[0]), 3)


@pytest.mark.parametrize("method", multiprocessing.get_all_start_methods())
def test_processes_find_the_functions_of_a_script_and_its_parameters(tmp_path, method):
    text = (
        "def main():\n    show(cq.Workplane().box(shared()[1].length, 1, 1))\nif __name__ == '__main__':\n    main()\n"
    )
    assert width(tmp_path / "model.py", text, method) == 10


def test_also_where_the_work_is_shared_out_as_the_script_is_run(tmp_path):
    text = "show_object(cq.Workplane().box(shared()[1].length, 1, 1))\n"
    assert width(tmp_path / "model.py", text, "spawn") == 10
