"""The module of a script while it runs: Python finds it by the name that the script has.

Python looks a module up where a script defines a dataclass, pickles an object, or asks for `sys.modules[__name__]`.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType
from typing import Any


class Variables(dict[str, Any]):
    """Variables of a script, in the order of their last assignment."""

    def __setitem__(self, name: str, value: Any) -> None:
        self.pop(name, None)
        super().__setitem__(name, value)


class _Module(ModuleType):
    """A module whose attributes are the variables of a script."""

    def __init__(self, name: str, variables: Variables) -> None:
        super().__init__(name)
        object.__setattr__(self, "_variables", variables)

    @property
    def __dict__(self) -> Variables:  # type: ignore[override]
        return object.__getattribute__(self, "_variables")  # type: ignore[no-any-return]

    def __getattribute__(self, name: str) -> Any:
        variables = object.__getattribute__(self, "_variables")
        return variables[name] if name in variables else super().__getattribute__(name)

    def __setattr__(self, name: str, value: Any) -> None:
        self.__dict__[name] = value

    def __delattr__(self, name: str) -> None:
        if name not in self.__dict__:
            raise AttributeError(name)
        del self.__dict__[name]


class _Program(_Module):
    """The module `__main__` while a script runs as a program. Processes that it starts begin as those of hlr do."""

    def __init__(self, variables: Variables, before: ModuleType | None) -> None:
        super().__init__("__main__", variables)
        object.__setattr__(self, "_before", before)

    def __getattribute__(self, name: str) -> Any:
        if name in ("__file__", "__spec__"):  # what multiprocessing asks for
            return getattr(object.__getattribute__(self, "_before"), name, None)
        return super().__getattribute__(name)


@contextmanager
def module_of(variables: Variables) -> Iterator[None]:
    """Within this block the script with these variables is the module that its `__name__` says."""
    with _in_place(_Module(variables["__name__"], variables)):
        yield


@contextmanager
def as_program(variables: Variables) -> Iterator[None]:
    """Within this block the script with these variables is the program, the module `__main__`."""
    variables["__name__"] = "__main__"
    with _in_place(_Program(variables, sys.modules.get("__main__"))):
        yield


@contextmanager
def _in_place(module: _Module) -> Iterator[None]:
    name = module.__name__
    before = sys.modules.get(name)
    sys.modules[name] = module
    try:
        yield
    finally:
        sys.modules.pop(name, None)
        if before is not None:
            sys.modules[name] = before
