"""Standard output belongs to the result.

Scripts print, and so do libraries underneath Python. While a drawing is computed their output is sent to standard
error; what was standard output is kept aside for the result.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import BinaryIO

from hlr.errors import WriteError


@contextmanager
def result_only() -> Iterator[BinaryIO]:
    """Yield standard output as a binary stream; within this block nothing else can write to it."""
    sys.stdout.flush()
    try:
        kept = os.dup(1)
    except OSError as error:
        raise WriteError("cannot write to standard output: it is closed") from error
    os.dup2(2, 1)
    try:
        with os.fdopen(kept, "wb", closefd=False) as stream:
            yield stream
    finally:
        sys.stdout.flush()
        os.dup2(kept, 1)
        os.close(kept)


def put(stream: BinaryIO, data: bytes) -> None:
    """Write all of it. Raises WriteError where the system refuses, BrokenPipeError where the reader has gone."""
    try:
        stream.write(data)
        stream.flush()
    except BrokenPipeError:
        raise
    except OSError as error:
        reason = error.strerror or str(error)
        raise WriteError(f"cannot write to standard output: {reason[:1].lower()}{reason[1:]}") from error
