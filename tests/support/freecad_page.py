"""A page of a FreeCAD document made by hand, and what is printed on it beside the lines of its view."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import hlr
from support import freecad_document as fc
from support.freecad_document import item, kept, link, links, number, vector, whole, write

SVG = "{http://www.w3.org/2000/svg}"


def drawn(
    path: Path, *, front: Mapping[str, str] | None = None, files: Mapping[str, bytes] | None = None, **things: Any
) -> tuple[hlr.Drawing, Element]:
    """The elements that are printed on a page of 200 x 100 mm with one view, at 60, 40 and a scale of 0.5.

    front: more values of the view; files: of the archive.
    """
    objects = {
        "Box": item("Part::Box", Shape=kept("Part", "box.brp")),
        "Page": item("TechDraw::DrawPage", Template=link("Template"), Views=links("Front", *things)),
        "Template": item("TechDraw::DrawSVGTemplate", Width=number(200.0), Height=number(100.0)),
        "Front": item(
            "TechDraw::DrawViewPart",
            Source=links("Box"),
            Direction=vector(0, -1, 0),
            XDirection=vector(1, 0, 0),
            X=number(60.0),
            Y=number(40.0),
            ScaleType=whole(2),
            Scale=number(0.5),
            **(front or {}),
        ),
        **things,
    }
    files = {"box.brp": fc.box(10, 20, 30), **(files or {})}
    (drawing,) = hlr.draw_pages(write(path / "made.FCStd", objects, files))
    return drawing, ElementTree.fromstring(f'<svg xmlns="http://www.w3.org/2000/svg">{drawing.sheet.template}</svg>')
