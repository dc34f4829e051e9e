"""What a source pulls in: files that a STEP file refers to, and modules that a script imports from beside it."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from hlr.batch.job import Job
from hlr.batch.request import files_of
from hlr.source.step_references import references
from hlr.tables.readers import of_ending


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
