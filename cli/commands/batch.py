"""`hlr batch`: draw many sources, and only what has changed."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from hlr.errors import OptionError, WriteError, counted
from hlr.tables.projection_methods import PROJECTION_METHODS
from hlr.tables.writers import WRITERS

from .. import signals
from ..batch_asked import Asked, Earlier
from ..batch_progress import Lines, progress
from ..exits import remark
from ..parameters import Duration, OutputName, ViewName, Whole
from ..streams import say, show, show_path
from ..verb import Verb
from ..view_options import NO_CACHE

if TYPE_CHECKING:
    from hlr.batch.kept import Kept
    from hlr.batch.keys import Digests
    from hlr.batch.plan import Plan
    from hlr.batch.pool import Pool
    from hlr.batch.run import Done
    from hlr.batch.stale import Row

FAILED = 1
"""Exit code where some sources could not be drawn."""

CHANGED = 3
"""Exit code where drawings differ from the baseline, and that was asked for."""


@click.command(cls=Verb)
@click.argument("sources", nargs=-1, metavar="[FOLDER | PATTERN... | hlr.toml]")
@click.option(
    "-o",
    "--output",
    type=OutputName(),
    metavar="FOLDER",
    help="Where to write. Default: what the manifest says, else drawings in the folder of the batch.",
)
@click.option(
    "--view", "views", type=ViewName(), metavar="NAME|X,Y,Z", multiple=True,
    help="As of hlr draw; may be repeated. Default: front, top, right, iso, or those of --arrange.",
)  # fmt: skip
@click.option(
    "--arrange",
    type=click.Choice(list(PROJECTION_METHODS)),
    help="All views of a source on one page, in line and at one scale, by this method.",
)
@click.option("--format", "formats", type=click.Choice(list(WRITERS)), multiple=True, help="May be repeated.")
@click.option(
    "-j",
    "--jobs",
    type=Whole(1, 1024),
    metavar="N",
    help="Sources drawn at the same time. Default: one on each core.",
)
@click.option(
    "--time-limit",
    type=Duration(),
    metavar="TIME",
    help="Give up a source that takes longer, and draw the rest: 60s, 5min. Default: what the manifest says, or 10min.",
)
@click.option(
    "--total-time-limit",
    type=Duration(),
    metavar="TIME",
    help="End the whole run after this time: 30min. What is drawn stays, the rest counts as failed, and the next run "
    "goes on with it. Default: what the manifest says, or no limit.",
)
@click.option(
    "--on",
    "address",
    metavar="ADDRESS",
    help="Draw on the workers of a Dask scheduler, such as tcp://host:8786, instead of here.",
)
@click.option(
    "--baseline",
    metavar="FOLDER|git:REV",
    help="Compare with earlier drawings: those of a folder, or of a revision of the folder of outputs.",
)
@click.option("--fail-on-change", is_flag=True, help="Exit code 3 where a drawing differs from the baseline.")
@click.option("--strict", is_flag=True, help="Warnings are errors: a source with one counts as failed.")
@click.option("--init", is_flag=True, help="Write a manifest hlr.toml for the models here, to be changed at will.")
@click.option("--list", "only_list", is_flag=True, help="Print the files that would be written, and draw nothing.")
@click.option("--dry-run", is_flag=True, help="Print what would be drawn, and with --prune what would be removed.")
@click.option("--prune", is_flag=True, help="Remove drawings of earlier runs that the batch draws no more.")
@click.option(
    "--no-times",
    is_flag=True,
    help="Leave times and memory out of the report: then each run writes the same report, byte for byte.",
)
@click.option("--watch", is_flag=True, help="Stay, and draw again what changes on disk. Ctrl-C ends it.")
@NO_CACHE
@click.option("-q", "--quiet", is_flag=True, help="Print failures only, and with --fail-on-change a change.")
def batch(
    *,
    sources: tuple[str, ...],
    jobs: int | None,
    address: str | None,
    init: bool,
    only_list: bool,
    dry_run: bool,
    quiet: bool,
    **others: Any,
) -> int:
    """Draw many models, those alone that have changed, and write a report.

    \b
      hlr batch                                   # what hlr.toml here says, or all models under this folder
      hlr batch parts -o drawings --view iso
      hlr batch parts --arrange third-angle --format pdf
      hlr batch "parts/**/*.step" -o drawings --format svg --format pdf

    Exit codes: 0 all is drawn, 1 some sources failed, or the time was up, and the rest is there, 2 the batch
    itself was wrong, the report could not be written, or --on found no workers that it could use to the end, 3
    drawings differ from the baseline (--fail-on-change).
    """
    if init:
        return _init(sources)
    names = ("watch", "baseline", "fail_on_change", "prune", "no_times")
    watch, baseline, fail_on_change, prune, no_times = (others.pop(name) for name in names)
    if sum((watch, only_list, dry_run)) > 1:
        raise OptionError("--watch, --list and --dry-run contradict one another: give one of them")
    asked = Asked(sources, **others)
    asked.prunes = prune
    plan, kept, digests = _prepared(asked)
    if not quiet:
        _tell(plan, asked)
    if only_list:
        for job in plan.jobs:
            for row in job.files:
                for file in row:
                    show_path(plan.output / file)
        return 0
    if dry_run:
        _show(plan, kept, Earlier(asked, plan).drawings(plan).stale if prune else ())
        return 0
    earlier = Earlier(asked, plan, baseline, fail_on_change, prune)
    _make_folder(plan.output)
    with ExitStack() as stack:
        # Beside the drawings there is a display to take down, and workers to end.
        stop = stack.enter_context(signals.tidily())
        display = stack.enter_context(progress(quiet))
        pool = _Pool(stack, jobs, address)
        go = partial(
            _round, kept=kept, digests=digests, display=display, pool=pool, earlier=earlier, times=not no_times
        )
        code, done = go(plan)
        if watch:
            _watch(asked, done, digests, go, stop, quiet)
    return code


def _show(plan: Plan, kept: Kept, stale: Sequence[Row]) -> None:
    """Print what a run would do. stale: drawings that it would remove."""
    for job in plan.jobs:
        show(f"{'unchanged' if kept.find(job) else 'to draw  '}  {job.title}")
    for row in stale:
        show(f"to remove  {row['file']}")


def _tell(plan: Plan, asked: Asked) -> None:
    """Say what is not drawn, or has no effect, though one might expect it."""
    from hlr.batch.plan import lies_inside, shows_nothing
    from hlr.batch.without_effect import without_effect

    if (unused := asked.unused_manifest(plan)) is not None:
        remark(f"{unused} is not used, for sources are named: name it, or the folder, to draw what it says")
    if plan.silent:
        remark(shows_nothing(plan.silent))
    if plan.inside:
        remark(lies_inside(plan))
    for sentence in without_effect(plan):
        remark(sentence)


class _Pool:
    """The pool of workers, made when there is work for it. address: of a scheduler; None: processes here."""

    def __init__(self, stack: ExitStack, jobs: int | None, address: str | None) -> None:
        self._stack, self._jobs, self._address = stack, jobs, address
        self._pool: Pool | None = None

    def __call__(self) -> Pool:
        if self._pool is None:
            self._pool = self._made()
            self._stack.callback(self._pool.close)
        return self._pool

    def _made(self) -> Pool:
        if self._address is not None:
            from hlr.batch.cluster import DaskPool

            return DaskPool(self._address, self._jobs)
        from hlr.batch.pool import LocalPool

        return LocalPool(self._jobs or os.cpu_count() or 1)


def _prepared(asked: Asked) -> tuple[Plan, Kept, Digests]:
    from hlr.batch.kept import Kept
    from hlr.batch.keys import Digests
    from hlr.cache.folder import folder, most_bytes
    from hlr.cache.store import DRAWINGS, Store

    plan, where, digests = asked.plan(), folder(), Digests()
    return plan, Kept(None if where is None else Store(where, most_bytes(), DRAWINGS), digests), digests


def _round(
    plan: Plan, *, kept: Kept, digests: Digests, display: Lines, pool: _Pool, earlier: Earlier, times: bool
) -> tuple[int, Done]:
    """Draw what has changed, write the report, and say how it went. Returns the exit code, and what was done.

    times: the report says what each source has cost
    """
    from hlr.batch.ci import github
    from hlr.batch.report import write
    from hlr.batch.run import run, tidy
    from hlr.batch.stale import remove, told, told_of_part
    from hlr.batch.unused_patterns import unused_patterns

    started = time.monotonic()
    done = run(plan, kept, pool, display)
    tidy(plan.output)
    changed = earlier.changes(done)
    found = earlier.drawings(plan, done)
    old = found.stale
    left = remove(old, plan.output) if earlier.prunes else old
    try:
        report = write(done, digests, os.environ, changed, found._replace(stale=left), times)
    except WriteError as error:
        why = str(error).rstrip(".")
        raise WriteError(f"{why}; what is drawn stays, but there is no new report ({_counts(done)})") from None
    for line in github(report, plan.manifest.root, os.environ):
        show(line)
    _add_to_summary(plan.output / "summary.md")
    if not display.quiet:
        if kept.not_kept:
            remark(f"the next run draws again what it should find in the cache: it cannot be kept ({kept.not_kept})")
        for sentence in unused_patterns(done):
            remark(sentence)
        if len(left) < len(old):
            remark(f"{counted(len(old) - len(left), 'stale drawing')} removed")
        if left:
            remark(told(left, plan.output))
        if earlier.prunes and found.spared:
            remark(told_of_part(found.spared))
        say(_said(done, time.monotonic() - started))
    fails = earlier.fails and changed is not None and changed.any
    if changed is not None and (fails or not display.quiet):
        say(f"since {earlier.name}: {changed}")
    if report["counts"]["failed"]:
        return FAILED, done
    return CHANGED if fails else 0, done


def _said(done: Done, seconds: float) -> str:
    """One line about a batch."""
    return f"{done.plan.output}: {_counts(done)}, {seconds:.1f} s"


def _counts(done: Done) -> str:
    failed = sum(outcome.failure is not None for outcome in done.outcomes)
    drawn = sum(done.outcomes[number].failure is None for number in done.drawn)
    unchanged = len(done.outcomes) - len(done.drawn)
    return f"{drawn} drawn, {unchanged} unchanged, {failed} failed"


def _watch(
    asked: Asked,
    done: Done,
    digests: Digests,
    go: Callable[[Plan], tuple[int, Done]],
    stop: signals.StopRequest,
    quiet: bool,
) -> None:
    """Draw again whatever changes, until a signal ends the command. go: draws what a plan says."""
    from hlr.batch.watch import changes, concern
    from hlr.errors import HlrError

    root, output = done.plan.manifest.root, done.plan.output
    if not quiet:
        say(f"watching {root}; Ctrl-C ends it")
    outside = {Path(os.path.realpath(Path(root, job.source))) for job in done.plan.jobs}
    for changed in changes(root, output, outside, stop):
        if not concern(done, changed):
            continue
        digests.forget(changed)
        try:
            _, done = go(asked.plan())
        except HlrError as error:  # a manifest in the middle of being changed
            say(f"hlr: {error}")


def _make_folder(folder: Path) -> None:
    from hlr.drawing.files import write_all

    write_all({}, [folder])


def _add_to_summary(file: Path) -> None:
    """Add the summary to that of the job, where GitHub asks for one."""
    summary = os.environ.get("GITHUB_STEP_SUMMARY")
    if summary:
        try:
            with open(summary, "ab") as opened:
                opened.write(file.read_bytes() + b"\n")
        except OSError as error:
            say(f"hlr: warning: {summary}: {error.strerror}")


def _init(sources: tuple[str, ...]) -> int:
    """Write a manifest with all keys and what they mean."""
    from hlr.batch.first_manifest import text_for
    from hlr.batch.manifest import FILE
    from hlr.drawing.files import write_all

    folder = Path(sources[0]) if sources else Path()
    if len(sources) > 1 or not folder.is_dir():
        raise OptionError("--init takes one folder, which gets the manifest")
    file = folder / FILE
    if file.exists():
        raise OptionError(f"{file} is there already; change it, or remove it first")
    write_all({file: text_for(folder).encode()})
    say(f"{file} is written")
    return 0
