"""The `hlr` command."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NoReturn


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Run the command line and leave the process with its exit code: 0 done, 2 refused, 1 a fault of hlr.

    Without arguments it takes those of the process, which then is the command's own and guarded against crashes.
    """
    from .app import command
    from .exits import run

    if arguments is None:
        from .guard import allow

        allow()
    run(command, arguments)
