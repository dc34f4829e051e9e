"""How many threads the kernel uses."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext

_AS_MANY_AS_BEFORE = nullcontext()
"""It changes nothing, so all may share it."""


def at_most(threads: int) -> AbstractContextManager[None]:
    """Within it the kernel uses this many threads for the calls of this thread; 0: as many as without it."""
    return _limited(threads) if threads else _AS_MANY_AS_BEFORE


@contextmanager
def _limited(threads: int) -> Iterator[None]:
    from hlr import _kernel

    before = _kernel.limit_threads(threads)
    try:
        yield
    finally:
        _kernel.limit_threads(before)
