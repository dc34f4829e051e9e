"""Sources: from a file, a script or an object in memory to parts that can be meshed."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from hlr.errors import OptionError, SourceError
from hlr.request.options import Parameter
from hlr.source.model import Source, is_source, missing_of_source
from hlr.tables.entry import listed
from hlr.tables.readers import Reader, endings, of_ending, of_objects, what_to_pass

if TYPE_CHECKING:
    from hlr.source.cad.cached_files import FileSource

__all__ = ["open_source"]


def open_source(
    thing: Any,
    var: str | None = None,
    annotations: bool = False,
    parameters: Mapping[str, Parameter] | None = None,
    hidden_objects: bool = False,
) -> Source:
    """Open anything that can be drawn, with the reader of `hlr.tables.readers` that accepts it.

    Args:
        thing: the name of a file, a CadQuery, build123d, OpenCASCADE, trimesh or manifold3d object, a pair (vertices
            (n, 3), faces (m, 3)), a list of CAD objects and meshes, or a dict that gives them names. Whatever
            follows the protocol `Source` is open already and stays as it is.
        var: the variable of a script to draw, instead of what it shows.
        annotations: faces of annotation, hidden or supplemental in a STEP file, count as well.
        parameters: values for variables of a script.
        hidden_objects: objects that a FreeCAD document hides count as well.

    Raises:
        SourceError: it cannot be drawn; the message says why and what to do, in one sentence.
        OptionError: var or a parameter is given, and the script has no such variable, or `thing` is no script.
    """
    if isinstance(thing, str | os.PathLike):
        if os.fspath(thing) == "":
            raise SourceError("the name of the source is empty: name a model file.")
        of_file = {"annotations": annotations, "hidden_objects": hidden_objects}
        return _open_path(Path(os.fspath(thing)), {"var": var, "parameters": parameters or None}, of_file)
    if is_source(thing):
        opened: Source = thing
        return opened
    _only_of_scripts({"var": var, "parameters": parameters or None}, (), "an object")
    reader = next((reader for reader in of_objects() if reader.opens(thing)), None)
    if reader is not None:
        return _opened(reader, thing, type(thing).__name__)
    raise SourceError(f"An object of type {type(thing).__name__} cannot be drawn: {_cure(thing)}.")


def _cure(thing: object) -> str:
    """What to pass instead of an object that nothing opens."""
    from hlr.source.collected import why_not_read
    from hlr.source.joined import are_both

    if (why := why_not_read(thing, are_both)) is not None:
        return why
    missing = list(missing_of_source(thing))
    if len(missing) <= FEW:
        return f"as a source (hlr.source.model.Source) it lacks {listed(missing, 'and')}"
    return f"pass {what_to_pass()}"


FEW = 4
"""An object that lacks at most this many members of the protocol is taken for an incomplete source."""


def _open_path(path: Path, of_script: Mapping[str, Any], of_file: Mapping[str, bool]) -> Source:
    from hlr.source.file_checks import check_readable, content_of

    reader = of_ending(path.suffix)
    check_readable(path)
    if reader is None:
        known = " ".join(endings())
        if path.suffix:
            raise SourceError(f'{path.name} has the ending "{path.suffix}", which hlr cannot read: use one of {known}.')
        raise SourceError(
            f"{path.name} has no ending, and hlr goes by it: it looks like {content_of(path)}; use {known}."
        )
    _only_of_scripts(of_script, reader.takes, path.name)
    given = {**of_script, **of_file}
    if not reader.cached:
        return _opened(reader, path, path.name, **given)
    from hlr.source.cad.cached_files import read_through_cache

    all_of_it = any(asked and name in reader.takes for name, asked in of_file.items())
    return read_through_cache(
        path, reader.kind, all_of_it, lambda: cast("FileSource", _opened(reader, path, path.name, **given))
    )


def _only_of_scripts(given: Mapping[str, Any], takes: tuple[str, ...], what: str) -> None:
    """Raise OptionError where something is given that only scripts take. takes: what the reader does."""
    for name, value in given.items():
        if value is not None and name not in takes:
            raise OptionError(f"{_OF_SCRIPTS[name]} of a script, and {what} is no script: leave it out.")


_OF_SCRIPTS = {"var": "`var` names a variable", "parameters": "`parameters` names variables"}


def _opened(reader: Reader, thing: Any, name: str, **given: Any) -> Source:
    """What the reader opens; a package that it needs and does not find is an error in one sentence."""
    try:
        source: Source = reader.open(thing, kind=reader.kind, **given)
    except ModuleNotFoundError as error:
        if not reader.needs or error.name != reader.needs:
            raise
        raise SourceError(
            f"{name} cannot be read: {reader.title} needs the Python package {reader.needs}; install it."
        ) from None
    return source
