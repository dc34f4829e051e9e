"""A script is a module that Python finds: its dataclasses are made, its objects are pickled, and it finds itself."""

from __future__ import annotations

import sys

import pytest

from hlr.errors import SourceError
from hlr.source import open_source

pytest.importorskip("cadquery")
NAME = "__cq_main__"


@pytest.fixture
def width(tmp_path):
    """How long what a script draws is in X. The script has a function `box`."""

    def of(text):
        lines = text.splitlines(keepends=True)
        future = [line for line in lines if "__future__" in line]
        rest = [line for line in lines if "__future__" not in line]
        start = "import cadquery as cq\ndef box(size):\n    return cq.Workplane().box(size, 1, 1)\n"
        (tmp_path / "model.py").write_text("".join([*future, start, *rest]))
        low, high = open_source(tmp_path / "model.py").bounds()
        return round(float(high[0] - low[0]), 3)

    return of


DATA = """
from dataclasses import dataclass, field
from typing import ClassVar
@dataclass
class Plate:
    wall: ClassVar[float] = 2.0
    length: float = 5.0
    holes: list[float] = field(default_factory=list)
result = box(Plate().length)
"""


@pytest.mark.parametrize("future", ["", "from __future__ import annotations\n"])
def test_dataclasses(width, future):
    assert width(future + DATA) == 5


def test_annotations_are_what_the_script_says_and_no_texts(width):
    text = "import inspect\nclass Size(float):\n    pass\ndef part(size: Size):\n    return box(size)\n"
    text += "kind = inspect.signature(part).parameters['size'].annotation\nresult = part(kind(4))\n"
    assert width(text) == 4


def test_objects_of_a_script_are_pickled_and_copied(width):
    text = "import copy, pickle\nclass Size:\n    def __init__(self):\n        self.length = 6\n"
    assert width(text + "result = box(copy.deepcopy(pickle.loads(pickle.dumps(Size()))).length)\n") == 6


def test_a_script_finds_itself(width):
    text = "import sys, typing\nlength = 1\nme = sys.modules[__name__]\nme.length = 7\nme.other = 1\ndel me.other\n"
    text += "assert vars(me) is globals() and not hasattr(me, 'other') and 'other' not in globals()\n"
    text += "try:\n    del me.other\nexcept AttributeError:\n    pass\n"
    assert width(text + "result = box(length)\n") == 7


@pytest.mark.parametrize("end", ["result = box(1)\n", "raise ValueError\n"])
def test_what_was_there_under_its_name_is_there_again(width, monkeypatch, end):
    for before in (None, object()):
        if before is not None:
            monkeypatch.setitem(sys.modules, NAME, before)
        try:
            width(end)
        except SourceError:
            assert "raise" in end
        assert sys.modules.get(NAME) is before
