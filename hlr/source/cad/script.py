"""CAD scripts: a Python file is run, and the objects that it shows are drawn.

The file runs with the caller's rights. As in CQ-editor and cq-cli the script finds
`show_object(obj, name=None, options=None)` and `debug(obj)`, and its `__name__` is "__cq_main__". `show(...)` is there
for scripts written for viewers, whether they import it or not (`hlr.source.cad.viewers`). The first of these that
exists is drawn:

1. the variable that the caller names;
2. all objects that the script shows;
3. the variable `result`;
4. the solid that was assigned last, else the last face, else the last shape or mesh.

A remark in the drawing names the choice. Meshes are drawn where none of it is a CAD object. What stands under
`if __name__ == "__main__":` is run where nothing is there to draw without it, or where it shows something and nothing
else is shown or called `result` (`main_block`).
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from hlr.drawing.notes import Note
from hlr.errors import SourceError
from hlr.request.options import Parameter
from hlr.source.cad.brep_source import BrepSource
from hlr.source.cad.objects import is_shape_like, to_leaves
from hlr.source.cad.occt_import import load_occt
from hlr.source.cad.script_choice import RESULT_VARIABLE, is_shape, objects_to_draw, passes
from hlr.source.cad.script_run import run
from hlr.source.cad.source_builder import build_source
from hlr.source.cad.viewers import Showing, Shown
from hlr.source.collected import left_out_of, why_not_read
from hlr.source.mesh.mesh_source import MeshSource
from hlr.source.mesh.open_objects import are_meshes, mesh_source, read_meshes
from hlr.tables.entry import listed


def open_script(
    path: Path, var: str | None = None, parameters: Mapping[str, Parameter] | None = None
) -> BrepSource | MeshSource:
    """Run a script; its parts are the objects that it shows, or the variable named `var`. Meshes load no OpenCASCADE.

    parameters: values for variables of the script, as `hlr.source.cad.script_parameters` says.

    Raises:
        SourceError: the script fails (line and exception are named), or shows nothing.
        OptionError: it has no such variable, or that is no shape; it has no such parameter, or one of another kind.
    """
    # The script runs in its own folder, where a relative path would mean another file.
    path = path.absolute()
    showing = Showing()
    values = run(path, showing, parameters or {}, var)
    chosen, why = objects_to_draw(path, showing.shown, values, var)
    meshes = {type(thing).__name__ for thing, _, _ in chosen if passes(thing, are_meshes)}
    of_meshes = bool(meshes) and not any(passes(thing, is_shape_like) for thing, _, _ in chosen)
    if not of_meshes:
        load_occt()
    read: list[Any] = []
    left_out: dict[str, SourceError] = {}
    for thing, name, look in chosen:
        try:
            read.extend((read_meshes if of_meshes else to_leaves)(thing, name or path.stem, *look))
        except SourceError as error:
            left_out[type(thing).__name__] = error
    if left_out and not read:
        raise SourceError(f"{path.name} shows something that is no shape: {next(iter(left_out.values()))}")
    if not read:
        raise SourceError(_nothing_shown(path, values, [type(thing).__name__ for thing, _, _ in chosen]))
    if others := [kind for kind in left_out if kind not in meshes]:
        why += f", without what is no shape ({', '.join(others)})"
    if len(others) < len(left_out):
        why += (
            f", without meshes ({', '.join(sorted(meshes & left_out.keys()))}), which are drawn apart from CAD objects"
        )
    if of_meshes:
        return mesh_source(path.name, read, _remarks(path, chosen, why))
    return build_source(path.name, "script", read, _remarks(path, chosen, why))


def _remarks(path: Path, chosen: list[Shown], why: str) -> list[Note]:
    """Which objects are drawn, and what in them is not."""
    missing = [note for thing, _, _ in chosen for note in left_out_of(thing)]
    return [Note("script-shape", f"{path.name}: {why}."), *missing]


def _nothing_shown(path: Path, values: dict[str, Any], empty: list[str]) -> str:
    """One sentence on a script that shows nothing. empty: types of what it shows, without a shape in it."""
    if empty:
        what = listed(list(dict.fromkeys(empty)), "and")
        return f"{path.name} shows something without a shape in it ({what}): there is nothing to draw."
    if RESULT_VARIABLE in values and not is_shape(value := values[RESULT_VARIABLE]):
        why = why_not_read(value, (is_shape_like, are_meshes)) or "assign a shape to it"
        return f'The variable "{RESULT_VARIABLE}" of {path.name} is no shape, but {type(value).__name__}: {why}.'
    return f'{path.name} shows nothing: call show_object(shape) in it, or assign the shape to a variable "result".'
