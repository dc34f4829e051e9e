"""Sources: from a file, a script or an object in memory to parts that can be meshed."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hlr.errors import OptionError, SourceError
from hlr.source.model import Source
from hlr.tables.readers import ENDINGS

if TYPE_CHECKING:
    from hlr.source.cad.brep_source import BrepSource

__all__ = ["ENDINGS", "open_source"]


def open_source(thing: Any, var: str | None = None, annotations: bool = False) -> Source:
    """Open anything that can be drawn.

    Args:
        thing: the name of a file (see `ENDINGS`), a CadQuery, build123d, OpenCASCADE, trimesh or manifold3d object, a
            list of CAD objects, or a pair (vertices (n, 3), faces (m, 3)). A source that is open already stays as it
            is.
        var: the variable of a script to draw, instead of what it shows.
        annotations: faces of annotation, hidden or supplemental in a STEP file, count as well.

    Raises:
        SourceError: it cannot be drawn; the message says why and what to do, in one sentence.
        OptionError: it has no such variable.
    """
    if isinstance(thing, str | os.PathLike):
        return _open_path(Path(os.fspath(thing)), var, annotations)
    from hlr.source.cad.objects import package_of

    if type(thing).__module__.startswith("hlr.source."):
        opened: Source = thing
        return opened
    if var is not None:
        raise OptionError("var names a variable of a script, and an object is no script: leave it out.")
    root = package_of(thing)
    if root == "trimesh":
        from hlr.source.mesh.objects import open_trimesh

        return open_trimesh(thing)
    if root == "manifold3d":
        from hlr.source.mesh.objects import open_manifold

        return open_manifold(thing)
    if _is_arrays(thing):
        from hlr.source.mesh.objects import open_arrays

        return open_arrays(*thing)
    from hlr.source.cad.objects import is_shape_like, open_object

    if is_shape_like(thing):
        return open_object(thing)
    raise SourceError(
        f"An object of type {type(thing).__name__} cannot be drawn: pass a CadQuery, build123d, OpenCASCADE, trimesh "
        "or manifold3d object, (vertices, faces), or the name of a file."
    )


def _is_arrays(thing: Any) -> bool:
    """Whether this is a pair of number tables, without asking CAD objects to become arrays."""
    if not isinstance(thing, tuple | list) or len(thing) != 2:
        return False
    return all(hasattr(item, "dtype") or (isinstance(item, list | tuple) and _is_rows(item)) for item in thing)


def _is_rows(item: list[Any] | tuple[Any, ...]) -> bool:
    return bool(item) and all(isinstance(row, list | tuple) or hasattr(row, "dtype") for row in item)


def _open_path(path: Path, var: str | None, annotations: bool) -> Source:
    from hlr.source.file_checks import check_readable

    kind = ENDINGS.get(path.suffix.lower())
    check_readable(path)
    if kind is None:
        known = " ".join(ENDINGS)
        ending = f'the ending "{path.suffix}"' if path.suffix else "no ending"
        raise SourceError(f"{path.name} has {ending}, which hlr cannot read: use one of {known}.")
    if kind == "script":
        from hlr.source.cad.script import open_script

        return open_script(path, var)
    if var is not None:
        raise OptionError(f"var names a variable of a script, and {path.name} is no script: leave it out.")
    if kind in ("step", "iges", "brep"):
        from hlr.source.cad.cached_files import read_through_cache

        return read_through_cache(
            path, kind, annotations and kind == "step", lambda: _read_cad(path, kind, annotations)
        )
    if kind in ("3mf", "glb"):
        from hlr.source.mesh.glb_3mf import open_glb_or_3mf

        return open_glb_or_3mf(path, kind)
    from hlr.source.mesh.mesh_file import open_mesh_file

    return open_mesh_file(path, kind)


def _read_cad(path: Path, kind: str, annotations: bool) -> BrepSource:
    """A STEP, IGES or BREP file as OpenCASCADE reads it."""
    if kind == "brep":
        from hlr.source.cad.brep_file import open_brep

        return open_brep(path)
    from hlr.source.cad.iges import open_iges
    from hlr.source.cad.step import open_step

    return open_step(path, annotations) if kind == "step" else open_iges(path)
