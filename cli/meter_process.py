"""The child process of `meter`: reads lines "fraction stage" until its input ends, and draws the progress bar.

Work that ends within a second shows no bar, and rich is not imported for it.
"""

from __future__ import annotations

import signal
import sys
import threading
from queue import Empty, SimpleQueue

_DELAY = 1.0

Report = tuple[float, str]


def main() -> None:
    """Draw until the input ends."""
    # Ctrl-C reaches the whole group of processes; this one ends when the other has.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    reports: SimpleQueue[Report | None] = SimpleQueue()
    threading.Thread(target=_read, args=(reports,), daemon=True).start()
    latest = _wait(reports)
    if latest is not None:
        _draw(reports, latest)


def _read(reports: SimpleQueue[Report | None]) -> None:
    for line in sys.stdin:
        fraction, _, stage = line.strip().partition(" ")
        reports.put((float(fraction), stage))
    reports.put(None)


def _wait(reports: SimpleQueue[Report | None]) -> Report | None:
    """The last report after the delay; None where all was done by then."""
    import time

    latest: Report = (0.0, "starting")
    end = time.monotonic() + _DELAY
    while (left := end - time.monotonic()) > 0.0:
        try:
            report = reports.get(timeout=left)
        except Empty:
            break
        if report is None:
            return None
        latest = report
    return latest


def _draw(reports: SimpleQueue[Report | None], report: Report | None) -> None:
    from rich.console import Console
    from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    columns = (SpinnerColumn(), TextColumn("{task.description:<12}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("", total=1.0)
        while report is not None:
            fraction, stage = report
            # A stage that cannot tell how far it is gets a bar that only moves.
            bar.update(task, description=stage, completed=fraction, total=1.0 if fraction > 0.0 else None)
            report = reports.get()


if __name__ == "__main__":
    main()
