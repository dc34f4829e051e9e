"""The `hlr` command."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NoReturn


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Run the command line and leave the process with its exit code: 0 done, 2 refused, 1 a fault of hlr."""
    from .app import command
    from .exits import run

    run(command, arguments)
