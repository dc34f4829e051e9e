"""What the plugin tells the helper of the run of pytest that both are part of."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path


@dataclass(slots=True)
class Session:
    """A run of tests.

    update     whether golden drawings are written anew
    beside     the folder of the test that runs, from which relative paths start; None: the current folder
    temporary  makes a new folder for what a failure shows; None: no run of pytest
    """

    update: bool = False
    beside: Path | None = None
    temporary: Callable[[], Path] | None = None


SESSION = Session()
"""Of this process."""
