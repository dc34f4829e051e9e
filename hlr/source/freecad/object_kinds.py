"""What kinds of objects a FreeCAD document has: groups, folders, links, bodies, sketches, aids."""

from __future__ import annotations

from collections.abc import Iterator

from hlr.source.freecad.document import Document, Object

_LINKS = {"App::Link", "App::LinkElement", "App::LinkGroup"}
TARGETS = ("LinkedObject", "Base")
"""What a link refers to; Base: of Draft's arrays of links."""

BODIES = {"PartDesign::Body"}
"""They are groups with a shape of their own, which is that of their tip."""

_MOVING_TYPES = {"App::Part", "Assembly::AssemblyObject"}
_MOVING = {
    f"App::{kind}{python}" for kind in ("GeoFeatureGroupExtension", "OriginGroupExtension") for python in ("", "Python")
}
"""Extensions of groups that move what is in them."""

SKETCHES = {"Sketcher::SketchObject", "Sketcher::SketchObjectPython"}
AIDS = {
    *(f"PartDesign::{kind}" for kind in ("Plane", "Line", "Point", "CoordinateSystem")),
    *(f"App::{kind}" for kind in ("Origin", "Plane", "Line", "Point")),
}
"""Aids for design: shown in the view, but no part of the model."""

_INGREDIENTS = ("Base", "Tool", "Shapes", "Links", "Source", "Sections", "Spine", "BaseFeature", "Objects")
_COPIES = {"Part::Mirroring", "Part::FeaturePython", "Part::Part2DObjectPython"}
"""What they are made of stays visible beside them: mirrors, clones."""


def moves(thing: Object) -> bool:
    """Whether a group moves what is in it; others are folders."""
    return is_link(thing) or bool(_MOVING & thing.extensions) or thing.type in _MOVING_TYPES


def is_folder(thing: Object) -> bool:
    """Whether it is a group that moves nothing."""
    return bool(members(thing)) and not moves(thing) and thing.type not in BODIES


def is_link(thing: Object) -> bool:
    """Whether it stands for another object, or for an array or a group of such."""
    return any(extension.startswith("App::Link") for extension in thing.extensions) or thing.type in _LINKS


def holds_shapes(thing: Object) -> bool:
    """Whether it would draw anything: sketches, datums and other aids would not."""
    return thing.type not in AIDS | SKETCHES and (
        is_link(thing) or bool({"Shape", "Mesh"} & thing.values.elements.keys()) or bool(members(thing))
    )


def members(thing: Object) -> list[str]:
    """What is in a group, or shown as an element of a link."""
    return thing.values.links("ElementList" if is_link(thing) else "Group")


def leads_to(thing: Object) -> list[str]:
    """What is in a group, and what a link refers to."""
    if not is_link(thing):
        return members(thing)
    return [*members(thing), *(thing.values.link(name) for name in TARGETS if name in thing.values)]


def ingredients(document: Document) -> Iterator[str]:
    """The names of the objects that others are made of: the tool of a cut, the profile of an extrusion."""
    for thing in document.objects.values():
        if "Shape" in thing.values and thing.type not in _COPIES:
            for name in _INGREDIENTS:
                yield from thing.values.links(name)
