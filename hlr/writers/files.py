"""Files appear whole or not at all: written beside their place, then renamed into it."""

from __future__ import annotations

import contextlib
import os
import stat
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from hlr.errors import WriteError
from hlr.writers.originals import check_model


def path_of(file: Any) -> Path:
    """The path that a caller gave; raises WriteError for anything else, named as it was given."""
    try:
        path = Path(file)
    except TypeError:
        raise WriteError(f"cannot write into {file!r}: give a path or a binary file object") from None
    if "\0" in str(path):
        raise WriteError(f"cannot write {str(path)!r}: a file name holds no zero character")
    return path


def put(file: Any, data: bytes) -> None:
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


def check(path: Path, make_folder: bool = False) -> None:
    """Raise WriteError where `path` cannot be written: no folder, no permission, or a folder or a model in its place.

    make_folder: `place` will make the folder, so that it need not be there.
    """
    folder = path.parent
    if make_folder:
        folder = next((above for above in (folder, *folder.parents) if above.exists()), folder)
    if not folder.exists():
        raise WriteError(f"cannot write {path}: the folder {folder} does not exist; create it first")
    if not folder.is_dir():
        raise WriteError(f"cannot write {path}: {folder} is not a folder")
    if path.is_dir():
        raise WriteError(f"cannot write {path}: it is a folder; give a file name")
    if path.exists():
        # Renaming would replace even a file that is write-protected.
        if not os.access(path, os.W_OK):
            raise WriteError(f"cannot write {path}: the file is write-protected")
        check_model(path)
    elif not os.access(folder, os.W_OK | os.X_OK):
        raise WriteError(f"cannot write {path}: no permission to write into the folder {folder}")


def place(files: Mapping[Path, bytes], folders: Iterable[Path] = ()) -> None:
    """Write all files, or none: earlier content stays until every new file is complete on disk.

    folders: are made first where they do not exist. Raises WriteError, in one sentence, where the system refuses.
    """
    staged: list[tuple[Path, Path, Path]] = []
    path = Path()
    try:
        for path in folders:
            path.mkdir(parents=True, exist_ok=True)
        for path, data in files.items():
            check(path)
            if path.exists() and not path.is_file():  # a pipe or a device has no content to protect
                path.write_bytes(data)
                continue
            # Through a symbolic link to the file it means, not onto the link.
            target = Path(os.path.realpath(path))
            beside = target.with_name(f".{target.name[:100]}.{os.urandom(4).hex()}.tmp")
            staged.append((path, beside, target))
            _fill(beside, data, target)
        for asked, beside, target in staged:
            path = asked
            beside.replace(target)
    except OSError as error:
        reason = error.strerror or str(error)
        raise WriteError(f"cannot write {path}: {reason[:1].lower()}{reason[1:]}") from error
    finally:
        for _, beside, _ in staged:
            with contextlib.suppress(OSError):
                beside.unlink(missing_ok=True)


def _fill(beside: Path, data: bytes, target: Path) -> None:
    with open(beside, "xb") as file:
        file.write(data)
    if target.exists():
        os.chmod(beside, stat.S_IMODE(target.stat().st_mode))
