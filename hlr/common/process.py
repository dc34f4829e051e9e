"""Whether this process belongs to the command line alone, so that no other program imports modules in it."""

from __future__ import annotations


class _Process:
    own = False


def claim() -> None:
    """Declare that this process is the command line's own."""
    _Process.own = True


def is_own() -> bool:
    """Whether this process is the command line's own."""
    return _Process.own
