"""The `hlr` command."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NoReturn


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Run the command line and end the process with its exit code: 0 done, 2 refused, 70 a fault of hlr.

    `compare` and `batch` have 1 and 3 besides, as their help texts say.

    arguments: None for those of the process. The process then belongs to the command, and a crash becomes an error.
    """
    from .app import command
    from .exits import run

    if arguments is None:
        from .guard import allow

        allow()
    run(command, arguments)
