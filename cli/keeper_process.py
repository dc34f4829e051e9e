"""The process that holds what is to be written: reads lengths and contents until its input ends, writes the last one.

What has arrived only in part, because the writer was stopped, is forgotten.
"""

from __future__ import annotations

import os
import signal
import sys


def main() -> int:
    """0: written; 1: nobody reads standard output."""
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
