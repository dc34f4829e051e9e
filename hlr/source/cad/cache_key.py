"""What an entry is found by: all that what was read depends on."""

from __future__ import annotations

import os
from functools import cache
from hashlib import blake2b
from importlib.util import find_spec
from pathlib import Path


def cache_key(path: Path, kind: str, annotations: bool) -> str:
    """Forty hexadecimal digits for the content of a file, its name, how it is read, and by what.

    The name counts, for it is that of parts that have none.
    """
    found = blake2b(digest_size=20)
    for text in (*_reader(), kind, path.name, str(annotations)):
        found.update(text.encode("utf-8", "surrogateescape") + b"\0")
    with path.open("rb") as file:
        while piece := file.read(1 << 20):
            found.update(piece)
    return found.hexdigest()


@cache
def _reader() -> tuple[str, ...]:
    """Versions of hlr and of OpenCASCADE's bindings, none of which is imported for it."""
    return _own_code(), *_bindings()


def _own_code() -> str:
    """A digest of hlr's version and of all code that reads: a checkout changes more often than its version."""
    found = blake2b(digest_size=20)
    for path in code_files():
        found.update(path.read_bytes())
    return found.hexdigest()


def code_files() -> list[Path]:
    """The module that states the version, and those that read files and keep what was read."""
    hlr = Path(__file__).parents[2]
    readers = sorted(path for room in ("source", "cache", "tables") for path in (hlr / room).rglob("*.py"))
    return readers + sorted(hlr.glob("__init__.py*"))


def _bindings() -> list[str]:
    """Names of the distributions, with their versions, beside the package OCP; else its date and size."""
    try:
        spec = find_spec("OCP")
    except ValueError:
        spec = None
    if spec is None or spec.origin is None:
        return ["none"]
    state, package = os.stat(spec.origin), Path(spec.origin)
    beside = package.parent.parent if spec.submodule_search_locations else package.parent
    named = sorted(name for name in os.listdir(beside) if "ocp" in name.lower() and name.endswith(".dist-info"))
    return named or [f"{state.st_mtime_ns} {state.st_size}"]
