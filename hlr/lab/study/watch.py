"""A stopwatch: clock time, processor time and memory of each stage."""

from __future__ import annotations

import contextlib
import sys
import time
from pathlib import Path

from hlr.lab.study.job import Cost

_STATUS, _RESET = Path("/proc/self/status"), Path("/proc/self/clear_refs")


class Watch:
    """A stopwatch, called with a stage's name when it begins, as the pipeline's `Progress`. `stop` ends the last."""

    def __init__(self) -> None:
        self.stages: dict[str, Cost] = {}
        self._now: str | None = None
        self._wall = self._cpu = 0.0

    def __call__(self, stage: str, _fraction: float = 0.0) -> None:
        """Begin a stage, unless it is running already."""
        if stage == self._now:
            return
        self.stop()
        self._now = stage
        _forget_peak()
        self._wall, self._cpu = time.perf_counter(), time.process_time()

    def stop(self) -> None:
        """End the current stage."""
        if self._now is None:
            return
        cost = self.stages.setdefault(self._now, Cost())
        cost.wall += time.perf_counter() - self._wall
        cost.cpu += time.process_time() - self._cpu
        cost.memory = max(cost.memory, peak_memory())
        self._now = None


def peak_memory() -> float:
    """Peak resident memory in MB since `Watch` last began a stage; on systems other than Linux, since the start."""
    with contextlib.suppress(OSError):
        for line in _STATUS.read_text("ascii", "replace").splitlines():
            if line.startswith("VmHWM:"):
                return int(line.split()[1]) / 1024.0
    try:
        import resource
    except ImportError:  # Windows
        return 0.0
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / (1024.0 * 1024.0 if sys.platform == "darwin" else 1024.0)


def _forget_peak() -> None:
    """Reset the peak that Linux keeps for this process: proc(5), clear_refs."""
    with contextlib.suppress(OSError):
        _RESET.write_text("5", "ascii")
