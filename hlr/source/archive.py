"""ZIP archives that hold a model as XML and more (3MF, FreeCAD): hostile ones are refused, and nothing is unpacked to
disk.

A member is only ever looked up by its name among those of the archive: no name leads out of it.
"""

from __future__ import annotations

import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from xml.etree import ElementTree

from hlr.errors import SourceError

MAX_EXPANDED = 4 << 30
"""Bytes that an archive may unpack to."""

MAX_RATIO = 300
"""Ratio of compression that only a ZIP bomb exceeds; plain XML does not."""

MAX_ELEMENTS = 5_000_000
"""Elements of an XML member that is read as a tree, at some 200 bytes of memory each."""


@contextmanager
def open_archive(path: Path, title: str) -> Iterator[zipfile.ZipFile]:
    """An archive whose members together stay within the limits. title: of the format, for errors.

    Raises:
        SourceError: it is broken, encrypted, or would unpack to too much; also where reading a member shows that.
    """
    try:
        with zipfile.ZipFile(path) as archive:
            total = sum(entry.file_size for entry in archive.infolist())
            if total > MAX_EXPANDED or (total > 64 << 20 and total > MAX_RATIO * path.stat().st_size):
                raise SourceError(f"{path.name} would unpack to {total >> 20} MiB: it is refused as a ZIP bomb.")
            yield archive
    # zipfile says NotImplementedError of compressions that it does not know.
    except (zipfile.BadZipFile, zlib.error, NotImplementedError, RuntimeError, EOFError, OSError) as error:
        raise SourceError(
            f"{path.name} cannot be read as {title}: the archive is broken or encrypted ({error})."
        ) from None


def declares_entities(path: Path, title: str) -> SourceError:
    """The error that an XML member declares a document type or entities."""
    return SourceError(f"{path.name} declares XML entities, which no {title} file needs: it is refused.")


def xml_tree(text: bytes, path: Path, member: str, title: str) -> ElementTree.Element:
    """The root element of an XML member.

    Raises:
        SourceError: it is not well-formed, has too many elements, or declares a document type, as entities need one.
    """

    class Builder(ElementTree.TreeBuilder):
        elements = 0

        def start(self, tag: str, attrs: dict[str, str], /) -> ElementTree.Element:
            self.elements += 1
            if self.elements > MAX_ELEMENTS:
                raise SourceError(f"{path.name} has more than {MAX_ELEMENTS} elements in {member}: it is refused.")
            return super().start(tag, attrs)

        def doctype(self, name: str, pubid: str | None, system: str | None) -> None:
            raise declares_entities(path, title)

    try:
        return ElementTree.fromstring(text, ElementTree.XMLParser(target=Builder()))
    except (ElementTree.ParseError, LookupError, ValueError) as error:
        raise SourceError(f"{path.name} cannot be read as {title}: {member} is no sound XML ({error}).") from None
