"""CAD objects in memory: CadQuery, build123d and bare OpenCASCADE shapes become leaves."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from hlr.common.types import Color
from hlr.errors import SourceError
from hlr.source.cad.brep_source import BrepSource
from hlr.source.cad.colors import color_of_wrapper
from hlr.source.cad.occt_import import load_occt
from hlr.source.cad.parts import Leaf
from hlr.source.cad.source_builder import build_source
from hlr.source.packages import package_of
from hlr.tables.readers import what_to_pass


def open_object(thing: Any, name: str = "") -> BrepSource:
    """A shape, a workplane, an assembly, a builder, or a list of these.

    Raises:
        SourceError: it is none of them, or holds nothing to draw.
    """
    load_occt()
    label = name or _label(thing)
    leaves = to_leaves(thing, "part")
    if not leaves:
        raise SourceError(f"{label} holds no shapes: there is nothing to draw.")
    return build_source(label, "object", leaves)


def is_shape_like(thing: Any) -> bool:
    """Whether `to_leaves` would take it: judged by type and attributes, nothing is imported."""
    root = package_of(thing)
    if root == "cadquery":
        return _is_kind(thing, "Workplane", "Shape", "Assembly", "Sketch")
    if root == "build123d":
        return _wrapped(thing) is not None or _is_kind(thing, "Shape", "Builder", "ShapeList")
    if root == "OCP":
        return _is_kind(thing, "TopoDS_Shape")
    return isinstance(thing, list | tuple) and len(thing) > 0 and all(is_shape_like(item) for item in thing)


def to_leaves(thing: Any, name: str, color: Color | None = None, opacity: float = 1.0) -> list[Leaf]:
    """Leaves of any supported object; name, colour and opacity are used where it brings none.

    Those of nested assemblies have their path in their names: gearbox/shaft/key.

    Raises:
        SourceError: not a supported object.
    """
    root = package_of(thing)
    if root == "OCP" and _is_kind(thing, "TopoDS_Shape"):
        return [Leaf(thing, name, color, opacity=opacity)]
    if root == "cadquery":
        return _cadquery(thing, name, color, opacity)
    if root == "build123d":
        return _build123d(thing, getattr(thing, "label", "") or name, color, opacity)
    if isinstance(thing, Iterable) and not isinstance(thing, str | bytes | dict):
        return [leaf for item in thing for leaf in to_leaves(item, name, color, opacity)]
    raise SourceError(f"An object of type {type(thing).__name__} cannot be drawn: pass {what_to_pass()}.")


def _cadquery(thing: Any, name: str, color: Color | None, opacity: float) -> list[Leaf]:
    if _is_kind(thing, "Assembly"):
        return _assembly(thing, None, color, opacity, _readable(thing.name) or name)
    if _is_kind(thing, "Workplane"):
        shapes = [item for item in thing.vals() if _is_kind(item, "Shape")]
        return [leaf for item in shapes for leaf in to_leaves(item, name, color, opacity)]
    if _is_kind(thing, "Sketch"):
        return to_leaves(thing.moved() if not thing.locs else thing.val(), name, color, opacity)
    if _is_kind(thing, "Shape"):
        return [] if thing.wrapped is None else [Leaf(thing.wrapped, name, color, opacity=opacity)]
    raise SourceError(f"A cadquery.{type(thing).__name__} cannot be drawn: pass a Workplane, a Shape or an Assembly.")


def _assembly(node: Any, place: Any, color: Color | None, opacity: float, name: str, path: str = "") -> list[Leaf]:
    """A cq.Assembly, children after the node's own shapes. path: what the names of its children begin with."""
    here = node.loc.wrapped if place is None else place.Multiplied(node.loc.wrapped)
    if node.color is not None:
        color, opacity = color_of_wrapper(node.color)
    leaves = []
    for shape in node.shapes:
        if shape is not None and shape.wrapped is not None:
            leaves.append(Leaf(shape.wrapped.Moved(here, False), name, color, opacity=opacity))
    for child in node.children:
        leaves.extend(_assembly(child, here, color, opacity, *_nested(path, _readable(child.name), name)))
    return leaves


def _nested(path: str, own: str, parent: str) -> tuple[str, str]:
    """The name of a child, and the path of its children: the top of an assembly is in no name."""
    if not own:
        return parent, path
    whole = f"{path}/{own}" if path else own
    return whole, whole


def _build123d(thing: Any, name: str, color: Color | None, opacity: float, path: str = "") -> list[Leaf]:
    """A build123d object, whose own label is in the name already. path: what the names of its children begin with."""
    own = getattr(thing, "color", None)
    if own is not None and hasattr(own, "wrapped"):
        color, opacity = color_of_wrapper(own)
    for attribute in ("part", "sketch", "line"):
        if _is_kind(thing, "Builder") and (made := getattr(thing, attribute, None)) is not None:
            return _build123d(made, getattr(made, "label", "") or name, color, opacity)
    children = getattr(thing, "children", ())
    if children:
        # A compound's children hold locations relative to it; build123d composes them here.
        inside = [(child, *_nested(path, getattr(child, "label", ""), name)) for child in children]
        return [leaf for each in inside for leaf in _placed(thing, *each, color, opacity)]
    shape = _wrapped(thing)
    if shape is not None:
        return [Leaf(shape, name, color, opacity=opacity)]
    if isinstance(thing, Iterable):
        return [leaf for item in thing for leaf in to_leaves(item, name, color, opacity)]
    if _is_kind(thing, "Shape", "Builder"):
        return []
    raise SourceError(f"A build123d.{type(thing).__name__} cannot be drawn: pass a shape or a builder.")


def _placed(parent: Any, child: Any, name: str, path: str, color: Color | None, opacity: float) -> list[Leaf]:
    leaves = _build123d(child, name, color, opacity, path)
    outer = _wrapped(parent)
    if outer is None or outer.Location().IsIdentity():
        return leaves
    return [replace(leaf, shape=leaf.shape.Moved(outer.Location(), False)) for leaf in leaves]


def _wrapped(thing: Any) -> Any:
    shape = getattr(thing, "wrapped", None)
    return shape if shape is not None and type(shape).__name__.startswith("TopoDS_") else None


def _is_kind(thing: Any, *names: str) -> bool:
    return any(cls.__name__ in names for cls in type(thing).__mro__)


def _readable(name: str | None) -> str:
    """CadQuery names nameless nodes by a random UUID: no name, and another one on every run."""
    text = name or ""
    return "" if len(text) == 36 and text.count("-") == 4 else text


def _label(thing: Any) -> str:
    return str(getattr(thing, "label", "") or type(thing).__name__)
