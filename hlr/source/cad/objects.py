"""CAD objects in memory (CadQuery, build123d, OpenCASCADE shapes) as leaves of an assembly."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

from hlr.common.types import Color
from hlr.errors import SourceError
from hlr.source.cad.brep_source import BrepSource
from hlr.source.cad.colors import color_of_wrapper
from hlr.source.cad.occt_import import load_occt
from hlr.source.cad.parts import Leaf
from hlr.source.cad.shapes import make_compound
from hlr.source.cad.source_builder import build_source
from hlr.source.collected import is_made_of, left_out_of, name_under
from hlr.source.mesh.open_objects import is_mesh
from hlr.source.packages import package_of
from hlr.tables.readers import what_to_pass


def open_object(thing: Any, name: str = "") -> BrepSource:
    """A shape, a workplane, an assembly, a builder, a list of these, or a dict that gives them names.

    None in a list or a dict, as an optional part is, is left out with a warning; so is an empty list or dict.

    Raises:
        SourceError: it is none of them, or holds nothing to draw.
    """
    load_occt()
    label = name or _label(thing)
    leaves = to_leaves(thing, "part")
    if not leaves:
        raise SourceError(f"{label} holds no shapes: there is nothing to draw.")
    return build_source(label, "object", leaves, list(left_out_of(thing)))


def is_shape_like(thing: Any) -> bool:
    """Whether `to_leaves` accepts an object; judged by type and attributes, without importing any CAD package."""
    return is_made_of(thing, is_object)


def is_object(thing: Any) -> bool:
    """Whether it is an object of a CAD package that is drawn."""
    package = package_of(thing)
    if package == "cadquery":
        return _is_instance_of(thing, "Workplane", "Shape", "Assembly", "Sketch")
    if package == "build123d":
        return _wrapped(thing) is not None or _is_instance_of(thing, "Shape", "Builder", "ShapeList")
    return package == "OCP" and _is_instance_of(thing, "TopoDS_Shape")


def to_leaves(thing: Any, name: str, color: Color | None = None, opacity: float = 1.0) -> list[Leaf]:
    """Leaves of a supported object. name, color, opacity: used where the object has none of its own.

    Leaves of nested assemblies are named by their path: gearbox/shaft/key. Those in a dict are named by their keys.

    Raises:
        SourceError: not a supported object.
    """
    package = package_of(thing)
    if package == "OCP" and _is_instance_of(thing, "TopoDS_Shape"):
        return [Leaf(thing, name, color, opacity=opacity)]
    if package == "cadquery":
        return _cadquery(thing, name, color, opacity)
    if package == "build123d":
        label = getattr(thing, "label", "")
        leaves = _build123d(thing, label or name, color, opacity)
        return _inside(label, leaves) if getattr(thing, "children", ()) else leaves
    if is_mesh(thing):
        raise SourceError(
            f"A mesh ({type(thing).__name__}) stands beside what is neither a CAD object nor a mesh: leave that out."
        )
    if isinstance(thing, Mapping):
        return [leaf for key, item in thing.items() for leaf in _of_key(str(key) or name, item, color, opacity)]
    if isinstance(thing, Iterable) and not isinstance(thing, str | bytes):
        return [leaf for item in thing if item is not None for leaf in to_leaves(item, name, color, opacity)]
    raise SourceError(f"An object of type {type(thing).__name__} cannot be drawn: pass {what_to_pass()}.")


def _of_key(key: str, thing: Any, color: Color | None, opacity: float) -> list[Leaf]:
    """Leaves of what a dict has under a key."""
    if thing is None:
        return []
    own = str(getattr(thing, "label", "") or getattr(thing, "name", "") or "") if package_of(thing) in _NAMED else ""
    leaves = to_leaves(thing, key, color, opacity)
    alone = len(leaves) == 1 and not leaves[0].above
    return [replace(leaf, name=name_under(key, leaf.name, own, alone)) for leaf in leaves]


_NAMED = ("cadquery", "build123d")
"""Packages whose objects may have names of their own."""


def _cadquery(thing: Any, name: str, color: Color | None, opacity: float) -> list[Leaf]:
    if _is_instance_of(thing, "Assembly"):
        own = _name_or_empty(thing.name)
        return _inside(own, _assembly(thing, None, color, opacity, own or name))
    if _is_instance_of(thing, "Workplane"):
        stack = [item for item in thing.vals() if _is_instance_of(item, "Shape", "Sketch", "Workplane", "Assembly")]
        return [leaf for item in stack for leaf in to_leaves(item, name, color, opacity)]
    if _is_instance_of(thing, "Sketch"):
        return _sketch(thing, name, color, opacity)
    if _is_instance_of(thing, "Shape"):
        return [] if thing.wrapped is None else [Leaf(thing.wrapped, name, color, opacity=opacity)]
    raise SourceError(f"A cadquery.{type(thing).__name__} cannot be drawn: pass a Workplane, a Shape or an Assembly.")


def _sketch(sketch: Any, name: str, color: Color | None, opacity: float) -> list[Leaf]:
    """One leaf: the faces of a cq.Sketch at each of its places, or its edges while it has no faces.

    What is selected in it, vertices or places, changes nothing.
    """
    shapes = [item.wrapped for item in (sketch if sketch.locs else sketch.moved())]
    return [Leaf(make_compound(shapes), name, color, opacity=opacity)] if shapes else []


def _assembly(node: Any, place: Any, color: Color | None, opacity: float, name: str, path: str = "") -> list[Leaf]:
    """Leaves of a cq.Assembly: its own shapes, then those of its children. path: prefix of the children's names."""
    here = node.loc.wrapped if place is None else place.Multiplied(node.loc.wrapped)
    if node.color is not None:
        color, opacity = color_of_wrapper(node.color)
    leaves = []
    for shape in node.shapes:
        if shape is not None and shape.wrapped is not None:
            leaves.append(Leaf(shape.wrapped.Moved(here, False), name, color, opacity=opacity))
    for child in node.children:
        leaves.extend(_assembly(child, here, color, opacity, *_nested(path, _name_or_empty(child.name), name)))
    return leaves


def _inside(assembly: str, leaves: list[Leaf]) -> list[Leaf]:
    """The leaves of an assembly that may have a name: it is in none of theirs."""
    return [replace(leaf, above=(assembly,)) for leaf in leaves] if assembly else leaves


def _nested(path: str, own: str, parent: str) -> tuple[str, str]:
    """The name of a child, and the path for its own children. The top of an assembly is in no name."""
    if not own:
        return parent, path
    whole = f"{path}/{own}" if path else own
    return whole, whole


def _build123d(thing: Any, name: str, color: Color | None, opacity: float, path: str = "") -> list[Leaf]:
    """Leaves of a build123d object. name: has its label already; path: prefix of the children's names."""
    own = getattr(thing, "color", None)
    if own is not None and hasattr(own, "wrapped"):
        color, opacity = color_of_wrapper(own)
    for attribute in ("part", "sketch", "line"):
        if _is_instance_of(thing, "Builder") and (made := getattr(thing, attribute, None)) is not None:
            return _build123d(made, getattr(made, "label", "") or name, color, opacity)
    children = getattr(thing, "children", ())
    if children:
        # A compound's children hold locations relative to it; build123d composes them here.
        inside = [(child, *_nested(path, getattr(child, "label", ""), name)) for child in children]
        return [leaf for each in inside for leaf in _placed(thing, *each, color, opacity)]
    shape = _wrapped(thing)
    if shape is not None:
        return [Leaf(shape, name, color, opacity=opacity)]
    if _is_instance_of(thing, "Shape", "Builder"):
        return []  # before what can be iterated over: an empty Part cannot
    if isinstance(thing, Iterable):
        return [leaf for item in thing for leaf in to_leaves(item, name, color, opacity)]
    raise SourceError(f"A build123d.{type(thing).__name__} cannot be drawn: pass a shape or a builder.")


def _placed(parent: Any, child: Any, name: str, path: str, color: Color | None, opacity: float) -> list[Leaf]:
    leaves = _build123d(child, name, color, opacity, path)
    outer = _wrapped(parent)
    if outer is None or outer.Location().IsIdentity():
        return leaves
    return [replace(leaf, shape=leaf.shape.Moved(outer.Location(), False)) for leaf in leaves]


def _wrapped(thing: Any) -> Any:
    """The shape of OpenCASCADE that an object holds; None: it holds none."""
    try:
        shape = getattr(thing, "wrapped", None)
    except AssertionError:  # build123d's answer where a shape is empty
        return None
    return shape if shape is not None and type(shape).__name__.startswith("TopoDS_") else None


def _is_instance_of(thing: Any, *names: str) -> bool:
    return any([cls.__name__ in names for cls in type(thing).__mro__])


def _name_or_empty(name: str | None) -> str:
    """The name, or "" for the random UUID that CadQuery gives to nameless nodes."""
    text = name or ""
    return "" if len(text) == 36 and text.count("-") == 4 else text


def _label(thing: Any) -> str:
    return str(getattr(thing, "label", "") or type(thing).__name__)
