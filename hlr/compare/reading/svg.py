"""SVG files: drawings of hlr, and those of other programs."""

from __future__ import annotations

from pathlib import Path

from hlr.compare.lines.sketch import About, Sketch
from hlr.compare.reading.other_svg import read_other
from hlr.compare.reading.our_svg import about_ours, read_ours
from hlr.compare.reading.svg_elements import SVG
from hlr.errors import SourceError
from hlr.source.archive import xml_tree

_FRAGMENT = b'<svg xmlns="http://www.w3.org/2000/svg">%s</svg>'
"""FreeCAD's functions give groups without a document around them."""


def read_svg(path: Path, sketch: Sketch) -> About:
    """Add the lines of a file to a sketch. Returns what else the file says.

    Raises SourceError, in one sentence, for a file that is no SVG, damaged, or without any line.
    """
    text = path.read_bytes()
    fragment = text.lstrip()[:2] in (b"<g", b"<p")
    root = xml_tree(_FRAGMENT % text if fragment else text, path, "the file", "SVG")
    if root.tag.removeprefix(SVG) != "svg":
        raise SourceError(f"{path.name} is no drawing: its first element is not svg")
    try:
        ours = about_ours(root)
        if ours is not None:
            read_ours(root, ours, sketch)
            return ours
        other = read_other(root, sketch, fragment)
    except ValueError as error:
        raise SourceError(f"{path.name} is damaged: {error}") from None
    if not other.views and not len(sketch):
        raise SourceError(f"{path.name} has no lines: give the SVG of a drawing")
    return other
