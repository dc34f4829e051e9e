"""What a source pulls in: files that a STEP file refers to, and modules that a script imports from beside it."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from hlr.batch.job import Job
from hlr.batch.request import files_of
from hlr.tables.readers import of_ending

_REFERENCE = re.compile(rb"DOCUMENT_FILE\s*\(\s*'([^'\r\n]{1,300})'")
"""A file that a STEP file refers to."""

_MOST_REFERENCES = 10_000
"""Of one source."""


def references(source: Path) -> list[Path]:
    """Files that a STEP file refers to, and those that these refer to. Some may not be there."""
    found = [source.resolve()]
    for file in found:  # which grows meanwhile
        if not _is_step(file) or not file.is_file():
            continue
        try:
            named = dict.fromkeys(_REFERENCE.findall(file.read_bytes()))
            paths = [(file.parent / name.decode("utf-8", "replace")).resolve() for name in named]
        except (OSError, ValueError):
            continue
        # A file from anybody may name any other: only models count.
        new = [path for path in paths if _is_step(path) and path not in found]
        found += new[: _MOST_REFERENCES - len(found)]
    return found[1:]


def _is_step(path: Path) -> bool:
    return path.suffix.lower() in (".step", ".stp")


def imported(script: Path) -> list[Path]:
    """Modules that a script imports from its own folder, and those that these import; nothing is run.

    What is imported by a name that the script makes up is not found.
    """
    from importlib import invalidate_caches
    from modulefinder import ModuleFinder

    invalidate_caches()  # modules beside it may be new
    finder = ModuleFinder([str(script.resolve().parent)])
    try:
        finder.run_script(str(script.resolve()))
    except (SyntaxError, OSError, ValueError, RecursionError):  # the script's run says so, with its line
        return []
    files = [getattr(module, "__file__", None) for module in finder.modules.values()]
    return [Path(file) for file in files if file is not None and file != str(script.resolve())]


def needed(job: Job) -> list[Path]:
    """All files that a job needs, as far as can be told before it is carried out, the source first: absolute paths."""
    source, reader = Path(job.root, job.source), of_ending(Path(job.source).suffix)
    found: Iterable[Path] = references(source)
    if reader is not None and reader.kind == "script":
        found = imported(source)
    named = (*job.depends, *files_of(job.options, job.root).values())
    return list(dict.fromkeys([source.absolute(), *found, *(Path(job.root, name).absolute() for name in named)]))
