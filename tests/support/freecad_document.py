"""FreeCAD documents made by hand: a ZIP archive of XML, with shapes of OpenCASCADE's."""

from __future__ import annotations

import io
import math
import struct
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

GROUP = "App::OriginGroupExtension"
FOLDER = "App::GroupExtension"
LINK = "App::LinkExtension"

KINDS = {
    "App::Part": GROUP,
    "PartDesign::Body": GROUP,
    "App::DocumentObjectGroup": FOLDER,
    "App::Link": LINK,
    "App::LinkElement": "App::LinkBaseExtension",
    "App::LinkGroup": "App::LinkBaseExtension",
}


def text(value: str) -> str:
    return f"<String value={quoteattr(value)}/>"


def flag(value: bool) -> str:
    return f'<Bool value="{str(value).lower()}"/>'


def number(value: float) -> str:
    return f'<Float value="{value!r}"/>'


def whole(value: int) -> str:
    return f'<Integer value="{value}"/>'


def vector(x: float, y: float, z: float) -> str:
    return f'<PropertyVector valueX="{x}" valueY="{y}" valueZ="{z}"/>'


def placement(x: float = 0.0, y: float = 0.0, z: float = 0.0, turn: float = 0.0) -> str:
    """A shift, after a turn in degrees about z."""
    half = math.radians(turn) / 2
    return (
        f'<PropertyPlacement Px="{x}" Py="{y}" Pz="{z}" Q0="0" Q1="0" Q2="{math.sin(half)!r}" Q3="{math.cos(half)!r}"/>'
    )


def link(name: str) -> str:
    return f'<Link value="{name}"/>'


def links(*names: str) -> str:
    return f'<LinkList count="{len(names)}">{"".join(map(link, names))}</LinkList>'


def xlink(name: str, file: str = "", sub: str = "") -> str:
    return f'<XLink file="{file}" stamp="" name="{name}"' + (f' sub="{sub}"/>' if sub else "/>")


def kept(tag: str, file: str) -> str:
    """A value that is kept in a file of the archive."""
    return f'<{tag} file="{file}"/>'


def placement_list(*shifts: tuple[float, float, float]) -> bytes:
    return struct.pack("<I", len(shifts)) + b"".join(struct.pack("<7d", *shift, 0, 0, 0, 1) for shift in shifts)


def vector_list(*vectors: tuple[float, float, float]) -> bytes:
    return struct.pack("<I", len(vectors)) + b"".join(struct.pack("<3d", *vector) for vector in vectors)


def box(x: float, y: float, z: float, at: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> bytes:
    """A box in BREP; `at`: its placement, kept as its location, as FreeCAD keeps it."""
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox
    from OCP.gp import gp_Trsf, gp_Vec
    from OCP.TopLoc import TopLoc_Location

    shape = BRepPrimAPI_MakeBox(x, y, z).Shape()
    if any(at):
        move = gp_Trsf()
        move.SetTranslation(gp_Vec(*at))
        shape = shape.Located(TopLoc_Location(move))
    return brep(shape)


def brep(shape: Any) -> bytes:
    from OCP.BRepTools import BRepTools

    stream = io.BytesIO()
    BRepTools.Write_s(shape, stream)
    return stream.getvalue()


def item(kind: str, *, view: Mapping[str, str] | None = None, **values: str) -> tuple[str, Mapping[str, str], Any]:
    """An object: its type, the XML of its values, and that of its view provider."""
    return kind, values, view


def _properties(values: Mapping[str, str]) -> str:
    inside = "".join(f'<Property name="{name}" type="">{value}</Property>' for name, value in values.items())
    return f'<Properties Count="{len(values)}"><_Property name="Nothing" type=""/>{inside}</Properties>'


def document_xml(objects: Mapping[str, Any]) -> str:
    listed = "".join(f'<Object type="{kind}" name="{name}"/>' for name, (kind, _, _) in objects.items())
    data = "".join(
        f'<Object name="{name}"><Extensions Count="1"><Extension type="{KINDS.get(kind, "Part::AttachExtension")}"/>'
        f"</Extensions>{_properties(values)}</Object>"
        for name, (kind, values, _) in objects.items()
    )
    return (
        '<?xml version="1.0" encoding="utf-8"?><Document SchemaVersion="4"><Properties Count="0"/>'
        f"<Objects>{listed}</Objects><ObjectData>{data}</ObjectData></Document>"
    )


def gui_xml(objects: Mapping[str, Any]) -> str:
    providers = "".join(
        f'<ViewProvider name="{name}">{_properties(view)}</ViewProvider>'
        for name, (_, _, view) in objects.items()
        if view is not None
    )
    return f'<Document SchemaVersion="1"><ViewProviderData>{providers}</ViewProviderData></Document>'


def write(path: Path, objects: Mapping[str, Any], files: Mapping[str, bytes], *, gui: bool = True) -> Path:
    """A document of these objects, with these files."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("Document.xml", document_xml(objects))
        for name, data in files.items():
            archive.writestr(name, data)
        if gui:
            archive.writestr("GuiDocument.xml", gui_xml(objects))
    return path
