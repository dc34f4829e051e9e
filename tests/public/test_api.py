"""The package's face: what it names, what it loads, and what a type checker refuses."""

import inspect
import os
import re
import subprocess
import sys
from dataclasses import fields
from importlib import import_module
from pathlib import Path
from typing import get_args, get_type_hints

import pytest

import hlr
from hlr.compare.reading.choice import Choice
from hlr.request.directions import NAMED
from hlr.request.options import Chosen, Options, ViewName, Wishes
from hlr.request.picture_effects import PreviewOptions, PreviewWishes
from support.models import box

BOX = box((10, 20, 30))


def test_all_public_names_are_listed_and_there():
    assert set(hlr.__all__) <= set(dir(hlr)) and {"draw", "load", "methods", "study", "surfaces"} <= set(dir(hlr))
    for name in hlr.__all__:
        assert getattr(hlr, name) is not None
    assert hlr.__all__ == sorted(hlr.__all__)
    assert callable(hlr.methods) and callable(hlr.lab.study.study) and "study" in dir(hlr.lab.study)
    with pytest.raises(AttributeError, match="no attribute 'darw'"):
        _ = hlr.darw


API = (Path(__file__).parents[2] / "hlr" / "docs" / "api.md").read_text("utf-8")


def listed(heading):
    """The rows of the page's table under this heading of its first column."""
    table = API.partition(f"| {heading} |")[2].partition("\n\n")[0]
    return [[cell.strip() for cell in row.strip("|").split("|")] for row in table.splitlines()[2:]]


def test_the_page_lists_every_public_name_and_no_function_among_the_modules():
    assert set(re.findall(r"hlr\.(\w+)", API)) >= set(hlr.__all__)
    functions = {name for row in listed("function") for name in re.findall(r"`hlr\.(\w+)`", row[0])}
    assert functions == {name for name in hlr.__all__ if inspect.isfunction(getattr(hlr, name))}
    modules = {row[0].strip("`").removeprefix("hlr.") for row in listed("module")}
    assert modules == {name for name in hlr.__all__ if inspect.ismodule(getattr(hlr, name))}


@pytest.mark.parametrize("row", listed("module"), ids=lambda row: row[0].strip("`"))
def test_the_page_says_what_each_module_offers(row):
    module = getattr(hlr, row[0].strip("`").removeprefix("hlr."))
    assert import_module(row[1].strip("`")) is module
    offered = set(re.findall(r"`(\w+)`", row[2]))
    if hasattr(module, "__all__"):
        assert offered == set(module.__all__)
    else:
        assert offered and all(import_module(f"{module.__name__}.{name}") for name in offered)


def test_listing_the_names_loads_nothing():
    code = "import hlr, sys; dir(hlr); print([m for m in sys.modules if m.startswith(('hlr.', 'numpy'))])"
    done = subprocess.run([sys.executable, "-P", "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


@pytest.mark.parametrize(("record", "keywords"), [(Options, Wishes), (PreviewOptions, PreviewWishes), (Choice, Chosen)])
def test_keywords_are_the_fields_of_the_record(record, keywords):
    assert get_type_hints(keywords) == get_type_hints(record) and not keywords.__required_keys__


def test_names_of_views_are_those_that_are_known():
    assert get_args(ViewName) == tuple(NAMED)


@pytest.mark.parametrize(("function", "record"), [(hlr.draw, Options), (hlr.preview, PreviewOptions)])
def test_help_shows_the_options_and_their_defaults(function, record):
    shown = inspect.signature(function).parameters
    assert {f.name: f.default for f in fields(record)}.items() <= {k: p.default for k, p in shown.items()}.items()
    assert "options" not in shown


def test_a_wrong_option_is_refused_with_the_nearest():
    with pytest.raises(hlr.OptionError, match=r"^draw\(\) has no option 'hiden': did you mean hidden\?$"):
        hlr.draw("a.step", hiden=False)
    with pytest.raises(hlr.OptionError, match=r"^preview\(\) has no option 'xyz': use size, "):
        hlr.preview("a.step", xyz=1)
    with pytest.raises(
        hlr.OptionError, match=rf"^draw\(\) has no option 'xyz': help\(draw\) lists its {len(fields(Options))}\.$"
    ):
        hlr.draw("a.step", xyz=1)


@pytest.mark.parametrize("name", ["draw_views", "plan_views", "preview_views"])
def test_options_may_be_keywords_of_each_function(name):
    function, of = getattr(hlr, name), hlr.PreviewOptions if name == "preview_views" else hlr.Options
    (one,), (other,) = function(BOX, ["front"], crease=20.0), function(BOX, ["front"], of(crease=20.0))
    if name == "draw_views":
        assert one == other and one.request.options.crease == 20.0
    with pytest.raises(hlr.OptionError, match=rf"^{name}\(\) has no option 'creese': did you mean crease\?$"):
        function(BOX, ["front"], creese=20.0)
    with pytest.raises(
        hlr.OptionError, match=rf"^{name}\(\) has its options in hlr\.{of.__name__} and crease besides: "
    ):
        function(BOX, ["front"], of(), crease=20.0)
    assert "crease" in inspect.signature(function).parameters


def test_a_page_of_several_views_takes_keywords():
    page = hlr.draw_arranged(BOX, "first-angle", section={"left": True}, hidden=False)
    assert page == hlr.draw_arranged(BOX, options=hlr.Options(section={"left": True}, hidden=False))
    with pytest.raises(hlr.OptionError, match=r"^draw_pages\(\) has no option 'acuracy': did you mean accuracy\?$"):
        hlr.draw_pages("a.FCStd", acuracy=0.1)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"views": ["front"]}, r"draw\(\) has no option 'views': did you mean view\?"),
        (
            {"view": ["front", "top"]},
            r"\['front', 'top'\] is no view: .*; draw_views draws several, and ",
        ),
        ({"section": "Front"}, r"not 'Front'; \{'Front': True\} says that this view is cut"),
    ],
)
def test_a_slip_is_told_what_to_write(options, message):
    with pytest.raises(hlr.HlrError, match=message):
        hlr.draw(BOX, **options)


PROGRAM = """
import io
import hlr
drawing = hlr.draw("a.step", "front", scale=0.5, hidden=False, fit=(10.0, 10.0), up=(0.0, 0.0, 1.0), accuracy=0.01)
hlr.draw("a.step", (1.0, -1.0, 1.0))
hlr.draw_arranged("a.step", "first-angle", section={"left": True}, scale="1:2")
hlr.draw_views("a.step", ["front", "top"], scale=0.5)
picture = hlr.preview("a.step", size=(8, 8), edges=True)
drawing.save("a.svg")
drawing.save(io.BytesIO(), format="pdf")
used: float = drawing.accuracy.used
width: float = drawing.bounds.width
code: hlr.NoteCode = drawing.notes[0].code
first: hlr.Line = drawing.visible[0]
again: hlr.Drawing = hlr.load("a.json")
hlr.lab.study.study("a.step", scope=hlr.lab.study.Scope(rivals=False))
hlr.methods(counts=[100], limit=1.0)
hlr.lab.methods.render
"""

REFUSED = {
    'hlr.draw("a.step", hiden=False)': 'Unexpected keyword argument "hiden"',
    'hlr.draw("a.step", hidden="no")': 'incompatible type "str"; expected "bool | None"',
    'hlr.draw("a.step", accuracy="fine")': 'incompatible type "str"; expected "float | None"',
    'hlr.draw("a.step", "frnt")': "expected \\\"Literal['front'",
    'hlr.draw_views("a.step", ["front"], hiden=False)': 'Unexpected keyword argument "hiden"',
    'hlr.preview("a.step", colour=1)': 'Unexpected keyword argument "colour"',
    'hlr.darw("a.step")': 'Module has no attribute "darw"',
    'drawing.save("a.dwg", "dwg")': "No overload variant",
    "drawing.save(io.BytesIO())": "No overload variant",
    'drawing.accuracy["used"]': '"Accuracy" is not indexable',
    "drawing.bounds()": '"Bounds" not callable',
    'drawing.lines[0].kind == "shrap"': "Non-overlapping equality check",
    "drawing.scale = 2.0": 'Property "scale" defined in "Drawing" is read-only',
}


FOREIGN = ("OCP", "cadquery", "build123d", "trimesh", "manifold3d", "ezdxf", "dask", "distributed", "scipy")
"""Libraries that the package uses and none of whose types are in its interface."""


@pytest.mark.slow
def test_a_type_checker_takes_what_is_right_and_refuses_what_is_wrong(tmp_path):
    pytest.importorskip("mypy")
    path = tmp_path / "program.py"
    path.write_text(PROGRAM + "".join(f"{line}\n" for line in REFUSED))
    # The stubs of other libraries take most of the time, and say nothing of ours; of ours the signatures say enough.
    config = tmp_path / "mypy.ini"
    foreign = ",".join(f"{name}.*" for name in FOREIGN)
    config.write_text(f"[mypy]\n[mypy-{foreign}]\nfollow_imports = skip\n[mypy-hlr.*]\nignore_errors = True\n")
    command = [sys.executable, "-m", "mypy", "--strict", "--no-pretty", "--no-error-summary"]
    command += ["--cache-dir", str(tmp_path), "--config-file", str(config), str(path)]
    home = Path(hlr.__file__).parents[1]
    env = {**os.environ} if home.name == "site-packages" else {**os.environ, "MYPYPATH": str(home)}
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, env=env, check=False)
    told = {}
    for text in done.stdout.splitlines():
        if text.startswith("program.py:") and ": error: " in text:
            told.setdefault(int(text.split(":")[1]), text)
    lines = path.read_text().splitlines()
    right = len(PROGRAM.splitlines())
    assert {lines[number - 1] for number in told if number <= right} == set(), done.stdout + done.stderr
    for number, (line, message) in enumerate(REFUSED.items(), right + 1):
        assert message.replace("\\", "") in told.get(number, ""), f"{line}: {told.get(number)}\n{done.stderr}"


@pytest.mark.parametrize(
    ("drawn", "kind"),
    [
        (lambda options: hlr.draw_views(BOX, ["front"], options), "Options"),
        (lambda options: hlr.plan_views(BOX, ["front"], options), "Options"),
        (lambda options: hlr.preview_views(BOX, ["front"], options), "PreviewOptions"),
    ],
)
def test_options_that_are_no_record(drawn, kind):
    with pytest.raises(hlr.OptionError, match=f"needs hlr.{kind} for its options, not dict: write hlr.{kind}"):
        drawn({"scale": 1.0})
    assert len(drawn(None)) == 1
