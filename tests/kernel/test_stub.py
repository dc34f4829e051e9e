"""`hlr/_kernel.pyi` says what the kernel's module has: the same names, parameters, order and defaults."""

from __future__ import annotations

import ast
import inspect
from pathlib import Path
from typing import Any

import pytest

from hlr import _kernel

STUB = ast.parse((Path(__file__).parents[2] / "hlr" / "_kernel.pyi").read_text("utf-8"))


def public(names) -> set[str]:
    return {name for name in names if not name.startswith("_")}


def of_kind(nodes, *kinds) -> dict[str, Any]:
    return {node.name: node for node in nodes if isinstance(node, kinds)}


FUNCTIONS = of_kind(STUB.body, ast.FunctionDef)
CLASSES = of_kind(STUB.body, ast.ClassDef)


def is_property(node: ast.FunctionDef) -> bool:
    return any(isinstance(d, ast.Name) and d.id == "property" for d in node.decorator_list)


def stated(node: ast.FunctionDef) -> list[tuple[str, str, Any]]:
    """Parameters of the stub: name, kind, default."""
    a = node.args
    positional = [*a.posonlyargs, *a.args]
    defaults = [inspect.Parameter.empty] * (len(positional) - len(a.defaults)) + [
        ast.literal_eval(d) for d in a.defaults
    ]
    found = [(p.arg, "positional", d) for p, d in zip(positional, defaults, strict=True)]
    for p, d in zip(a.kwonlyargs, a.kw_defaults, strict=True):
        found.append((p.arg, "keyword", inspect.Parameter.empty if d is None else ast.literal_eval(d)))
    return [parameter for parameter in found if parameter[0] not in ("self", "cls")]


def real(thing: Any) -> list[tuple[str, str, Any]]:
    """Parameters of the module."""
    kinds = {inspect.Parameter.KEYWORD_ONLY: "keyword"}
    parameters = inspect.signature(thing).parameters.values()
    return [(p.name, kinds.get(p.kind, "positional"), p.default) for p in parameters if p.name != "self"]


def test_the_module_has_what_the_stub_says_and_nothing_else():
    assert public(dir(_kernel)) == {*FUNCTIONS, *CLASSES}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_parameters_of_functions(name):
    assert real(getattr(_kernel, name)) == stated(FUNCTIONS[name])


@pytest.mark.parametrize("name", CLASSES)
def test_members_of_classes(name):
    real_class, body = getattr(_kernel, name), CLASSES[name].body
    methods = of_kind(body, ast.FunctionDef)
    fields = {node.target.id for node in body if isinstance(node, ast.AnnAssign)}
    assert public(dir(real_class)) == public([*methods, *fields])
    for member, node in methods.items():
        if member == "__new__":
            assert real(real_class) == stated(node)
        elif is_property(node):
            assert inspect.isdatadescriptor(getattr(real_class, member)), member
        else:
            assert real(getattr(real_class, member)) == stated(node), member
    for member in fields:
        assert inspect.isdatadescriptor(getattr(real_class, member)), member
