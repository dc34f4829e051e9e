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

import os
import sys
import traceback
from collections.abc import Callable, Mapping
from pathlib import Path
from threading import RLock
from typing import Any

from hlr.common.own_modules import forgetting_own_modules, is_installed
from hlr.drawing.notes import Note
from hlr.errors import OptionError, SourceError
from hlr.request.options import Parameter
from hlr.source.cad.brep_source import BrepSource
from hlr.source.cad.child_process import found_by_children
from hlr.source.cad.colors import ColorOpacity
from hlr.source.cad.main_block import main_block
from hlr.source.cad.objects import is_shape_like, to_leaves
from hlr.source.cad.occt_import import import_failure_message, load_occt
from hlr.source.cad.script_module import Variables, as_program, module_of
from hlr.source.cad.script_parameters import compiled
from hlr.source.cad.script_variables import found_by_scripts, package_of
from hlr.source.cad.source_builder import build_source
from hlr.source.cad.viewers import Showing, Shown, stand_ins
from hlr.source.collected import is_collection, left_out_of, things_in, why_not_read
from hlr.source.mesh.mesh_source import MeshSource
from hlr.source.mesh.open_objects import are_meshes, hold_triangles, mesh_source, read_meshes
from hlr.tables.entry import listed

_RESULT_VARIABLE = "result"

_NO_COLOR: ColorOpacity = (None, 1.0)


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
    values = _run(path, showing, parameters or {}, var)
    chosen, why = _objects_to_draw(path, showing.shown, values, var)
    meshes = {type(thing).__name__ for thing, _, _ in chosen if _passes(thing, are_meshes)}
    of_meshes = bool(meshes) and not any(_passes(thing, is_shape_like) for thing, _, _ in chosen)
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
    if _RESULT_VARIABLE in values and not _is_shape(value := values[_RESULT_VARIABLE]):
        why = why_not_read(value, (is_shape_like, are_meshes)) or "assign a shape to it"
        return f'The variable "{_RESULT_VARIABLE}" of {path.name} is no shape, but {type(value).__name__}: {why}.'
    return f'{path.name} shows nothing: call show_object(shape) in it, or assign the shape to a variable "result".'


def _objects_to_draw(
    path: Path, shown: list[Shown], values: dict[str, Any], var: str | None
) -> tuple[list[Shown], str]:
    """The objects to draw, and the reason, in words."""
    if var is not None:
        return [(_named_variable(path, values, var), "", _NO_COLOR)], f'the variable "{var}" is drawn'
    if shown:
        return shown, "all that it shows is drawn" + (f", {len(shown)} objects" if len(shown) > 1 else "")
    found = _shapes(values)
    if _RESULT_VARIABLE in found:
        return [(found[_RESULT_VARIABLE], "", _NO_COLOR)], f'the variable "{_RESULT_VARIABLE}" is drawn'
    for rank, what in enumerate(("the last solid", "the last face, for there is no solid", "the last shape")):
        names = [name for name, thing in found.items() if _rank(thing) <= rank]
        if names:
            why = f'the variable "{names[-1]}" is drawn, {what}'
            choice = "show_object(shape), or a variable result, in the script, or --var NAME, chooses another"
            return [(found[names[-1]], "", _NO_COLOR)], f"{why}; {choice}"
    return [], ""


def _named_variable(path: Path, values: dict[str, Any], var: str) -> Any:
    if var in values and _is_shape(values[var]):
        return values[var]
    names = ", ".join(_shapes(values)) or "none"
    what = "is no shape" if var in values else "is not there"
    raise OptionError(f'The variable "{var}" of {path.name} {what}: its shapes are {names}.')


def _shapes(values: dict[str, Any]) -> dict[str, Any]:
    """Variables that are shapes, in the order of their last assignment."""
    return {name: thing for name, thing in values.items() if not name.startswith("_") and _is_shape(thing)}


def _most_solid(values: dict[str, Any]) -> dict[str, Any]:
    """Of the variables that are shapes those with solids, else those with faces, else all; each object once.

    A list or a dict of what other variables hold is left out, and so is a variable that holds what another one has.
    """
    found: dict[int, list[str]] = {}
    for name, thing in _shapes(values).items():
        found.setdefault(_rank(thing), []).append(name)
    once: dict[int, str] = {}
    for name in found[min(found)] if found else ():
        once.setdefault(id(values[name]), name)
    single = {own for own, name in once.items() if not is_collection(values[name])}
    inside = {own: _ids_in(values[name]) for own, name in once.items() if own not in single}
    taken = {own for own, ids in inside.items() if ids <= single}
    taken |= {own for ids in inside.values() if not ids <= single for own in ids}
    return {name: values[name] for own, name in once.items() if own not in taken}


def _ids_in(thing: Any) -> set[int]:
    """Ids of what is in a list or a dict, and in those inside of it."""
    return {id(each) for each in things_in(thing) if each is not None}


def _is_shape(value: Any) -> bool:
    return _passes(value, is_shape_like) or _passes(value, hold_triangles)


def _passes(value: Any, check: Callable[[Any], bool]) -> bool:
    try:
        return check(value)
    except Exception:  # a variable with strange attributes is no shape
        return False


def _rank(thing: Any) -> int:
    """0: has a solid; 1: has a face; 2: has other shapes, or is a mesh; 3: is empty."""
    if are_meshes(thing):
        return 2
    load_occt()
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopExp import TopExp_Explorer

    try:
        shapes = [leaf.shape for leaf in to_leaves(thing, "part") if leaf.shape is not None]
    except Exception:  # whatever a half-made object raises
        return 3
    for rank, kind in enumerate((Kind.TopAbs_SOLID, Kind.TopAbs_FACE)):
        if any(TopExp_Explorer(shape, kind).More() for shape in shapes):
            return rank
    return 2 if shapes else 3


class _Turn:
    """Held by the thread whose script runs."""

    lock = RLock()

    @classmethod
    def renew(cls) -> None:
        """In a process that was forked the thread whose turn it was is not there, and never ends it."""
        cls.lock = RLock()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_Turn.renew)


def _run(path: Path, showing: Showing, parameters: Mapping[str, Parameter], var: str | None) -> dict[str, Any]:
    # Working folder, search path and modules are those of the whole process: one script at a time.
    with _Turn.lock:
        return _run_alone(path, showing, parameters, var)


def _run_alone(path: Path, showing: Showing, parameters: Mapping[str, Parameter], var: str | None) -> dict[str, Any]:
    values = Variables(found_by_scripts(path, showing))
    showing.drawable = lambda: _most_solid(values)
    folder, working_folder = path.resolve().parent, _working_folder()
    saved_path, saved_arguments = list(sys.path), sys.argv
    sys.path.insert(0, str(folder))
    package, root = package_of(folder)
    if package:
        sys.path.append(str(root))
    sys.argv = [str(path)]
    try:
        os.chdir(folder)
        with (
            forgetting_own_modules(folder),
            stand_ins(showing),
            module_of(values),
            found_by_children(path, parameters),
        ):
            exec(compiled(path, parameters), values)
            _run_main_block(path, showing, values, parameters, var)
    except OptionError:
        raise
    except SystemExit as error:
        if error.code not in (None, 0) and not showing.shown:
            raise SourceError(_left_early(path, error.code, values)) from None
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # whatever a script raises, the caller gets one sentence
        raise SourceError(_failure_message(path, error)) from None
    finally:
        sys.argv = saved_arguments
        sys.path[:] = saved_path
        if working_folder is not None:
            os.chdir(working_folder)
    return values


def _run_main_block(
    path: Path, showing: Showing, values: Variables, parameters: Mapping[str, Parameter], var: str | None
) -> None:
    """Run what stands under `if __name__ == "__main__":` where without it nothing is there to draw.

    Where shapes are there, but neither shown nor called `result`, it is run if it shows something itself. var: the
    variable that is to be drawn; where it is there, nothing else counts.
    """
    shapes = _shapes(values)
    if showing.shown or _RESULT_VARIABLE in shapes or var in shapes:
        return
    block = main_block(path, parameters, showing=bool(shapes))
    if block is not None:
        with as_program(values):
            exec(block, values)


def _left_early(path: Path, code: object, values: dict[str, Any]) -> str:
    """One sentence on a script that left by sys.exit(code), and had shown nothing. code: a number, or a text."""
    how = f"exit code {code}" if isinstance(code, int) else f'the message "{" ".join(str(code).split())}"'
    shapes = list(_shapes(values))
    if not shapes:
        return f"{path.name} left with {how}, and had shown nothing."
    name = _RESULT_VARIABLE if _RESULT_VARIABLE in shapes else shapes[-1]
    return (
        f'{path.name} left with {how}: its variable "{name}" may be unfinished, and is not drawn; what it shows by '
        "show_object(shape) before it leaves is."
    )


def _working_folder() -> str | None:
    try:
        return os.getcwd()
    except OSError:
        return None


def _failure_message(path: Path, error: BaseException) -> str:
    """One sentence: the line of the script, that of its own module which fails, and the exception."""
    if isinstance(error, ImportError) and "libGL" in str(error):
        return f"{path.name}: {import_failure_message(error)}"
    passed = [(frame.filename, frame.lineno) for frame in traceback.extract_tb(error.__traceback__)]
    text = _text_of(error)
    if isinstance(error, SyntaxError):
        passed.append((error.filename or str(path), error.lineno))
        text = error.msg
    own = [(file, line) for file, line in passed if file == str(path) or _is_of_a_project(file)]
    lines = [line for file, line in own if file == str(path)]
    where = f", line {lines[-1]}" if lines and lines[-1] else ""
    if own and own[-1][0] != str(path):  # in a module that the script imports
        where += f" ({Path(own[-1][0]).name}, line {own[-1][1]})"
    return f"{path.name}{where}: {type(error).__name__}" + (f": {text}" if text else "")


def _text_of(error: BaseException) -> str:
    try:
        return " ".join(str(error).split())
    except Exception:  # the script's own class of exceptions
        return ""


def _is_of_a_project(file: str) -> bool:
    """Whether it is the file of a module that no package manager has installed. file: it may be such as <string>."""
    return file.endswith(".py") and not is_installed(Path(file).resolve())
