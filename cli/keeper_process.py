"""The child process of `keeper`: reads lengths and contents until its input ends, then writes the last content.

A content that arrived only in part, because its sender was stopped, is dropped.
"""

from __future__ import annotations

import os
import signal
import sys


def main() -> int:
    """Returns the exit code: 0 written, 1 nobody reads standard output."""
    # Ctrl-C reaches the whole group of processes; this one ends when the other has.
    for name in ("SIGINT", "SIGTERM", "SIGHUP"):
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), signal.SIG_IGN)
    last = b""
    while len(head := sys.stdin.buffer.read(8)) == 8:
        size = int.from_bytes(head, "little")
        data = sys.stdin.buffer.read(size)
        if len(data) < size:
            break
        last = data
    try:
        left = memoryview(last)
        while left:
            left = left[os.write(1, left) :]
    except OSError:
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
