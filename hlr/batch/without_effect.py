"""Options of a manifest that no source has a use of. One source that has a use of an option is enough."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from hlr.batch.plan import Plan
from hlr.request.concerns import OF_SOURCES
from hlr.tables.readers import of_ending


def without_effect(plan: Plan) -> Iterator[str]:
    """A sentence about each option that is given and is for none of the sources that it is given for."""
    file = plan.manifest.file
    if any(job.arrange and job.options.get("same_scale") for job in plan.jobs):
        where = "" if file is None else f" in {file.name}"
        yield f"same_scale{where} has no effect where views are arranged: views on one page have one scale"
    for name, of in OF_SOURCES.items():
        readers = [of_ending(Path(job.source).suffix) for job in plan.jobs if name in job.options]
        if readers and not any(reader is None or of.fits(reader) for reader in readers):
            where = "" if file is None else f" in {file.name}"
            yield f"{name}{where} has no effect{of.but}: it is for {of.whose}, and none of its sources is such"
