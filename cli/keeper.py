"""Standard output for drawings that better ones may replace: the last one is written when this process ends, however.

A process of its own holds what was given last. When its input ends, for nobody is left to give it more, it writes that
to standard output; so Ctrl-C, which ends this process at once, does not take the finished drawing with it.
"""

from __future__ import annotations

import contextlib
import subprocess
import sys
from collections.abc import Callable, Iterator

from . import guard
from .streams import Output, ReaderGoneError


@contextlib.contextmanager
def kept(out: Output) -> Iterator[Callable[[bytes], None]]:
    """Yield what takes the content; what it was called with last is written."""
    child = subprocess.Popen(
        [sys.executable, "-P", "-m", f"{__package__}.keeper_process"],
        stdin=subprocess.PIPE,
        stdout=out.descriptor,
        pass_fds=guard.kept_open(),
    )
    assert child.stdin is not None
    stdin = child.stdin

    def keep(data: bytes) -> None:
        stdin.write(len(data).to_bytes(8, "little") + data)
        stdin.flush()

    try:
        yield keep
    finally:
        with contextlib.suppress(OSError):
            stdin.close()
        code = child.wait()
    if code:
        raise ReaderGoneError
