"""Limits of a method's time (seconds) and memory (bytes), and their defaults."""

from __future__ import annotations

import contextlib
import math
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from hlr.errors import HlrError, OptionError

TIME_LIMIT = 60.0
"""Default, seconds."""

MEMORY_LIMIT = 4 * 2**30
"""Bytes, where nothing else is said, or a third of what there is: a table that grows needs room for twice its size
beside itself."""

KernelLimits = tuple[float, bool, float]


class NotFinishedError(HlrError):
    """A method did not finish within its limits."""


@dataclass(frozen=True, slots=True)
class Limits:
    """Limits of one call; time counts from the moment this object is made.

    seconds, bytes: math.inf for no limit; worked: count processor time of the method's own thread, not clock time
    """

    seconds: float
    bytes: float
    worked: bool = False
    started: float = field(default_factory=time.monotonic)

    def kernel(self) -> KernelLimits:
        """The limits for a call of the kernel now: what is left of the time."""
        passed = 0.0 if self.worked else time.monotonic() - self.started
        return (max(0.0, self.seconds - passed), self.worked, self.bytes)

    @contextlib.contextmanager
    def over(self, what: str) -> Iterator[None]:
        """Context around calls of the kernel; raises NotFinishedError, which says that `what` did not finish."""
        try:
            yield
        except TimeoutError:
            raise NotFinishedError(
                f"{what} did not finish within {self.seconds:g} seconds: raise time_limit, or use a smaller scene, "
                "a smaller picture or another method"
            ) from None
        except MemoryError:
            raise NotFinishedError(
                f"{what} needs more than {self.bytes / 2**20:,.0f} MiB of memory: raise memory_limit, or use a smaller "
                "scene, a smaller picture or another method"
            ) from None


def limits(time_limit: float | None = None, memory_limit: float | None = None, worked: bool = False) -> Limits:
    """Limits in seconds and bytes; None: TIME_LIMIT and MEMORY_LIMIT. Raises OptionError for a limit not above zero."""
    for name, value, unit in (("time", time_limit, "seconds"), ("memory", memory_limit, "bytes")):
        if value is not None and not value > 0.0:
            raise OptionError(f"a {name} limit of {value!r} {unit} leaves none: give a positive number")
    memory = min(float(MEMORY_LIMIT), _available() / 3.0) if memory_limit is None else float(memory_limit)
    return Limits(TIME_LIMIT if time_limit is None else float(time_limit), memory, worked)


def _available() -> float:
    """Bytes of memory that this process may still allocate, as far as the system tells."""
    found = math.inf
    with contextlib.suppress(OSError, ValueError, IndexError):
        for line in Path("/proc/meminfo").read_text("ascii").splitlines():
            if line.startswith("MemAvailable:"):
                found = float(line.split()[1]) * 1024.0
    with contextlib.suppress(ImportError, OSError, ValueError, IndexError):
        import resource

        most = resource.getrlimit(resource.RLIMIT_AS)[0]
        if most != resource.RLIM_INFINITY:
            pages = int(Path("/proc/self/statm").read_text("ascii").split()[0])
            found = min(found, max(1.0, float(most - pages * resource.getpagesize())))
    return found
