"""Whether this process is hlr's own: that of the command line, in which nobody else imports anything."""

from __future__ import annotations


class _Process:
    own = False


def claim() -> None:
    """From now on it is."""
    _Process.own = True


def is_own() -> bool:
    """Whether it was claimed."""
    return _Process.own
