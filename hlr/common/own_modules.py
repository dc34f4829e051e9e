"""Modules that no package manager has installed: those of the project that a script belongs to."""

from __future__ import annotations

import os
import sys
import sysconfig
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from functools import cache
from importlib import invalidate_caches
from importlib.util import cache_from_source
from pathlib import Path
from types import ModuleType

_PACKAGES = frozenset({"site-packages", "dist-packages"})
"""Folders of package managers; the second is that of Debian."""

_IN_PYTHON = (".py", ".pyc")
"""Endings of modules that are imported anew; compiled ones load but once."""

_YOUNG_S = 2.0

_forgotten: dict[str, Path] = {}


def own_modules(names: Iterable[str]) -> dict[str, Path]:
    """Of these modules, those that no package manager has installed: name and file."""
    found = {}
    for name in names:
        path = _file_of(sys.modules.get(name))
        if path is not None and not is_installed(path):
            found[name] = path
    return found


def _file_of(module: object) -> Path | None:
    """The file of a module, if it has one. Scripts put other objects among the modules, with any attributes."""
    try:
        file = getattr(module, "__file__", None)
    except Exception:  # of a module that is loaded where an attribute is asked for
        return None
    return Path(os.path.realpath(file)) if isinstance(file, str) else None


def is_installed(path: Path) -> bool:
    """Whether a file belongs to Python, to hlr, or to what a package manager has installed. path: resolved."""
    return bool(_PACKAGES & {*path.parts}) or any(path.is_relative_to(folder) for folder in _installed())


@contextmanager
def forgetting_own_modules(folder: Path) -> Iterator[None]:
    """What is imported within this block of such modules is imported anew after it, as its file is then.

    Another script may have other modules of the same names. folder: that of the script; what the caller has imported
    from elsewhere under the name of a module in it is not there within the block.
    """
    invalidate_caches()  # modules beside a script may be new
    aside = _of_other_projects(folder)
    for name in aside:
        del sys.modules[name]
    before = set(sys.modules)
    try:
        yield
    finally:
        new = set(sys.modules) - before
        found = own_modules(new)
        _forgotten.clear()
        _forgotten.update((name, path) for name, path in found.items() if path.suffix in _IN_PYTHON)
        for name in [*_forgotten, *filter(_is_folder_alone, new)]:
            sys.modules.pop(name, None)
        sys.modules.update(aside)
        for path in _forgotten.values():
            _without_young_bytecode(path)


def _of_other_projects(folder: Path) -> dict[str, ModuleType]:
    """The modules that have the name of one in this folder, but come from elsewhere, and all that is inside them."""
    near: set[str] = set()
    with suppress(OSError):
        near = {name.removesuffix(".py") for name in os.listdir(folder)} & set(sys.modules) - {"__main__"}
    for name in list(near):
        path = own_modules([name]).get(name)
        is_there = (folder / f"{name}.py").is_file() or (folder / name / "__init__.py").is_file()
        if path is None or path.is_relative_to(folder) or not is_there:
            near.remove(name)
    return {name: module for name, module in list(sys.modules.items()) if name.partition(".")[0] in near}


def _is_folder_alone(name: str) -> bool:
    """Whether it is a package without a file of its own, none of whose folders a package manager has made."""
    module = sys.modules.get(name)
    if type(module) is not ModuleType or module.__dict__.get("__file__") is not None:
        return False
    folders = [Path(os.path.realpath(folder)) for folder in getattr(module, "__path__", ())]
    return bool(folders) and not any(map(is_installed, folders))


def _without_young_bytecode(path: Path) -> None:
    """Remove the bytecode of a file that was just written: Python takes it also for another text of that second."""
    with suppress(OSError, NotImplementedError):  # a Python that keeps no bytecode
        kept = Path(cache_from_source(str(path)))
        if kept.stat().st_mtime - path.stat().st_mtime < _YOUNG_S:
            kept.unlink()


def forgotten() -> dict[str, Path]:
    """What the last of these blocks has forgotten: name and file. It is forgotten with that."""
    found = dict(_forgotten)
    _forgotten.clear()
    return found


@cache
def _installed() -> list[Path]:
    places = [Path(sysconfig.get_path(name)).resolve() for name in ("stdlib", "platstdlib", "purelib", "platlib")]
    return [*places, Path(__file__).resolve().parents[1]]
