"""The cache's folder and its largest size, as HLR_CACHE and HLR_CACHE_SIZE set them."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from hlr.errors import OptionError

VARIABLE, SIZE_VARIABLE = "HLR_CACHE", "HLR_CACHE_SIZE"

DEFAULT_SIZE = 1_000_000_000
"""Bytes."""

_OFF = ("off", "no", "none", "0", "false")
_UNITS = {"": 1, "b": 1, "kb": 10**3, "mb": 10**6, "gb": 10**9, "tb": 10**12} | {
    "kib": 1 << 10,
    "mib": 1 << 20,
    "gib": 1 << 30,
    "tib": 1 << 40,
}


def folder() -> Path | None:
    """The cache's folder, which may not exist yet; None where the cache is off."""
    named = os.environ.get(VARIABLE, "").strip()
    if named.lower() in _OFF:
        return None
    if named:
        return Path(named).expanduser()
    from platformdirs import user_cache_path

    return user_cache_path("hlr", appauthor=False)


def most_bytes() -> int:
    """The most bytes that all entries together may take.

    Raises:
        OptionError: HLR_CACHE_SIZE is not a size.
    """
    text = os.environ.get(SIZE_VARIABLE, "").strip()
    if not text:
        return DEFAULT_SIZE
    match = re.fullmatch(r"([0-9]{1,15}(?:\.[0-9]{1,15})?)\s*([kmgt]?i?b|)", text.lower())
    if match is None or match[2] not in _UNITS:
        raise OptionError(f"{SIZE_VARIABLE} is {text!r}: give a size such as 500MB or 2GB")
    return int(float(match[1]) * _UNITS[match[2]])


@contextmanager
def without_cache() -> Iterator[None]:
    """Within this block the cache is off, here and in programs started from here."""
    before = os.environ.get(VARIABLE)
    os.environ[VARIABLE] = "off"
    try:
        yield
    finally:
        if before is None:
            del os.environ[VARIABLE]
        else:
            os.environ[VARIABLE] = before
