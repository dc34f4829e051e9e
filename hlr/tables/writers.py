"""Writers: a row for each format that a drawing or a picture is written as."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from hlr.tables.entry import called, listed


@dataclass(frozen=True, slots=True)
class Writer:
    """A file format.

    name     of the format, which is also the ending of its files
    entry    "module:function": called with the drawing or picture, gives the content of the file as bytes. The module
             is imported when it is used: PDF needs a library that the others do not
    """

    name: str
    entry: str

    def render(self, shown: Any) -> bytes:
        """The content of a file."""
        return bytes(called(self.entry)(shown))


WRITERS = {
    writer.name: writer
    for writer in (
        Writer("svg", "hlr.writers.svg:svg"),
        Writer("pdf", "hlr.writers.pdf:pdf"),
        Writer("dxf", "hlr.writers.dxf:dxf"),
        Writer("png", "hlr.writers.drawing_png:drawing_png"),
        Writer("json", "hlr.writers.json:document"),
    )
}
"""Formats of drawings, by name."""

PICTURE = Writer("png", "hlr.writers.png:picture_png")
DEPTH = Writer("png", "hlr.writers.png:depth_png")
FACES = Writer("png", "hlr.writers.png:ids_png")
"""Files of a shaded picture: itself, its depth map, its map of faces."""


def formats(before: str = "", around: str = "") -> str:
    """All formats of drawings, for people: svg, pdf, dxf or json. before: put before each; around: on both sides."""
    return listed((f"{around}{before}{name}{around}" for name in WRITERS), "or")


def titles(last: str) -> str:
    """All formats of drawings, for help texts: SVG, PDF, DXF and JSON. last: the word before the last one."""
    return listed((name.upper() for name in WRITERS), last)
