"""CAD objects in memory: CadQuery, build123d and bare OpenCASCADE shapes become leaves."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from hlr.errors import SourceError
from hlr.source.brep import BrepSource
from hlr.source.model import Color
from hlr.source.occt import ready
from hlr.source.parts import Leaf


def open_object(thing: Any, name: str = "") -> BrepSource:
    """A shape, a workplane, an assembly, a builder, or a list of these.

    Raises:
        SourceError: it is none of them, or holds nothing to draw.
    """
    ready()
    label = name or _label(thing)
    leaves = to_leaves(thing, "part")
    if not leaves:
        raise SourceError(f"{label} holds no shapes: there is nothing to draw.")
    return BrepSource(label, "object", leaves)


def is_shape_like(thing: Any) -> bool:
    """Whether `to_leaves` would take it: judged by type and attributes, nothing is imported."""
    root = family(thing)
    if root == "cadquery":
        return _is_kind(thing, "Workplane", "Shape", "Assembly", "Sketch")
    if root == "build123d":
        return _wrapped(thing) is not None or _is_kind(thing, "Shape", "Builder", "ShapeList")
    if root == "OCP":
        return _is_kind(thing, "TopoDS_Shape")
    return isinstance(thing, list | tuple) and len(thing) > 0 and all(is_shape_like(item) for item in thing)


def family(thing: Any) -> str:
    """The top-level package that some class of the object's ancestry comes from, CAD packages first."""
    roots = [cls.__module__.split(".")[0] for cls in type(thing).__mro__]
    return next((root for root in roots if root in _FAMILIES), roots[0])


_FAMILIES = {"cadquery", "build123d", "OCP", "trimesh", "manifold3d"}


def to_leaves(thing: Any, name: str, color: Color | None = None) -> list[Leaf]:
    """Leaves of any supported object; `name` is used where it brings none.

    Raises:
        SourceError: not a supported object.
    """
    root = family(thing)
    if root == "OCP" and _is_kind(thing, "TopoDS_Shape"):
        return [Leaf(thing, name, color)]
    if root == "cadquery":
        return _cadquery(thing, name, color)
    if root == "build123d":
        return _build123d(thing, name, color)
    if isinstance(thing, Iterable) and not isinstance(thing, str | bytes | dict):
        return [leaf for item in thing for leaf in to_leaves(item, name, color)]
    raise SourceError(
        f"An object of type {type(thing).__name__} cannot be drawn: pass a CadQuery, build123d, OpenCASCADE, trimesh "
        "or manifold3d object, (vertices, faces), or the name of a file."
    )


def _cadquery(thing: Any, name: str, color: Color | None) -> list[Leaf]:
    if _is_kind(thing, "Assembly"):
        return _assembly(thing, None, None, 1.0, name)
    if _is_kind(thing, "Workplane"):
        return [leaf for item in thing.vals() if _is_kind(item, "Shape") for leaf in to_leaves(item, name, color)]
    if _is_kind(thing, "Sketch"):
        return to_leaves(thing.moved() if not thing.locs else thing.val(), name, color)
    if _is_kind(thing, "Shape"):
        return [] if thing.wrapped is None else [Leaf(thing.wrapped, name, color)]
    raise SourceError(f"A cadquery.{type(thing).__name__} cannot be drawn: pass a Workplane, a Shape or an Assembly.")


def _assembly(node: Any, place: Any, inherited: Color | None, opacity: float, fallback: str) -> list[Leaf]:
    """A cq.Assembly, children after the node's own shapes."""
    from hlr.source.step import srgb

    here = node.loc.wrapped if place is None else place.Multiplied(node.loc.wrapped)
    color = inherited
    if node.color is not None:
        color, opacity = srgb(node.color.wrapped.GetRGB()), round(node.color.wrapped.Alpha(), 6)
    name = _readable(node.name) or fallback
    leaves = []
    for shape in node.shapes:
        if shape is not None and shape.wrapped is not None:
            leaves.append(Leaf(shape.wrapped.Moved(here, False), name, color, opacity=opacity))
    for child in node.children:
        leaves.extend(_assembly(child, here, color, opacity, name))
    return leaves


def _build123d(thing: Any, name: str, color: Color | None, opacity: float = 1.0) -> list[Leaf]:
    own = getattr(thing, "color", None)
    if own is not None and hasattr(own, "wrapped"):
        from hlr.source.step import srgb

        color, opacity = srgb(own.wrapped.GetRGB()), round(own.wrapped.Alpha(), 6)
    label = getattr(thing, "label", "") or name
    for attribute in ("part", "sketch", "line"):
        if _is_kind(thing, "Builder") and getattr(thing, attribute, None) is not None:
            return _build123d(getattr(thing, attribute), label, color, opacity)
    children = getattr(thing, "children", ())
    if children:
        # A compound's children hold locations relative to it; build123d composes them here.
        return [leaf for child in children for leaf in _placed(child, thing, label, color, opacity)]
    shape = _wrapped(thing)
    if shape is not None:
        return [Leaf(shape, label, color, opacity=opacity)]
    if isinstance(thing, Iterable):
        return [leaf for item in thing for leaf in to_leaves(item, name, color)]
    if _is_kind(thing, "Shape", "Builder"):
        return []
    raise SourceError(f"A build123d.{type(thing).__name__} cannot be drawn: pass a shape or a builder.")


def _placed(child: Any, parent: Any, name: str, color: Color | None, opacity: float) -> list[Leaf]:
    leaves = _build123d(child, name, color, opacity)
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
