"""Keys of cache entries: a digest of everything that the reading of a file depends on."""

from __future__ import annotations

from contextlib import suppress
from functools import cache
from hashlib import blake2b
from pathlib import Path

from hlr.common.packages import bindings
from hlr.source.step_references import references


def cache_key(path: Path, kind: str, all_of_it: bool) -> str:
    """40 hexadecimal digits: a digest of a file's content and name, the kind, the options, and the reading code.

    all_of_it: what the file hides was read as well. The name counts because nameless parts are named after the file. Of
    a STEP file, those that it refers to count as well.
    """
    digest = blake2b(digest_size=20)
    for text in (*_reader_versions(), kind, path.name, str(all_of_it)):
        digest.update(text.encode("utf-8", "surrogateescape") + b"\0")
    _add(digest, path)
    for other in references(path) if kind == "step" else ():
        digest.update(b"\0" + other.name.encode("utf-8", "surrogateescape") + b"\0")
        # One that is missing now, or cannot be read, may come.
        with suppress(OSError):
            _add(digest, other)
    return digest.hexdigest()


def _add(digest: blake2b, path: Path) -> None:
    """The content of a file, piece by piece."""
    with path.open("rb") as file:
        while piece := file.read(1 << 20):
            digest.update(piece)


@cache
def _reader_versions() -> tuple[str, ...]:
    """Digest of hlr's code and versions of OpenCASCADE's bindings; the bindings are not imported."""
    return _own_code(), *bindings()


def _own_code() -> str:
    """Digest of the modules that read files: in a checkout they change more often than the version."""
    digest = blake2b(digest_size=20)
    for path in code_files():
        digest.update(path.read_bytes())
    return digest.hexdigest()


def code_files() -> list[Path]:
    """The module that states the version, and all modules that read and cache files."""
    hlr = Path(__file__).parents[2]
    readers = sorted(path for room in ("source", "cache", "tables") for path in (hlr / room).rglob("*.py"))
    return readers + sorted(hlr.glob("__init__.py*"))
