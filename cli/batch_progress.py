"""What is said while a batch runs: a live display on a terminal, a line for each source elsewhere."""

from __future__ import annotations

import sys
import time
from collections.abc import Sequence
from types import TracebackType
from typing import TYPE_CHECKING

from hlr.batch.run import source_size
from hlr.batch.script_output import last_lines
from hlr.common.printable import printable
from hlr.errors import counted

from .signals import Stopped
from .streams import say

if TYPE_CHECKING:
    from rich.live import Live
    from rich.table import Table

    from hlr.batch.job import Outcome
    from hlr.batch.plan import Plan

_LINES_PRINTED = 10
"""Lines that are shown of what a script has printed that fails; the report has more."""


class Lines:
    """A line for each source that was drawn, on standard error. quiet: for failures only."""

    def __init__(self, quiet: bool) -> None:
        self.quiet = quiet
        self._total = self._ended = 0

    def planned(self, plan: Plan, todo: Sequence[int]) -> None:
        """As of `hlr.batch.run.Listener`."""
        self._plan, self._total, self._ended = plan, len(todo), 0

    def begun(self, number: int, stage: str) -> None:
        """As of `Listener`; a line at the end is enough."""

    def ended(self, number: int, outcome: Outcome) -> None:
        """As of `Listener`."""
        self._ended += 1
        if outcome.failure is not None or not self.quiet:
            say(f"{self._ended}/{self._total} {told(self._plan, number, outcome)}", *_printed(outcome))

    def out_of_time(self, left: int) -> None:
        """As of `Listener`."""
        those = "it" if left == 1 else "them"
        say(
            f"the time of the batch is up: {left} of {self._total} sources {'is' if left == 1 else 'are'} not drawn; "
            f"the next run goes on with {those}"
        )

    def __enter__(self) -> Lines:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Of a run that is ended in the middle, say how far it has come."""
        if kind is not None and issubclass(kind, Stopped) and self._ended < self._total and not self.quiet:
            say(f"stopped: {self._ended} of {self._total} sources are done; there is no new report")


class Display(Lines):
    """A bar with the time left, and below it what is running; failures stay above it."""

    def __init__(self) -> None:
        super().__init__(quiet=False)
        self._live: Live | None = None

    def planned(self, plan: Plan, todo: Sequence[int]) -> None:
        """As of `Listener`."""
        super().planned(plan, todo)
        self._weights = {number: 1e5 + source_size(plan.jobs[number]) for number in todo}
        self._done, self._started = 0.0, time.monotonic()
        self._running: dict[int, tuple[str, float]] = {}
        if todo:
            from rich.console import Console
            from rich.live import Live

            console = Console(stderr=True)
            self._live = Live(console=console, transient=True, get_renderable=self._picture)
            self._live.start()

    def begun(self, number: int, stage: str) -> None:
        """As of `Listener`."""
        _, since = self._running.get(number, ("", time.monotonic()))
        self._running[number] = (stage, since)

    def ended(self, number: int, outcome: Outcome) -> None:
        """As of `Listener`."""
        self._ended += 1
        self._running.pop(number, None)
        self._done += self._weights[number]
        if self._live is not None and (outcome.failure is not None or outcome.warned):
            lines = (told(self._plan, number, outcome), *map(printable, _printed(outcome)))
            self._live.console.print("\n".join(lines), markup=False, highlight=False)
        if self._ended == self._total:
            self._stop()

    def out_of_time(self, left: int) -> None:
        """As of `Listener`."""
        self._stop()
        super().out_of_time(left)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._stop()
        super().__exit__(kind, error, trace)

    def _stop(self) -> None:
        if self._live is not None:
            self._live.stop()
            self._live = None

    def _picture(self) -> Table:
        from rich.progress_bar import ProgressBar
        from rich.table import Table
        from rich.text import Text

        now, whole = time.monotonic(), sum(self._weights.values())
        share = self._done / whole
        left = f"{(now - self._started) * (1.0 - share) / share:.0f} s left" if share > 0.0 else ""
        grid = Table.grid(padding=(0, 1))
        grid.add_row(Text(f"{self._ended}/{self._total}"), ProgressBar(1.0, share, width=30), Text(left))
        for number, (stage, since) in sorted(self._running.items()):
            title = printable(self._plan.jobs[number].title)
            grid.add_row(Text(""), Text(f"{title}: {stage}"), Text(f"{now - since:.0f} s"))
        return grid


def told(plan: Plan, number: int, outcome: Outcome) -> str:
    """One line about a job that has ended."""
    title = printable(plan.jobs[number].title)
    if outcome.failure is not None:
        return f"{title}: failed: {printable(' '.join(outcome.failure.message.split()))}"
    warnings = len({note["text"] for drawing in outcome.drawings for note in drawing["notes"] if note["warning"]})
    told = f", {warnings} warning{'s' if warnings > 1 else ''}" if warnings else ""
    drawings = counted(len(outcome.drawings), "page" if plan.jobs[number].arrange else "view")
    return f"{title}: {drawings}, {outcome.seconds:.1f} s{told}"


def _printed(outcome: Outcome) -> list[str]:
    """The last lines that a script has printed which failed."""
    return [f"    {line}" for line in last_lines(outcome.printed, _LINES_PRINTED)]


def progress(quiet: bool) -> Lines:
    """What suits standard error."""
    terminal = sys.stderr is not None and sys.stderr.isatty()
    return Display() if terminal and not quiet else Lines(quiet)
