"""Every field of every public record has a meaning and a unit, and the page of public names shows the record."""

import ast
import inspect
import re
import sys
from dataclasses import fields, is_dataclass, make_dataclass
from importlib import import_module
from pathlib import Path
from typing import get_args, get_type_hints

import numpy as np
import pytest

import hlr

API = (Path(__file__).parents[2] / "hlr" / "docs" / "api.md").read_text("utf-8")
SHOWN = set(re.findall(r"autoclass:: ([\w.]+)", API))

UNITS = re.compile(
    r"millimet|\bmm\b|degrees|radians|seconds|\bMB\b|pixels|model units|model coordinates|sRGB|opacity|0 to 1|share|"
    r"paper (?::|to) model|per model unit|multiples|times as|\bdirection|matrix|as of\s+`"
)
"""What says the unit of numbers, or that they have none."""


def is_record(kind):
    """Whether it is a frozen or plain record of this package, be it a dataclass or a named tuple."""
    ours = isinstance(kind, type) and kind.__module__.split(".")[0] == "hlr"
    return ours and (is_dataclass(kind) or hasattr(kind, "_fields"))


def hints(kind):
    """The types of a record's fields, also of those that only type checkers import."""
    tree, names = ast.parse(inspect.getsource(sys.modules[kind.__module__])), {}
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module.startswith("hlr"):
            names |= {
                alias.asname or alias.name: getattr(import_module(node.module), alias.name) for alias in node.names
            }
    return get_type_hints(kind, localns=names)


def names_of(kind):
    """The fields of a record that have no underscore."""
    found = [field.name for field in fields(kind)] if is_dataclass(kind) else kind._fields
    return [name for name in found if not name.startswith("_")]


def within(kind):
    """A type, and all that it is made of."""
    yield kind
    for each in get_args(kind):
        yield from within(each)


def records():
    """Public records, and those that their fields hold."""
    modules = [hlr, *(import_module(name) for name in ("hlr.compare", "hlr.lab.study", "hlr.testing"))]
    found, open_ones = {}, [getattr(module, name, None) for module in modules for name in dir(module)]
    while open_ones:
        for kind in within(open_ones.pop()):
            if is_record(kind) and kind not in found:
                found[kind] = hints(kind)
                open_ones += [found[kind][name] for name in names_of(kind)]
    return found


RECORDS = records()


def row(kind, name):
    """What the docstring of a record says of a field; None: nothing."""
    text = inspect.cleandoc(kind.__doc__ or "")
    found = re.search(rf"^(?:\w+, )*{name}(?:, \w+)*  +(\S.*(?:\n +\S.*)*)", text, re.MULTILINE)
    return found and found[1]


def head(kind):
    """What a docstring says before its first row: it may be of all fields."""
    return re.split(r"^[\w, ]+  +\S", inspect.cleandoc(kind.__doc__ or ""), maxsplit=1, flags=re.MULTILINE)[0]


def has_numbers(kind):
    """Whether a type is made of numbers that may have a unit: whole numbers count things."""
    return any(each is float or each is np.float64 for each in within(kind))


def lacking(kind, types):
    """Fields of a record without a meaning or a unit, as sentences."""
    for name in names_of(kind):
        said = row(kind, name)
        if said is None:
            yield f"{kind.__name__}.{name} has no row in the docstring"
        elif has_numbers(types[name]) and not UNITS.search(f"{name} {said}") and not UNITS.search(head(kind)):
            yield f"{kind.__name__}.{name} has no unit"


@pytest.mark.parametrize("kind", RECORDS, ids=lambda kind: kind.__name__)
def test_every_field_has_a_meaning_and_numbers_have_a_unit(kind):
    assert list(lacking(kind, RECORDS[kind])) == []


@pytest.mark.parametrize("kind", RECORDS, ids=lambda kind: kind.__name__)
def test_the_page_of_public_names_shows_the_record(kind):
    own = {f"{kind.__module__}.{kind.__qualname__}"}
    own |= {f"{place}.{kind.__name__}" for place in ("hlr", "hlr.compare", "hlr.study") if hlr_has(place, kind)}
    assert own & SHOWN


def hlr_has(place, kind):
    """Whether a public module shows the record under its name."""
    module = hlr if place == "hlr" else getattr(hlr, place.rpartition(".")[2])
    return getattr(module, kind.__name__, None) is kind


@pytest.mark.parametrize("name", sorted(SHOWN))
def test_what_the_page_shows_is_there(name):
    module, _, kind = name.rpartition(".")
    home = {"hlr.study": "hlr.lab.study"}.get(module, module)
    assert isinstance(getattr(import_module(home), kind), type)


def test_records_that_other_records_hold_are_found():
    from hlr.drawing.fill import Gradient
    from hlr.drawing.sheet import SheetView

    assert {hlr.Drawing, hlr.Bounds, SheetView, Gradient, hlr.compare.Comparison} <= set(RECORDS)


def test_what_is_missing_is_found():
    types = {"name": str, "width": float, "height": float, "count": int}
    record = make_dataclass("Thing", types.items())
    record.__doc__ = "A thing.\n\n    width, name  how wide it is\n    height  millimetres"
    assert list(lacking(record, types)) == ["Thing.width has no unit", "Thing.count has no row in the docstring"]
    record.__doc__ = (
        "A thing, millimetres.\n\n    width, name  how wide it is\n    height  above\n            all\n    count  of it"
    )
    assert list(lacking(record, types)) == []
    assert row(record, "height") == "above\n        all"
