"""Which of its objects a script wants drawn: what it shows, else the variable that looks most like its result."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from hlr.errors import OptionError
from hlr.source.cad.colors import ColorOpacity
from hlr.source.cad.objects import is_object, is_shape_like, to_leaves
from hlr.source.cad.occt_import import load_occt
from hlr.source.cad.script_exports import exported
from hlr.source.cad.viewers import Shown
from hlr.source.collected import is_collection, only, things_in
from hlr.source.joined import are_both
from hlr.source.mesh.open_objects import are_meshes, hold_triangles

RESULT_VARIABLE = "result"

NO_COLOR: ColorOpacity = (None, 1.0)


def objects_to_draw(path: Path, shown: list[Shown], values: dict[str, Any], var: str | None) -> tuple[list[Shown], str]:
    """The objects to draw, and the reason, in words."""
    if var is not None:
        return [(_named_variable(path, values, var), "", NO_COLOR)], f'the variable "{var}" is drawn'
    if shown:
        return shown, "all that it shows is drawn" + (f", {len(shown)} objects" if len(shown) > 1 else "")
    found = shapes(values)
    if RESULT_VARIABLE in found:
        return [(found[RESULT_VARIABLE], "", NO_COLOR)], f'the variable "{RESULT_VARIABLE}" is drawn'
    for rank, what in enumerate(("solid", "face, for there is no solid", "shape")):
        names = [name for name, thing in found.items() if _rank(thing) <= rank]
        if names:
            written = [name for name in exported(path) if name in names]
            name = (written or names)[-1]
            last = "the last exported" if written else "the last"
            why = f'the variable "{name}" is drawn, {last} {what}'
            choice = "show_object(shape), or a variable result, in the script, or --var NAME, chooses another"
            return [(found[name], "", NO_COLOR)], f"{why}; {choice}"
    return [], ""


def _named_variable(path: Path, values: dict[str, Any], var: str) -> Any:
    if var in values and is_shape(values[var]):
        return values[var]
    names = ", ".join(shapes(values)) or "none"
    what = "is no shape" if var in values else "is not there"
    raise OptionError(f'The variable "{var}" of {path.name} {what}: its shapes are {names}.')


def shapes(values: dict[str, Any]) -> dict[str, Any]:
    """Variables that are shapes, in the order of their last assignment."""
    return {name: thing for name, thing in values.items() if not name.startswith("_") and is_shape(thing)}


def most_solid(values: dict[str, Any]) -> dict[str, Any]:
    """Of the variables that are shapes those with solids, else those with faces, else all; each object once.

    A list or a dict of what other variables hold is left out, and so is a variable that holds what another one has.
    """
    found: dict[int, list[str]] = {}
    for name, thing in shapes(values).items():
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


def is_shape(value: Any) -> bool:
    """Whether it is drawn: as a CAD shape, as a mesh, or as a list or a dict of both."""
    return passes(value, is_shape_like) or passes(value, hold_triangles) or passes(value, _holds_both)


def _holds_both(value: Any) -> bool:
    return are_both(value) and only(value, is_object) is not None


def passes(value: Any, check: Callable[[Any], bool]) -> bool:
    """What the check says of a value; no where it raises."""
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
        cad = only(thing, is_object) if _holds_both(thing) else thing
        held = [leaf.shape for leaf in to_leaves(cad, "part") if leaf.shape is not None]
    except Exception:  # whatever a half-made object raises
        return 3
    for rank, kind in enumerate((Kind.TopAbs_SOLID, Kind.TopAbs_FACE)):
        if any(TopExp_Explorer(shape, kind).More() for shape in held):
            return rank
    return 2 if held else 3
