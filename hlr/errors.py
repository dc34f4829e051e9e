"""The errors a caller meets: every message says what, where, and what to do.

The command line prints the message alone and exits with code 2.
"""

from __future__ import annotations


class HlrError(Exception):
    """Base of every error that hlr raises on purpose."""


class SourceError(HlrError):
    """A file, script or object that cannot become a scene."""


class OptionError(HlrError):
    """An option outside its range, or two options that contradict one another."""


class ViewError(HlrError):
    """A view that is not defined: a zero direction, or up along the direction."""


class WriteError(HlrError):
    """An output that cannot be written."""


class StrictError(HlrError):
    """A warning, where the caller asked for warnings to be errors."""
