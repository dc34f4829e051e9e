"""CAD scripts: what they show, and how their errors read."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

from hlr.errors import OptionError, SourceError
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


def test_a_relative_path_means_the_same_file_while_the_script_runs(script, tmp_path, monkeypatch):
    (tmp_path / "sub" / "sub").mkdir(parents=True)
    script(
        CQ + "import sys, pathlib\nassert pathlib.Path(sys.argv[0]).exists()\nshow_object(box, 'this')\n", "sub/a.py"
    )
    script(CQ + "show_object(box, 'another')\n", "sub/sub/a.py")
    monkeypatch.chdir(tmp_path)
    for path in (Path("sub/a.py"), Path("sub/../sub/a.py"), Path("./sub/a.py")):
        assert shown(path) == {"this": None}


def test_the_main_guard_of_a_program_is_not_run_where_a_shape_is_there(script):
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
        ("import sys\nsys.exit(3)\n", "exit code 3, and had shown nothing"),
        (CQ + "result = box\nimport sys\nsys.exit(3)\n", r'exit code 3: its variable "result" may be unfinished, and'),
        (CQ + "import sys\nsys.exit('too\\n thin')\n", r'the message "too thin": its variable "box" may be'),
        ("x = 1\n", "shows nothing"),
        ("result = 'abc'\n", 'The variable "result" of model.py is no shape, but str'),
        ("if __name__ == '__main__':\n    result = 1\n", 'The variable "result" of model.py is no shape, but int'),
        ("show_object(5)\n", "shows something that is no shape"),
        (CQ + "result = box.faces('>Z').workplane()\n", r"shows something without a shape in it \(Workplane\)"),
    ],
)
def test_errors_are_one_sentence(script, text, sentence):
    with pytest.raises(SourceError, match=sentence) as caught:
        open_source(script(text))
    assert "\n" not in str(caught.value)
    assert "Traceback" not in str(caught.value)


def test_leaving_after_showing_is_fine(script):
    assert len(shown(script(CQ + "show_object(box)\nimport sys\nsys.exit(1)\n"))) == 1


def drawn(path, var=None):
    """The extent of what is drawn, and the remark about it."""
    source = open_source(path, var)
    low, high = source.bounds()
    (remark,) = [note for note in source.notes if note.code == "script-shape"]
    assert not remark.is_warning
    return [round(float(x), 3) for x in high - low], remark.text


def test_which_shape_is_drawn_is_defined_and_said(script):
    two = CQ + "big = cq.Workplane().box(9, 9, 9)\n"
    assert drawn(script(two + "show_object(box)\n")) == ([1, 2, 3], "model.py: all that it shows is drawn.")
    assert drawn(script(two + "show_object(box)\nresult = big\nshow_object(big)\n"))[1].endswith("drawn, 2 objects.")
    assert drawn(script(two + "result = box\nlater = big\n")) == (
        [1, 2, 3],
        'model.py: the variable "result" is drawn.',
    )
    size, text = drawn(script(two))
    assert size == [9, 9, 9]
    assert text.startswith('model.py: the variable "big" is drawn, the last solid; show_object(shape), or')


def test_the_last_solid_is_that_which_was_assigned_last(script):
    text = CQ + "big = cq.Workplane().box(9, 9, 9)\nbox = box.translate((1, 1, 1))\n"
    assert drawn(script(text))[1].startswith('model.py: the variable "box" is drawn')


@pytest.mark.parametrize(
    "last",
    [
        "sketch = cq.Sketch().rect(5, 5)",
        "wire = cq.Workplane().rect(5, 5)",
        "plane = box.faces('>Z').workplane()",
        "edges = box.edges()",
        "for face in box.faces().vals(): pass",
        "empty = cq.Workplane()",
    ],
)
def test_a_construction_sketch_is_not_drawn_while_there_are_solids(script, last):
    size, text = drawn(script(CQ + last + "\n"))
    assert size == [1, 2, 3] and '"box" is drawn, the last solid' in text


def test_a_sketch_alone_is_drawn(script):
    size, text = drawn(script("import cadquery as cq\ns = cq.Sketch().rect(5, 4)\nw = cq.Workplane().rect(9, 9)\n"))
    assert size[:2] == [5, 4] and '"s" is drawn, the last face' in text


def test_a_sketch_of_build123d_is_not_drawn_instead_of_the_part(script):
    pytest.importorskip("build123d")
    text = "from build123d import *\nwith BuildPart() as p:\n    with BuildSketch() as s:\n"
    text += "        Rectangle(4, 3)\n    extrude(amount=5)\n"
    size, text = drawn(script(text))
    assert size == [4, 3, 5] and '"p" is drawn' in text


def test_a_variable_may_be_chosen(script):
    from hlr import OptionError

    path = script(CQ + "big = cq.Workplane().box(9, 9, 9)\nshow_object(big)\nwidth = 5\n")
    assert drawn(path, "box") == ([1, 2, 3], 'model.py: the variable "box" is drawn.')
    with pytest.raises(OptionError, match=r'"bax" of model\.py is not there: its shapes are box, big\.'):
        open_source(path, "bax")
    with pytest.raises(OptionError, match=r'"width" of model\.py is no shape'):
        open_source(path, "width")


@pytest.mark.parametrize(
    ("options", "look"),
    [
        ("{'color': cq.Color('red')}", (1, 0, 0, 1)),
        ("{'color': cq.Color(1, 0.5, 0.25, 0.5)}", (1, 0.5, 0.25, 0.5)),
        ("{'color': 'red', 'alpha': 0.25}", (1, 0, 0, 0.75)),
        ("{'color': 'gray50'}", (0.498039, 0.498039, 0.498039, 1)),
        ("{'color': '#0f0'}", (0, 1, 0, 1)),
        ("{'color': (0, 0, 255)}", (0, 0, 1, 1)),
        ("{'color': (0.0, 0.5, 1.0, 0.5)}", (0, 0.5, 1, 0.5)),
        ("{'rgba': (0, 0, 255, 0.4)}", (0, 0, 1, 0.6)),
        ("{'alpha': 0.5}", (0.70, 0.74, 0.79, 0.5)),
        ("{'color': 'no such colour'}", None),
        ("{'color': 'rgb(300, 0, 0)'}", None),
        ("{'color': (-1, 'a', 3)}", None),
        ("{}", None),
    ],
)
def test_colours_and_opacities_are_kept(script, options, look):
    source = open_source(script(CQ + f"show_object(box, 'b', options={options})\n"))
    whole = source.appearances()["b"].whole
    assert whole == (None if look is None else pytest.approx(look, abs=2e-3))


def test_an_assembly_has_the_colour_it_is_shown_in_where_it_has_none(script):
    text = (
        "a = cq.Assembly().add(box, name='own', color=cq.Color(0, 1, 0, 0.5)).add(box, name='none')\n"
        "show_object(a, options={'color': cq.Color('red')})\n"
    )
    looks = open_source(script(CQ + text)).appearances()
    assert looks["own"].whole == (0, 1, 0, 0.5) and looks["none"].whole == (1, 0, 0, 1)


SIZED = """
size = 10
height: float = 2.5
label = "A"
rounded = False
double = 2 * size
def f():
    size = 1
import cadquery as cq
result = cq.Workplane().box(size, double, height if label == "A" else 7)
"""


def sized(path, **parameters):
    source = open_source(path, parameters=parameters)
    low, high = source.bounds()
    return [round(float(x), 6) for x in high - low]


def test_parameters_replace_plain_values_of_a_script(script):
    path = script(SIZED)
    assert sized(path) == [10, 20, 2.5]
    assert sized(path, size=4) == [4, 8, 2.5]
    assert sized(path, size=4.5, height=3, label="B", rounded=True) == [4.5, 9, 7]


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"sise": 3}, "has no parameter sise: did you mean size"),
        ({"double": 3}, "has no parameter double: its parameters are size, height, label, rounded|did you mean"),
        ({"size": "3"}, "the parameter size of model.py is a number, such as 10, not '3'"),
        ({"size": True}, "is a number, such as 10, not True"),
        ({"rounded": 1}, "is True or False, such as False, not 1"),
        ({"label": 1}, "is a text, such as 'A', not 1"),
    ],
)
def test_a_parameter_that_a_script_has_not_is_refused(script, parameters, message):
    with pytest.raises(OptionError, match=message):
        open_source(script(SIZED), parameters=parameters)


def test_only_scripts_have_parameters(tmp_path):
    (tmp_path / "a.off").write_text("OFF")
    with pytest.raises(OptionError, match=r"`parameters` names variables of a script, and a\.off is no script"):
        open_source(tmp_path / "a.off", parameters={"size": 1})
