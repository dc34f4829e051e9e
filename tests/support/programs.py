"""Runs programs from tests with the same import path, so that they can import the tests' helpers."""

import os
from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]


def environment(**more: str) -> dict[str, str]:
    """The environment of this process, with the folder `tests` on PYTHONPATH, and with the variables `more`."""
    paths = [str(TESTS), *filter(None, [os.environ.get("PYTHONPATH")])]
    return os.environ | {"PYTHONPATH": os.pathsep.join(paths)} | more
