"""A FreeCAD document (.FCStd): its objects with their properties, and how they are shown."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from xml.etree.ElementTree import Element
from zipfile import ZipFile

from hlr.errors import SourceError
from hlr.source.archive import open_archive, xml_tree
from hlr.source.file_checks import wrong_format
from hlr.source.freecad.properties import Properties

TITLE = "FreeCAD"


@dataclass(frozen=True, slots=True)
class Object:
    """An object of a document.

    name        its key, unique in the document; label: what people call it
    type        as FreeCAD names it: Part::Feature, App::Link
    extensions  what it can besides, by type
    values      its properties
    view        those of its view provider; empty in documents that were saved without the user interface
    """

    name: str
    type: str
    extensions: frozenset[str]
    values: Properties
    view: Properties

    @property
    def label(self) -> str:
        """Its label in one line; its name where it has none."""
        return " ".join(self.values.text("Label").split()) or self.name

    @property
    def visible(self) -> bool:
        """Whether it is shown."""
        return (self.view if "Visibility" in self.view else self.values).flag("Visibility", True)


@dataclass(frozen=True, slots=True)
class Document:
    """An opened document.

    objects  by name, in the document's order
    has_view whether it was saved with the user interface: it says what is shown, and in which colours
    """

    objects: Mapping[str, Object]
    has_view: bool


@contextmanager
def open_document(path: Path) -> Iterator[Document]:
    """Open a document; the files of its properties are read while it is open.

    Raises:
        SourceError: it is no FreeCAD document, broken, or hostile.
    """
    with path.open("rb") as file:
        head = file.read(4096)
    if not head.startswith(b"PK"):
        raise wrong_format(path, "a FreeCAD document (they are ZIP archives)", head)
    with open_archive(path, TITLE) as archive:
        yield _read(path, archive)


def _read(path: Path, archive: ZipFile) -> Document:
    members = set(archive.namelist())
    if "Document.xml" not in members:
        raise SourceError(f"{path.name} is a ZIP archive without Document.xml: it is no FreeCAD document.")

    def file(name: str) -> bytes | None:
        return archive.read(name) if name in members else None

    def tree(member: str) -> Element:
        return xml_tree(archive.read(member), path, member, TITLE)

    def properties(element: Element | None) -> Properties:
        # A property that holds no value has another tag, `_Property`.
        found = () if element is None else element.iterfind("Properties/Property")
        return Properties({each.get("name", ""): each[0] for each in found if len(each)}, file)

    root = tree("Document.xml")
    has_view = "GuiDocument.xml" in members
    shown = tree("GuiDocument.xml").iterfind("ViewProviderData/ViewProvider") if has_view else ()
    views = {each.get("name", ""): each for each in shown}
    data = {each.get("name", ""): each for each in root.iterfind("ObjectData/Object")}
    objects = {}
    for each in root.iterfind("Objects/Object"):
        name = each.get("name", "")
        element = data.get(name)
        extensions = () if element is None else element.iterfind("Extensions/Extension")
        objects[name] = Object(
            name,
            each.get("type", ""),
            frozenset(extension.get("type", "") for extension in extensions),
            properties(element),
            properties(views.get(name)),
        )
    return Document(objects, has_view)
