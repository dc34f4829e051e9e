"""Which package an object in memory comes from, without importing it."""

from __future__ import annotations

from typing import Any

_KNOWN = {"cadquery", "build123d", "OCP", "trimesh", "manifold3d"}


def package_of(thing: Any) -> str:
    """The top-level package of the object's class or a base class; a package that hlr knows where there is one."""
    roots = [cls.__module__.partition(".")[0] for cls in type(thing).__mro__]
    for root in roots:
        if root in _KNOWN:
            return root
    return roots[0]
