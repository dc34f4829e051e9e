"""The examples in the docstrings of the public names run, and say what comes out."""

import doctest
import inspect
import shutil
from pathlib import Path

import pytest

import hlr

OBJECTS = {name: getattr(hlr, name) for name in hlr.__all__ if not inspect.ismodule(getattr(hlr, name))}
DOCUMENTED = [name for name, thing in OBJECTS.items() if inspect.isfunction(thing) or inspect.isclass(thing)]

WITHOUT_EXAMPLE = {
    # Errors: `hlr.draw` shows one.
    "HlrError",
    "OptionError",
    "SourceError",
    "StrictError",
    "ViewError",
    "WriteError",
    # The keywords of `hlr.draw` and `hlr.preview`, for type checkers.
    "PreviewWishes",
    "Wishes",
    # Shown by the functions that return them.
    "PartReport",
    "ViewPlan",
}


@pytest.fixture(scope="module")
def plate(tmp_path_factory):
    """A folder with part.step, a plate of 30 x 20 x 10 mm with a hole of 8 mm through it, and with housing.FCStd."""
    cq = pytest.importorskip("cadquery")
    folder = tmp_path_factory.mktemp("docstrings")
    solid = cq.Workplane().box(30, 20, 10).faces(">Z").workplane().hole(8)
    cq.exporters.export(solid, str(folder / "part.step"))
    shutil.copy(Path(__file__).parents[1] / "data" / "housing_body.FCStd", folder / "housing.FCStd")
    return folder


def examples(name):
    """The doctests of one public name, in its own docstring and in those of its methods."""
    found = doctest.DocTestFinder(exclude_empty=True).find(OBJECTS[name], name, globs={})
    return [test for test in found if test.examples]


def failures(test):
    """What a doctest prints where it fails."""
    said = []
    doctest.DocTestRunner(verbose=False).run(test, out=said.append)
    return "".join(said)


@pytest.mark.slow
@pytest.mark.parametrize("name", DOCUMENTED)
def test_the_examples_of_a_public_name_run(name, plate, monkeypatch):
    monkeypatch.chdir(plate)
    tests = examples(name)
    assert bool(tests) == (name not in WITHOUT_EXAMPLE)
    assert not "".join(map(failures, tests))


@pytest.mark.parametrize("name", DOCUMENTED)
def test_a_public_name_has_a_docstring_of_its_own(name):
    text = inspect.getdoc(OBJECTS[name])
    assert text
    assert not text.startswith(f"{name}("), "that is what a dataclass writes by itself"


def test_a_wrong_example_is_noticed():
    parse = doctest.DocTestParser().get_doctest
    assert not failures(parse(">>> 1 + 1\n2\n", {}, "right", None, 0))
    assert "Expected" in failures(parse(">>> 1 + 1\n3\n", {}, "wrong", None, 0))
