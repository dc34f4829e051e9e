"""The report of a batch: files beside the drawings. A file that is added to reports is a row of `_WRITERS` here.

`manifest.json` has all there is to know; the others say a part of it in the form that another program reads. The web
page, which is many files, shows it to people (`hlr.batch.page`). Rows stand in the order of the plan. Times and memory
stand under "cost" and "seconds", or nowhere if they are not asked for: nothing else differs from run to run.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hlr.batch import ci, junit, markdown
from hlr.batch.job import Failure, Job, Outcome
from hlr.batch.keys import Digests
from hlr.batch.page import write as page
from hlr.batch.run import Done
from hlr.batch.stale import EarlierDrawings, folder_of
from hlr.drawing import files
from hlr.tables.documents import head

if TYPE_CHECKING:
    from hlr.batch.changes import Changes

Document = dict[str, Any]


def document(
    done: Done,
    digests: Digests,
    changes: Changes | None = None,
    earlier: EarlierDrawings | None = None,
    times: bool = True,
) -> Document:
    """The report as `manifest.json` has it.

    changes: since the baseline; None: there is none. earlier: drawings of earlier runs that are still there. times:
    what each source has cost stands there, too.
    """
    from importlib.metadata import version

    earlier = earlier or EarlierDrawings()
    sources = [_source(job, outcome, digests) for job, outcome in zip(done.plan.jobs, done.outcomes, strict=True)]
    found: Document = {
        **head("hlr-batch"),
        "hlr": version("hlr-drawing"),
        "counts": {
            "sources": len(sources),
            "drawings": sum(len(source["drawings"]) for source in sources),
            "failed": sum(source["state"] == "failed" for source in sources),
            "warned": sum(outcome.warned for outcome in done.outcomes),
        },
        "folder": folder_of(done.plan),
        "stale": list(earlier.stale),
        "others": list(earlier.others),
        "sources": sources,
    }
    if changes is not None:
        for source in sources:
            for drawing in source["drawings"]:
                drawing["change"] = changes.of[next(iter(drawing["files"].values()))]
        found["counts"]["changed"] = sum(change["state"] != "unchanged" for change in changes.of.values())
        found["gone"] = list(changes.gone)
    if not times:
        for source in sources:
            del source["cost"]
            for drawing in source["drawings"]:
                del drawing["seconds"]
    return found


def write(
    done: Done,
    digests: Digests,
    environment: Mapping[str, str],
    changes: Changes | None = None,
    earlier: EarlierDrawings | None = None,
    times: bool = True,
) -> Document:
    """Write the files of the report that have changed. Returns the document.

    environment: variables by which a CI service is told. changes, earlier, times: as of `document`. Raises WriteError
    where a file cannot be written.
    """
    found = document(done, digests, changes, earlier, times)
    contents = {}
    for name, writer in _WRITERS.items():
        content = writer(found, environment)
        path = done.plan.output / name
        if content is not None and _old(path) != content:
            contents[path] = content
    files.write_all(contents, dict.fromkeys(path.parent for path in contents))
    page.write(found, _as_json(found, environment), done.plan.output)
    return found


def _source(job: Job, outcome: Outcome, digests: Digests) -> Document:
    """The row of a job."""
    failure = outcome.failure
    drawings = []
    if failure is None:
        for names, facts in zip(job.files, outcome.drawings, strict=True):
            drawings.append({"files": dict(zip(job.formats, names, strict=True)), **facts})
    depends = sorted({*job.depends, *outcome.depends})
    return {
        "source": job.source,
        "sha256": digests.of(Path(job.root, job.source)),
        "depends": {path: digests.of(Path(job.root, path)) for path in depends},
        "options": json.loads(json.dumps(job.options, default=str)),
        "views": list(job.views),
        "state": "failed" if failure else "warned" if outcome.warned else "drawn",
        "error": None if failure is None else _error(failure, outcome.printed),
        "drawings": drawings,
        "cost": {"seconds": outcome.seconds, "peak_memory_mb": outcome.peak_memory_mb},
    }


def _error(failure: Failure, printed: str) -> Document:
    return {"kind": failure.kind, "message": failure.message, **({"printed": printed} if printed else {})}


def _as_json(found: Document, _environment: Mapping[str, str]) -> bytes:
    return json.dumps(found, indent=1, allow_nan=False).encode("ascii") + b"\n"


_WRITERS: dict[str, Callable[[Document, Mapping[str, str]], bytes | None]] = {
    "manifest.json": _as_json,
    "junit.xml": lambda found, _: junit.document(found),
    "summary.md": lambda found, _: markdown.document(found),
    "code-quality.json": ci.code_quality,
}
"""The name of each file, which `hlr.batch.plan.REPORTS` keeps free, and its content; None: it is of no use here."""


def _old(path: Path) -> bytes | None:
    try:
        return path.read_bytes()
    except OSError:
        return None
