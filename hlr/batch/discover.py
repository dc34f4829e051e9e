"""The sources of a batch: files that patterns name, or all models under a folder."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator
from fnmatch import fnmatch
from pathlib import Path

from hlr.tables.readers import of_ending

_CAD_SCRIPT = re.compile(rb"^[ \t]*(?:import|from)[ \t]+(?:cadquery|build123d)\b", re.MULTILINE)
_SHOWS = re.compile(
    rb"^[ \t]*(?:show(?:_object|_all)?|display)[ \t]*\(|^result[ \t]*="
    rb"|^with[ \t]+(?:\w+\.)?Build(?:Part|Sketch|Line)\b",
    re.MULTILINE,
)
_MARKS = frozenset("*?[")
_NO_FOLDERS = ("node_modules", "site-packages")


def is_pattern(name: str) -> bool:
    """Whether a name stands for any number of files."""
    return bool(_MARKS & set(name))


def named(root: Path, pattern: str, silent: list[Path] | None = None) -> list[Path]:
    """The files that a name or a pattern stands for, sorted: of a folder all models under it.

    A pattern leaves out what is no model; a name stands for its file, whatever it is. Empty where there is none.
    silent: as of `models_under`.
    """
    path = root / pattern
    if not is_pattern(pattern) and path.is_dir():
        return list(models_under(path, silent))
    found = files_named(root, pattern)
    return [each for each in found if of_ending(each.suffix) is not None] if is_pattern(pattern) else found


def files_named(root: Path, pattern: str) -> list[Path]:
    """The files, models or not, that a name or a pattern stands for, sorted: of a folder all under it."""
    path = root / pattern
    found: Iterable[Path] = [path]
    if is_pattern(pattern):
        base, rest = _split(path)
        found = base.glob(rest) if rest else ()
    elif path.is_dir():
        found = path.rglob("*")
    return sorted(each for each in found if each.is_file())


def takes_parameters(path: Path) -> bool:
    """Whether a source is a script, whose variables can be set."""
    reader = of_ending(path.suffix)
    return reader is not None and "parameters" in reader.takes


def models_under(folder: Path, silent: list[Path] | None = None) -> Iterator[Path]:
    """All models under a folder, sorted. Hidden folders and those of installed packages are left out.

    A script is run to be drawn, so only those count that import CadQuery or build123d and show something. silent: gets
    the scripts that import them and show nothing.
    """
    for place, folders, names in os.walk(folder):
        folders[:] = sorted(name for name in folders if not _is_foreign(Path(place, name)))
        for name in sorted(names):
            path, reader = Path(place, name), of_ending(Path(name).suffix)
            if name.startswith(".") or reader is None:
                continue
            is_cad, shows = _says(path) if reader.kind == "script" else (True, True)
            if is_cad and shows:
                yield path
            elif is_cad and silent is not None:
                silent.append(path)


def without(paths: Iterable[Path], patterns: Iterable[str], root: Path) -> list[Path]:
    """The paths that none of the patterns fits."""
    patterns = list(patterns)
    return [path for path in paths if not any(_fits(path, pattern, root) for pattern in patterns)]


def _fits(path: Path, pattern: str, root: Path) -> bool:
    """Whether a pattern names a file or a folder above it; `*` and `**` go across folders alike."""
    whole = str(root / pattern).replace("**/", "*")
    return any(fnmatch(str(each), whole) for each in (path, *path.parents))


def _split(path: Path) -> tuple[Path, str]:
    """The folder before the first mark of a pattern, and the rest."""
    parts = path.parts
    first = next(number for number, part in enumerate(parts) if is_pattern(part))
    return Path(*parts[:first]), os.path.join(*parts[first:])


def _is_foreign(folder: Path) -> bool:
    name = folder.name
    return name.startswith((".", "__")) or name in _NO_FOLDERS or os.path.exists(folder / "pyvenv.cfg")


def _says(script: Path) -> tuple[bool, bool]:
    """Whether a script imports CadQuery or build123d, and whether it shows something."""
    try:
        text = script.read_bytes() if script.is_file() else b""
    except OSError:
        return False, False
    return bool(_CAD_SCRIPT.search(text)), bool(_SHOWS.search(text))
