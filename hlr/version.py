"""Which version of hlr this is."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError, version


def own_version() -> str:
    """The version of the distribution that is installed: the usual one, or the one for build123d."""
    try:
        return version("hlr-drawing")
    except PackageNotFoundError:
        return version("hlr-drawing-build123d")
