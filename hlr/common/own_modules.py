"""Modules that no package manager has installed: those of the project that a script belongs to."""

from __future__ import annotations

import sys
import sysconfig
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from functools import cache
from importlib import invalidate_caches
from pathlib import Path

_forgotten: dict[str, Path] = {}


def own_modules(names: Iterable[str]) -> dict[str, Path]:
    """Of these modules, those that no package manager has installed: name and file."""
    found = {}
    for name in names:
        file = getattr(sys.modules.get(name), "__file__", None)
        if file is None:
            continue
        path = Path(file).resolve()
        if not is_installed(path):
            found[name] = path
    return found


def is_installed(path: Path) -> bool:
    """Whether a file belongs to Python, to hlr, or to what a package manager has installed. path: resolved."""
    return "site-packages" in path.parts or any(path.is_relative_to(folder) for folder in _installed())


@contextmanager
def forgetting_own_modules() -> Iterator[None]:
    """What is imported within this block of such modules is imported anew after it, as its file is then.

    Another script may have other modules of the same names.
    """
    invalidate_caches()  # modules beside a script may be new
    before = set(sys.modules)
    try:
        yield
    finally:
        found = own_modules(set(sys.modules) - before)
        _forgotten.clear()
        _forgotten.update((name, path) for name, path in found.items() if path.suffix == ".py")  # others load but once
        for name in _forgotten:
            del sys.modules[name]


def forgotten() -> dict[str, Path]:
    """What the last of these blocks has forgotten: name and file. It is forgotten with that."""
    found = dict(_forgotten)
    _forgotten.clear()
    return found


@cache
def _installed() -> list[Path]:
    places = [Path(sysconfig.get_path(name)).resolve() for name in ("stdlib", "platstdlib", "purelib", "platlib")]
    return [*places, Path(__file__).resolve().parents[1]]
