"""What a script reads beside its modules: files that it opens, and files and modules that it looks for in vain.

Files count that lie below the folder of the batch or that of the script. They are told by Python itself as they are
opened, and by the readers of OpenCASCADE. What a script writes is its own, and does not count.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from importlib import import_module
from importlib.machinery import ModuleSpec
from importlib.util import source_from_cache
from pathlib import Path
from types import FrameType
from typing import Any

_WRITES = os.O_WRONLY | os.O_RDWR

_READERS = (
    ("STEPControl", "STEPControl_Reader", "ReadFile"),
    ("STEPCAFControl", "STEPCAFControl_Reader", "ReadFile"),
    ("IGESControl", "IGESControl_Reader", "ReadFile"),
    ("IGESCAFControl", "IGESCAFControl_Reader", "ReadFile"),
    ("BRepTools", "BRepTools", "Read_s"),
    ("BinTools", "BinTools", "Read_s"),
    ("StlAPI", "StlAPI_Reader", "Read"),
    ("RWStl", "RWStl", "ReadFile_s"),
)
"""Of OpenCASCADE: module, class, and the method that reads a file, whose path is one of its arguments."""


class FilesRead:
    """What is read while this is active (`recording`).

    folders       where files count
    is_installed  tells files that a package manager has installed
    """

    def __init__(self, folders: Sequence[Path], is_installed: Callable[[Path], bool]) -> None:
        self._folders = [each.resolve() for each in folders]
        self._is_installed = is_installed
        self._read: dict[str, None] = {}
        self._written: set[str] = set()
        self._sought: dict[Path, None] = {}

    @property
    def files(self) -> list[Path]:
        """Files that were read, not written, and are still there."""
        return [path for path in self._opened() if path.is_file()]

    @property
    def missed(self) -> list[Path]:
        """Files that are not there, and would be read or imported if they were."""
        return [path for path in dict.fromkeys((*self._opened(), *self._sought)) if not path.exists()]

    def opened(self, file: Any, mode: Any, flags: Any) -> None:
        """A file is opened, as of the audit event `open`."""
        if not isinstance(file, str | bytes | os.PathLike):
            return
        name = os.path.abspath(os.fsdecode(file))
        writes = any(sign in mode for sign in "wax+") if isinstance(mode, str) else bool((flags or 0) & _WRITES)
        if writes:
            self._written.add(name)
        else:
            self._read.setdefault(name)

    def renamed(self, file: Any) -> None:
        """A file gets this name, as of the audit event `os.rename`."""
        self._written.add(os.path.abspath(os.fsdecode(file)))

    def sought(self, name: str, path: Sequence[str] | None, importer: str) -> None:
        """A module was sought in these folders, and not found. importer: the file that asks for it."""
        if self._is_installed(Path(importer).resolve()):
            return
        for folder in sys.path if path is None else path:
            place = Path(folder or os.curdir).resolve()
            if place.is_dir() and not self._is_installed(place / "any.py"):
                last = name.rpartition(".")[2]
                self._sought |= dict.fromkeys((place / f"{last}.py", place / last / "__init__.py"))

    def _opened(self) -> list[Path]:
        """The files that count of those that were opened to read them, whether they are there or not."""
        names = (_source(name) for name in self._read if name not in self._written)
        paths = dict.fromkeys(path for name in names if (path := _resolved(name)) is not None)
        return [path for path in paths if self._counts(path)]

    def _counts(self, path: Path) -> bool:
        return any(path.is_relative_to(each) for each in self._folders) and not self._is_installed(path)


@contextmanager
def recording(found: FilesRead) -> Iterator[None]:
    """Within this block, what is read is noted."""
    if not _State.hooked:  # it stays as long as the process
        _State.hooked = True
        sys.addaudithook(_hook)
    last = _LastFinder()
    sys.meta_path.append(last)
    _watch_readers()
    _State.active = found
    try:
        yield
    finally:
        _State.active = None
        sys.meta_path.remove(last)


class _State:
    """Who notes what this process reads now."""

    hooked = False
    active: FilesRead | None = None
    watched: frozenset[str] = frozenset()


def _hook(event: str, arguments: tuple[Any, ...]) -> None:
    if event in ("open", "os.rename") and _State.active is not None:
        with suppress(Exception):  # whatever a script opens, it has to come as far as without this
            if event == "open":
                _State.active.opened(*arguments)
            else:
                _State.active.renamed(arguments[1])


class _LastFinder:
    """A finder of modules that finds none: it is asked where no other has found one."""

    def find_spec(self, name: str, path: Sequence[str] | None = None, target: Any = None) -> ModuleSpec | None:
        """As of any finder; None: this one does not know the module."""
        active, frame = _State.active, _importer(sys._getframe(1))
        if active is not None and frame is not None:
            with suppress(Exception):
                active.sought(name, path, frame.f_code.co_filename)
        return None


def _importer(frame: FrameType | None) -> FrameType | None:
    """The frame that asks for a module: the first one that is none of Python's own imports."""
    while frame is not None and "importlib" in frame.f_code.co_filename:
        frame = frame.f_back
    return frame


def _watch_readers() -> None:
    """Let the readers of OpenCASCADE tell what they read, once it is in memory."""
    for module, name, method in _READERS:
        if f"OCP.{module}" in sys.modules and module not in _State.watched:
            with suppress(ImportError, AttributeError, TypeError):
                _watch(getattr(import_module(f"OCP.{module}"), name), method)
                _State.watched |= {module}


def _watch(owner: Any, method: str) -> None:
    read = getattr(owner, method)

    def told(*arguments: Any, **named: Any) -> Any:
        if _State.active is not None:
            for each in (*arguments, *named.values()):
                if isinstance(each, str | bytes | os.PathLike):
                    _State.active.opened(each, "rb", 0)
        return read(*arguments, **named)

    setattr(owner, method, staticmethod(told) if method.endswith("_s") else told)


def _resolved(name: str) -> Path | None:
    """The path of a file; None where no file can have this name, as a text that a script takes for one at first."""
    try:
        path = Path(name).resolve()
        path.exists()
    except (OSError, RuntimeError, ValueError):  # too long, a link that leads back to itself, a character that is none
        return None
    return path


def _source(name: str) -> str:
    """The file that a compiled module was made of; any other as it is."""
    with suppress(ValueError):
        if name.endswith(".pyc"):
            return source_from_cache(name)
    return name
