"""CAD scripts: a Python file is run, and the objects that it shows are drawn.

The file runs with the caller's rights. As in CQ-editor and cq-cli the script finds
`show_object(obj, name=None, options=None)` and `debug(obj)`, and its `__name__` is "__cq_main__". `show(...)` is there
for scripts written for viewers, whether they import it or not (`hlr.source.cad.viewers`). The first of these that
exists is drawn:

1. the variable that the caller names;
2. all objects that the script shows;
3. the variable `result`;
4. the solid that it exports last, else the solid that was assigned last, else so a face, else a shape or a mesh.

A remark in the drawing names the choice. What stands under
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
from hlr.source.cad.objects import is_object, to_leaves
from hlr.source.cad.occt_import import load_occt
from hlr.source.cad.parts import Leaf
from hlr.source.cad.script_choice import RESULT_VARIABLE, is_shape, objects_to_draw, passes
from hlr.source.cad.script_run import run
from hlr.source.cad.viewers import Showing, Shown
from hlr.source.collected import left_out_of, only, why_not_read
from hlr.source.joined import JoinedSource, are_both, source_of_both
from hlr.source.mesh.mesh_source import MeshSource
from hlr.source.mesh.objects import Meshes
from hlr.source.mesh.open_objects import is_mesh, read_meshes
from hlr.tables.entry import listed


def open_script(
    path: Path, var: str | None = None, parameters: Mapping[str, Parameter] | None = None
) -> BrepSource | MeshSource | JoinedSource:
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
    leaves: list[Leaf] = []
    meshes: list[Meshes] = []
    left_out: dict[str, SourceError] = {}
    for thing, name, look in chosen:
        both = passes(thing, are_both)
        cad, triangles = (only(thing, is_object), only(thing, is_mesh)) if both else (thing, None)
        if cad is not None:
            load_occt()
        try:
            leaves += [] if cad is None else to_leaves(cad, name or path.stem, *look)
            meshes += [] if triangles is None else read_meshes(triangles, name or path.stem, *look)
        except SourceError as error:
            left_out[type(thing).__name__] = error
    if left_out and not leaves and not meshes:
        raise SourceError(f"{path.name} shows something that is no shape: {next(iter(left_out.values()))}")
    if not leaves and not meshes:
        raise SourceError(_nothing_shown(path, values, [type(thing).__name__ for thing, _, _ in chosen]))
    if left_out:
        why += f", without what is no shape ({', '.join(left_out)})"
    return source_of_both(path.name, "script", leaves, meshes, _remarks(path, chosen, why))


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
        why = why_not_read(value, are_both) or "assign a shape to it"
        return f'The variable "{RESULT_VARIABLE}" of {path.name} is no shape, but {type(value).__name__}: {why}.'
    return f'{path.name} shows nothing: call show_object(shape) in it, or assign the shape to a variable "result".'
