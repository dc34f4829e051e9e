"""The errors a caller meets: every message says what, where, and what to do.

The command line prints the message alone and exits with code 2.
"""

from __future__ import annotations

import re
from collections.abc import Callable

LONGEST = 1000
"""Characters of a message: it may repeat what it was given, but not a whole array."""


class HlrError(Exception):
    """Base of every error that hlr raises on purpose; its message is one line that ends with a full stop, whatever it
    quotes."""

    def __init__(self, message: str) -> None:
        words = " ".join(message.split())
        words = words if len(words) <= LONGEST else words[: LONGEST - 4] + " ..."
        super().__init__(words if words.endswith((".", "!", "?")) else words + ".")


class SourceError(HlrError):
    """A file, script or object that cannot become a scene."""


class OptionError(HlrError):
    """An option outside its range, or two options that contradict one another.

    Names of options that Python and the command line spell differently stand in `backticks` (`respelled`).
    """


class ViewError(HlrError):
    """A view that is not defined: a zero direction, or up along the direction."""


class WriteError(HlrError):
    """An output that cannot be written."""


class StrictError(HlrError):
    """A warning, where the caller asked for warnings to be errors."""


class ClusterError(HlrError):
    """Other machines that cannot be reached, have gone, or would draw other bytes."""


class KernelError(HlrError):
    """A fault of hlr itself, in its kernel: worth a report. The command line ends with exit code 1."""


def respelled(message: str, spell: Callable[[str], str]) -> str:
    """A message with the options that it names in `backticks` spelled in another way."""
    return re.sub("`([a-z_]+)`", lambda name: spell(name[1]), message)


def counted(number: int, what: str, several: str = "") -> str:
    """A number with its noun: 1 edge, 2 edges. several: the plural, where it is not the noun with an s."""
    return f"{number} {what}" if number == 1 else f"{number} {several or what + 's'}"
