"""Names and versions of installed packages, told by their files: nothing is imported."""

from __future__ import annotations

import os
import sys
from functools import cache
from importlib.util import find_spec
from pathlib import Path


@cache
def installed() -> list[str]:
    """Names and versions of all installed packages, from the names of their folders."""
    found: set[str] = set()
    for folder in filter(os.path.isdir, sys.path):
        found.update(name for name in os.listdir(folder) if name.endswith((".dist-info", ".egg-info")))
    return sorted(name.rpartition(".")[0] for name in found)


def bindings() -> list[str]:
    """Names and versions of OpenCASCADE's bindings: of what lies beside the package OCP; else its date and size."""
    try:
        spec = find_spec("OCP")
    except ValueError:
        spec = None
    if spec is None or spec.origin is None:
        return ["none"]
    state, package = os.stat(spec.origin), Path(spec.origin)
    beside = package.parent.parent if spec.submodule_search_locations else package.parent
    named = sorted(name for name in os.listdir(beside) if "ocp" in name.lower() and name.endswith(".dist-info"))
    return named or [f"{state.st_mtime_ns} {state.st_size}"]
