"""Standard output for drawings that finer ones replace: the last one is written, however this process ends.

A child process holds the last drawing. When its input ends, it writes that drawing to standard output. So Ctrl-C, which
ends this process at once, loses no finished drawing.
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
    """Yield a function that takes a drawing's bytes. The bytes of its last call are written."""
    child = subprocess.Popen(
        [sys.executable, "-P", "-m", f"{__package__}.keeper_process"],
        stdin=subprocess.PIPE,
        stdout=out.descriptor,
        pass_fds=guard.kept_open(),
    )
    guard.helped_by(child.pid)
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
