"""Runs inside FreeCAD, with hlr: draws its shapes and objects, and says what came of it."""

import json
import os
import site

for folder in os.environ["HLR_FOLDERS"].split(os.pathsep):
    site.addsitedir(folder)

import FreeCAD  # noqa: E402
import Part  # noqa: E402
import TechDraw  # noqa: E402

import hlr  # noqa: E402
from hlr.compat.freecad import project_ex  # noqa: E402
from hlr.source import open_source  # noqa: E402


def lengths(compounds):
    return [sum(edge.Length for edge in compound.Edges) for compound in compounds]


def main():
    shape = Part.makeBox(10, 20, 30).cut(Part.makeCylinder(3, 50))
    document = FreeCAD.newDocument("made")
    part = document.addObject("App::Part", "Part")
    part.Placement = FreeCAD.Placement(FreeCAD.Vector(100, 0, 0), FreeCAD.Rotation(0, 0, 90))  # about x
    box = document.addObject("Part::Box", "Box")
    part.addObject(box)
    link = document.addObject("App::Link", "Link")
    link.LinkedObject = part
    link.Placement.Base = (0, 50, 0)
    document.recompute()
    out = {"drawings": [str(hlr.draw(thing, view="iso")) for thing in (shape, box, link, [box, shape])]}
    out["parts"] = [open_source(thing).names() for thing in (box, link, [box, shape], document)]
    out["bounds"] = [open_source(thing).bounds().tolist() for thing in (box, link)]
    direction = FreeCAD.Vector(0.3, 0.2, 1)
    out["ours"] = lengths(project_ex(shape, direction))
    out["theirs"] = lengths(TechDraw.projectEx(shape, direction))
    out["saved"] = document.FileName
    with open(os.environ["HLR_ANSWER"], "w") as file:
        json.dump(out, file)


main()
