"""What `hlr batch` is asked for, and the earlier drawings that it looks at."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hlr.errors import HlrError, OptionError

from .parameters import Vector3

if TYPE_CHECKING:
    from hlr.batch.baseline import Baseline
    from hlr.batch.changes import Changes
    from hlr.batch.manifest import Manifest
    from hlr.batch.plan import Plan
    from hlr.batch.run import Done
    from hlr.batch.stale import EarlierDrawings


class Asked:
    """What the command line asks for. The manifest is read again where it has changed.

    prunes: drawings of earlier runs are removed, also where no model is left
    """

    prunes = False

    def __init__(
        self,
        sources: Sequence[str],
        output: str | None,
        views: Sequence[str | Vector3],
        formats: Sequence[str],
        arrange: str | None,
        strict: bool,
        time_limit: float | None,
        total_time_limit: float | None,
    ) -> None:
        self._sources, self._output, self._strict = sources, output, strict
        self._given = {
            "views": [view if isinstance(view, str) else list(view) for view in views],
            "formats": list(formats),
            "arrange": arrange,
            "time_limit_s": time_limit,
            "total_time_limit_s": total_time_limit,
        }

    def unused_manifest(self, plan: Plan) -> Path | None:
        """The manifest here, where it is not used because sources are named; None: there is none."""
        from hlr.batch.manifest import find

        return find(Path()) if plan.manifest.file is None and self._sources else None

    def plan(self) -> Plan:
        """The plan of the batch, as the files are now. Without a model there may be drawings to remove.

        Raises OptionError where there are none either.
        """
        found = self._plan(self._given)
        if found.empty is not None and not Earlier(self, found).drawings(found).stale:
            raise found.empty
        return found

    def usual_plan(self, plan: Plan) -> Plan | None:
        """What a manifest says without the views and formats of the command line; None: that is refused.

        plan: the one of this run, which it is where the command line names none
        """
        if plan.manifest.file is None or not any(self._given[key] for key in ("views", "formats", "arrange")):
            return plan
        with suppress(HlrError):
            return self._plan({})
        return None

    def _plan(self, given: Mapping[str, Any]) -> Plan:
        from hlr.batch.plan import plan

        manifest = self._manifest(given)
        output = Path(self._output) if self._output is not None else manifest.root / manifest.output
        return plan(manifest, Path(os.path.abspath(output)), self._strict, may_be_empty=self.prunes)

    def _manifest(self, given: Mapping[str, Any]) -> Manifest:
        from hlr.batch.manifest import find, read, without_file

        if "" in self._sources:
            raise OptionError("the name of a source is empty: name a folder or models, or leave it out")
        named = [Path(source) for source in self._sources] or [Path()]
        manifest = next((path for path in named if path.suffix == ".toml"), None)
        if manifest is not None and len(named) > 1:
            raise OptionError(
                f"{manifest} is a manifest, which names its sources itself: give it alone, or leave it out"
            )
        if len(named) == 1:
            one = named[0]
            file = manifest or find(one)
            if file is not None:
                return read(file, **given)
            if one.is_dir():
                return without_file(one.resolve(), **given)
        return without_file(Path().resolve(), files=[str(path) for path in named], **given)


class Earlier:
    """Earlier drawings: those that `--baseline` names, if any, and those that stand in the last report.

    fails: whether a difference is a failure; prunes: whether stale drawings are removed
    """

    def __init__(
        self, asked: Asked, plan: Plan, name: str | None = None, fails: bool = False, prunes: bool = False
    ) -> None:
        if fails and name is None:
            raise OptionError("--fail-on-change needs --baseline: name a folder, or git:REVISION")
        self.name, self.fails, self.prunes = name, fails, prunes
        self._asked = asked
        self._baseline: Baseline | None = None
        if name is not None:
            from hlr.batch.baseline import baseline_of

            self._baseline = baseline_of(name, plan)

    def changes(self, done: Done) -> Changes | None:
        """What has changed in the drawings of a batch; None: there is no baseline."""
        if self._baseline is None:
            return None
        from hlr.batch.changes import changes

        return changes(done, self._baseline)

    def drawings(self, plan: Plan, done: Done | None = None) -> EarlierDrawings:
        """Those of the last report that this run draws no more. done: what was drawn; None: nothing yet."""
        from hlr.batch.stale import earlier

        usual = self._asked.usual_plan(plan)
        is_part = usual is None or self._asked.unused_manifest(plan) is not None
        failed = () if done is None else done.failed_files
        return earlier(plan, failed, usual=usual, is_part=is_part)
