"""Colours and transparency of a FreeCAD object, as its view provider keeps them."""

from __future__ import annotations

import struct
from dataclasses import dataclass

from hlr.common.types import Color, Rgba
from hlr.source.freecad.properties import Properties, records


@dataclass(frozen=True, slots=True)
class Look:
    """whole: colour and opacity of all faces; faces: one each, where they differ."""

    whole: Rgba
    faces: tuple[Rgba, ...] = ()


def look_of(view: Properties) -> Look | None:
    """How a view provider shows a shape; None where it says nothing.

    Before FreeCAD 1.0 faces have their colours in DiffuseColor, whose last byte is their transparency; since then all
    is in ShapeAppearance.
    """
    if "ShapeAppearance" in view:
        faces = _materials(view.content("ShapeAppearance"))
    elif "ShapeColor" in view:
        whole = (*_rgb(int(view.number("ShapeColor", 0.0))), _opacity(view.number("Transparency", 0.0) / 100.0))
        faces = [_diffuse(data) for data in _packed(view.content("DiffuseColor"))]
        return Look(whole, tuple(faces) if len(faces) > 1 else ())
    else:
        return None
    return Look(faces[0], tuple(faces) if len(faces) > 1 else ()) if faces else None


def look_of_link(view: Properties) -> Look | None:
    """The colour that a link gives to all that it shows; None where it leaves that as it is."""
    if not view.flag("OverrideMaterial", False) or "ShapeMaterial" not in view:
        return None
    color = _rgb(int(view.number("ShapeMaterial", 0.0, "diffuseColor")))
    return Look((*color, _opacity(view.number("ShapeMaterial", 0.0, "transparency"))))


def _materials(data: bytes | None) -> list[Rgba]:
    """Colours of a list of materials; what follows them in the file are names of pictures."""
    return [
        (*_rgb(int(diffuse)), _opacity(transparency)) for _, diffuse, _, _, _, transparency in records(data, "4I2f")
    ]


def _packed(data: bytes | None) -> list[int]:
    return [int(value) for (value,) in records(data, "I")]


def _diffuse(packed: int) -> Rgba:
    return (*_rgb(packed), _opacity((packed & 255) / 255.0))


def _rgb(packed: int) -> Color:
    red, green, blue, _ = struct.pack(">I", packed & 0xFFFFFFFF)
    return round(red / 255.0, 6), round(green / 255.0, 6), round(blue / 255.0, 6)


def _opacity(transparency: float) -> float:
    return round(min(max(1.0 - transparency, 0.0), 1.0), 6)
