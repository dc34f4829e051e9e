"""How many threads the kernel uses."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def at_most(threads: int) -> Iterator[None]:
    """Within it the kernel uses this many threads for the calls of this thread; 0: as many as without it."""
    if threads == 0:
        yield
        return
    from hlr import _kernel

    before = _kernel.limit_threads(threads)
    try:
        yield
    finally:
        _kernel.limit_threads(before)
