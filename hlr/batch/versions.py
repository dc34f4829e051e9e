"""What the bytes of a drawing depend on besides the model: hlr itself, OpenCASCADE, and other packages."""

from __future__ import annotations

import os
import platform
from collections.abc import Mapping
from functools import cache
from hashlib import blake2b
from pathlib import Path

from hlr.common.packages import bindings, installed

LIBRARIES = ("ezdxf", "fonttools", "lxml", "manifold3d", "networkx", "numpy", "pillow", "pydyf", "trimesh")
"""Packages beside OpenCASCADE that read models or write files."""

_NOT_DRAWING = ("batch", "cli", "compat", "docs", "kernel", "lab")
"""Folders of hlr whose code no drawing depends on; the kernel counts as it is compiled."""

_SCRIPTS = ("build123d", "cadquery")
"""Packages that scripts are written for."""

_COMPILED, _SOURCES = (".so", ".pyd"), (".py",)


@cache
def program(endings: tuple[str, ...] = (*_SOURCES, *_COMPILED), besides: tuple[str, ...] = _NOT_DRAWING) -> str:
    """Digest of hlr's own code and of its kernel: in a checkout they change more often than the version.

    endings: of files that count. besides: folders that do not.
    """
    digest = blake2b(digest_size=20)
    home = Path(__file__).parents[1]
    for folder, folders, names in os.walk(home):
        folders[:] = sorted(name for name in folders if not (Path(folder) == home and name in besides))
        for name in sorted(names):
            if name.endswith(endings):
                digest.update(name.encode() + b"\0" + Path(folder, name).read_bytes())
    return digest.hexdigest()


@cache
def libraries(names: tuple[str, ...] = LIBRARIES) -> tuple[str, ...]:
    """Names and versions of those of these packages that are installed."""
    return tuple(name for name in installed() if name.partition("-")[0].lower() in names)


def versions() -> dict[str, str]:
    """What has to be the same on two machines for the same bytes: a version of each thing, by its name."""
    from importlib.metadata import version

    other_rooms = tuple(name for name in _NOT_DRAWING if name != "batch")
    found = {
        "hlr": f"{version('hlr-drawing')} ({program(_SOURCES, other_rooms)[:8]})",
        # Another system has another file of the same kernel.
        f"{_KERNEL} for {platform.system()} {platform.machine()}": program(_COMPILED)[:8],
        "OpenCASCADE": ", ".join(bindings()),
    }
    for each in libraries((*LIBRARIES, *_SCRIPTS)):
        name, _, number = each.partition("-")
        found[name] = number
    return found


def difference(here: Mapping[str, str], there: Mapping[str, str]) -> str:
    """What differs first between the versions of two machines, in words; empty where nothing does."""
    for name in dict.fromkeys((*here, *there)):
        one, other = here.get(name, "none"), there.get(name, "none")
        if one != other and not (name.startswith(_KERNEL) and "none" in (one, other)):
            return f"{name} is {other} there and {one} here"
    return ""


_KERNEL = "the kernel of hlr"
