"""What a job depends on, as one key: if nothing of it has changed, neither have the drawings.

Keys are made of contents, not of times of change: a fresh checkout has the same ones.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from contextlib import suppress
from hashlib import blake2b, file_digest
from pathlib import Path

from hlr.batch.job import OF_PARTS, Job
from hlr.batch.request import files_of
from hlr.batch.versions import libraries, program
from hlr.common.packages import bindings, installed
from hlr.tables.readers import of_ending

_FORM = 2
"""Of what is kept of an outcome: another one makes other keys."""


class Digests:
    """Digests of files (SHA-256, hexadecimal), each read once until it is forgotten."""

    def __init__(self) -> None:
        self._known: dict[str, str | None] = {}

    def of(self, path: Path) -> str | None:
        """The digest of a file's content; None where there is no file that can be read."""
        name = os.path.abspath(path)
        if name not in self._known:
            self._known[name] = None
            with suppress(OSError, ValueError):
                if os.path.isfile(name):  # whoever opens a pipe waits for a writer
                    with open(name, "rb") as file:
                        self._known[name] = file_digest(file, "sha256").hexdigest()
        return self._known[name]

    def forget(self, paths: Iterable[Path]) -> None:
        """Read these files again when they are asked for."""
        for path in paths:
            self._known.pop(os.path.abspath(path), None)


def key_of(job: Job, digests: Digests) -> str | None:
    """40 hexadecimal digits: of all that is known before a job is carried out. None: the source cannot be read.

    What the source pulls in is known only afterwards: `hlr.batch.kept` compares that.
    """
    source = digests.of(Path(job.root, job.source))
    if source is None:
        return None
    known = {
        "form": _FORM,
        "program": program(),
        "packages": _packages(job),
        "source": [job.source, source],
        "views": job.views,
        **({"shared": True} if job.is_shared and any(name in job.options for name in OF_PARTS) else {}),
        "arrange": [job.arrange, job.printed],
        "formats": job.formats,
        # Sections have their letters in the order of the manifest.
        "options": {
            name: list(value.items()) if name == "section" and isinstance(value, Mapping) else value
            for name, value in job.options.items()
            if name != "threads"
        },
        "depends": [
            [path, digests.of(Path(job.root, path))]
            for path in (*job.depends, *files_of(job.options, job.root).values())
        ],
    }
    text = json.dumps(known, sort_keys=True, default=str)
    return blake2b(text.encode("utf-8", "surrogatepass"), digest_size=20).hexdigest()


def _packages(job: Job) -> list[str]:
    """Names and versions of the packages that a job may use: of a script, all that are installed."""
    reader = of_ending(Path(job.source).suffix)
    if reader is not None and reader.kind == "script":
        return installed()
    return [*libraries(), *(bindings() if reader is not None and reader.brep else ())]
