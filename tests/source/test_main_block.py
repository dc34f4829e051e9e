"""What stands under `if __name__ == "__main__":` is run where nothing is there to draw, or where it shows something."""

from __future__ import annotations

import sys

import pytest

from hlr.errors import SourceError
from hlr.source import open_source

pytest.importorskip("cadquery")
MAIN = "if __name__ == '__main__':\n"
BOX = "import cadquery as cq\ndef box(size=1):\n    return cq.Workplane().box(size, size, size)\n"


@pytest.fixture
def size(tmp_path):
    """How long what a script draws is in X."""

    def of(text, **parameters):
        (tmp_path / "model.py").write_text(text)
        low, high = open_source(tmp_path / "model.py", parameters=parameters or None).bounds()
        return round(float(high[0] - low[0]), 3)

    return of


@pytest.mark.parametrize(
    "block",
    [
        "from ocp_vscode import show\ndef main():\n    show(box(3))\n" + MAIN + "    main()\n",
        "if '__main__' == __name__:\n    show_object(box(3))\n",
        MAIN + "    part = box(3)\n",
        "if __name__ == '__cq_main__':\n    pass\nelif __name__ == '__main__':\n    result = box(3)\n",
        "import sys\n" + MAIN + "    assert __name__ == '__main__' and len(sys.argv) == 1\n    result = box(3)\n",
        "size = 1\n" + MAIN + "    size += 2\n    result = box(size)\n",
    ],
)
def test_it_is_run_where_nothing_is_there_to_draw(size, block):
    assert size(BOX + block) == 3


@pytest.mark.parametrize("call", ["show(box(3))", "ocp_vscode.show(box(3))", "show_object(box(3), 'a')"])
def test_it_is_run_where_it_shows_something_and_nothing_is_shown_or_called_result(size, call):
    block = MAIN + f"    import ocp_vscode\n    {call}\n"
    assert size(BOX + "stock = box(1)\n" + block) == 3
    assert size(BOX + "result = box(1)\n" + block) == 1
    assert size(BOX + "show_object(box(1))\n" + block) == 1


def test_it_is_not_run_where_it_only_exports_what_is_there(size, tmp_path):
    block = MAIN + "    cq.exporters.export(part, 'part.step')\n"
    assert size(BOX + "part = box(1)\n" + block) == 1
    assert not (tmp_path / "part.step").exists()


@pytest.mark.parametrize(
    "call",
    [
        "import matplotlib.pyplot as plt\n    plt.show()",
        "from matplotlib.pyplot import show\n    show()",
        "window = open('ran', 'w')\n    window.show()",
    ],
)
def test_it_is_not_run_where_it_shows_a_window_of_another_library(size, tmp_path, call):
    assert size(BOX + "part = box(1)\n" + MAIN + f"    open('ran', 'w').close()\n    {call}\n") == 1
    assert not (tmp_path / "ran").exists()


def test_it_is_run_where_it_shows_by_a_module_of_the_project_or_of_a_package(size, tmp_path):
    (tmp_path / "shows_of_this_test.py").write_text("from ocp_vscode import show\n")
    for start in ("from shows_of_this_test import show", "from cadquery.vis import show", "from cadquery import vis"):
        call = "vis.show" if start.endswith("vis") else "show"
        assert size(BOX + f"{start}\nstock = box(1)\n{MAIN}    {call}(box(3))\n") == 3


def test_it_is_not_run_where_the_variable_that_is_asked_for_is_there(tmp_path):
    path = tmp_path / "model.py"
    path.write_text(BOX + "part = box(1)\n" + MAIN + "    open('ran', 'w').close()\n    show(part)\n")
    open_source(path, var="part")
    assert not (tmp_path / "ran").exists()


def test_it_finds_itself_as_the_module_main(size):
    data = "    from dataclasses import dataclass\n    from typing import ClassVar, get_type_hints\n    @dataclass\n"
    data += "    class Size:\n        kind: ClassVar[int] = 1\n        length: int = 3\n"
    data += "    import __main__, pickle\n    length = pickle.loads(pickle.dumps(Size())).length\n"
    data += "    assert get_type_hints(Size)['length'] is int and __main__.length == 3\n    show(box(length))\n"
    before = sys.modules["__main__"]
    assert size("from __future__ import annotations\n" + BOX + MAIN + data) == 3
    assert sys.modules["__main__"] is before


def test_what_it_sees_is_the_rest_of_the_script_and_its_parameters(size):
    text = "from __future__ import annotations\n" + BOX + "width = 2\n" + MAIN + "    show_object(box(width))\n"
    assert size(text) == 2
    assert size(text, width=5) == 5


def test_its_errors_name_their_line(size):
    with pytest.raises(SourceError, match=r"^model\.py, line 5: ValueError: too thin"):
        size(BOX + MAIN + "    raise ValueError('too thin')\n")
    with pytest.raises(SourceError, match="left with exit code 3, and had shown nothing"):
        size(BOX + MAIN + "    raise SystemExit(3)\n")
    with pytest.raises(SourceError, match=r"shows nothing: call show_object\(shape\)"):
        size(BOX + MAIN + "    print(1)\n")
