"""Runs inside FreeCAD, with the add-on: draws a page of a document and its body exactly, and says what came of it."""

import json
import os
import site
from pathlib import Path

site.addsitedir(os.path.join(os.environ["HLR_USER"], "Mod", "ExactDrawing"))

import exact_drawing_paths  # noqa: F401
import FreeCAD

from hlr.compat.freecad_addon.exact import PAGE, exact_drawing, exact_page


def main():
    document = FreeCAD.openDocument(os.environ["HLR_DOCUMENT"])
    page = document.getObject("Page")
    made = [exact_page(page), exact_page(page), exact_drawing([document.getObject("Body")])]
    out = {
        "labels": [each.Label for each in made],
        "pages": len(document.findObjects(PAGE)),
        "sizes": [[each.Template.Width.Value, each.Template.Height.Value] for each in made],
        "paths": [Path(each.Template.PageResult).read_text().count("<path") for each in made],
    }
    with open(os.environ["HLR_ANSWER"], "w") as file:
        json.dump(out, file)


main()
