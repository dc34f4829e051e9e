"""Writing files: complete or not at all. Each is written under a temporary name, then renamed."""

from __future__ import annotations

import contextlib
import os
import stat
from collections.abc import Iterable, Mapping
from io import RawIOBase
from pathlib import Path
from typing import Any

from hlr.drawing.originals import check_model
from hlr.errors import WriteError


def path_of(file: Any) -> Path:
    """The path that a caller gave; raises WriteError for anything else, named as it was given."""
    try:
        path = file if isinstance(file, Path) else Path(file)
    except TypeError:
        raise WriteError(f"cannot write into {file!r}: give a path or a binary file object") from None
    if "\0" in str(path):
        raise WriteError(f"cannot write {str(path)!r}: a file name holds no zero character")
    return path


def write_into(file: Any, data: bytes) -> None:
    """Write all of it into a file object that is open for bytes; raises WriteError where that is refused."""
    name = str(getattr(file, "name", "") or f"the {type(file).__name__}")
    try:
        written = file.write(data)
    except TypeError:
        raise WriteError(f"cannot write into {name}: it takes text, not bytes; open it with mode 'wb'") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise WriteError(f"cannot write into {name}: {reason[:1].lower()}{reason[1:]}") from error
    if isinstance(written, int) and written < len(data):
        raise WriteError(f"cannot write into {name}: it took {written} of {len(data)} bytes; open it with buffering")


def check_writable(path: Path, make_folder: bool = False) -> os.stat_result | None:
    """Raise WriteError where `path` cannot be written: no folder, no permission, or a folder or a model in its place.

    make_folder: `write_all` will create the folder, so it need not exist. Returns the status of a file that exists.
    """
    name = os.fspath(path)
    try:
        there = os.stat(name)
    except (OSError, ValueError):
        _check_folder(name, make_folder)
        return None
    if stat.S_ISDIR(there.st_mode):
        raise WriteError(f"cannot write {path}: it is a folder; give a file name")
    # Renaming would replace even a file that is write-protected.
    if not os.access(name, os.W_OK):
        raise WriteError(f"cannot write {path}: the file is write-protected")
    if stat.S_ISREG(there.st_mode):
        _check_folder(os.path.realpath(name) if os.path.islink(name) else name, False)
    check_model(path)
    return there


def _check_folder(path: str, make_folder: bool) -> None:
    """Raise WriteError where no file can be made at `path`."""
    folder = os.path.dirname(path) or os.curdir
    if make_folder:
        above = Path(folder)
        folder = next((str(each) for each in (above, *above.parents) if each.exists()), folder)
    if not os.path.isdir(folder):
        if not os.path.exists(folder):
            raise WriteError(f"cannot write {path}: the folder {folder} does not exist; create it first")
        raise WriteError(f"cannot write {path}: {folder} is not a folder")
    if not os.access(folder, os.W_OK | os.X_OK):
        raise WriteError(f"cannot write {path}: no permission to write into the folder {folder}")


def write_all(files: Mapping[Path, bytes], folders: Iterable[Path] = ()) -> None:
    """Write all files, or none: earlier content stays until every new file is complete on disk.

    folders: are made first where they do not exist. Raises WriteError, in one sentence, where the system refuses.
    """
    staged: list[tuple[Path, str, str]] = []
    path = Path()
    try:
        for path in folders:
            _make_folder(path)
        for path, data in files.items():
            there = check_writable(path)
            if there is not None and not stat.S_ISREG(there.st_mode):  # a pipe or a device has no content to protect
                path.write_bytes(data)
                continue
            # Through a symbolic link to the file it means, not onto the link.
            target = os.fspath(path)
            if os.path.islink(target):
                target = os.path.realpath(target)
            folder, name = os.path.split(target)
            beside = os.path.join(folder, f".{name[:100]}.{os.urandom(4).hex()}.tmp")
            staged.append((path, beside, target))
            with open(beside, "xb", buffering=0) as file:
                _write(file, data)
            if there is not None:
                os.chmod(beside, stat.S_IMODE(there.st_mode))
        while staged:
            path, beside, target = staged[0]
            os.replace(beside, target)
            del staged[0]
    except OSError as error:
        reason = error.strerror or str(error)
        raise WriteError(f"cannot write {path}: {reason[:1].lower()}{reason[1:]}") from error
    finally:
        for _, beside, _ in staged:
            with contextlib.suppress(OSError):
                os.unlink(beside)


def _make_folder(path: Path) -> None:
    """Make a folder where there is none. Raises OSError; WriteError where something else has its name."""
    try:
        path.mkdir(parents=True, exist_ok=True)
    except (FileExistsError, NotADirectoryError):
        other = next((each for each in (path, *path.parents) if each.exists() or each.is_symlink()), path)
        raise WriteError(f"cannot write into {path}: {other} is not a folder") from None


def _write(file: RawIOBase, data: bytes) -> None:
    """Write all data, however many bytes the system accepts at a time."""
    rest = memoryview(data)
    while rest:
        rest = rest[file.write(rest) or 0 :]
