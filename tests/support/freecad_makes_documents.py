"""Runs inside FreeCAD: makes documents of parts, links and arrays at random places, and says where it has them.

Every second one keeps its shapes in binary.
"""

import json
import os
import random

import FreeCAD

FOLDER, COUNT = os.environ["HLR_FREECAD_FOLDER"], int(os.environ["HLR_FREECAD_COUNT"])


def placement(dice):
    axis = FreeCAD.Vector(*(dice.uniform(-1, 1) for _ in range(3)))
    shift = FreeCAD.Vector(*(dice.uniform(-50, 50) for _ in range(3)))
    return FreeCAD.Placement(shift, FreeCAD.Rotation(axis, dice.uniform(0, 360)))


def solid(document, dice):
    thing = document.addObject("Part::Wedge", "Wedge")
    thing.Xmax, thing.Ymax, thing.Zmax = (dice.uniform(11, 30) for _ in range(3))
    return thing


def cut(document, dice):
    base, tool = solid(document, dice), solid(document, dice)
    tool.Placement.Base = FreeCAD.Vector(5, 5, 5)
    thing = document.addObject("Part::Cut", "Cut")
    thing.Base, thing.Tool = base, tool
    base.Visibility = tool.Visibility = False
    return thing


def body(document, dice):
    thing = document.addObject("PartDesign::Body", "Body")
    for kind in ("Box", "Cylinder"):
        feature = document.addObject(f"PartDesign::Additive{kind}", kind)
        thing.addObject(feature)
    return thing


def linked(document, dice, targets):
    thing = document.addObject("App::Link", "Link")
    thing.LinkedObject = dice.choice(targets)
    thing.LinkTransform = dice.random() < 0.5
    match dice.randrange(4):
        case 0:
            thing.Scale = dice.choice((0.5, 2.0))
        case 1:
            thing.ScaleVector = FreeCAD.Vector(1.5, 1.0, 0.75)
        case 2:
            thing.ShowElement = dice.random() < 0.5
            thing.ElementCount = 3
            if thing.ShowElement:
                for each in thing.ElementList:
                    each.Placement = placement(dice)
                thing.setElementVisible(thing.ElementList[1].Name, dice.random() < 0.5)
            else:
                thing.PlacementList = [placement(dice) for _ in range(3)]
                thing.ScaleList = [FreeCAD.Vector(s, s, s) for s in (1, 2, 0.5)]
    return thing


def group(document, dice, some):
    if dice.random() < 0.3:
        thing = document.addObject("App::LinkGroup", "LinkGroup")
        thing.ElementList = some
        if dice.random() < 0.5:
            thing.setElementVisible(some[0].Name, False)
    else:
        thing = document.addObject("App::Part", "Part")
        thing.Group = some
        if dice.random() < 0.3:
            folder = document.addObject("App::DocumentObjectGroup", "Folder")
            inside = solid(document, dice)
            inside.Placement = placement(dice)
            folder.addObject(inside)
            thing.addObject(folder)
    return thing


def made(document, dice):
    """Fill a document; returns what nothing else holds."""
    free = []
    for _ in range(3):
        free.append(dice.choice((solid, cut, body))(document, dice))
    for _ in range(8):
        if dice.random() < 0.5:
            free.append(linked(document, dice, free))
        else:
            some = dice.sample(free, min(len(free), dice.randint(1, 2)))
            free = [each for each in free if each not in some]
            free.append(group(document, dice, some))
        free[-1].Placement = placement(dice)
        if dice.random() < 0.2:
            dice.choice(free).Visibility = False
    return free


def solids(root, path=""):
    """[volume, x, y, z of the centre] of all solids that an object shows.

    One by one through the tree: for a link alone Part.getShape counts the placement of its target twice.
    """
    thing = root.getSubObject(path, 1) if path else root
    inside = (
        []
        if thing.getLinkedObject(True).isDerivedFrom("Part::Feature") and not arrayed(thing)
        else thing.getSubObjects()
    )
    if not inside:
        shape = root.getSubObject(path, 0)
        return [[s.Volume, *s.CenterOfMass] for s in ([] if shape is None or shape.isNull() else shape.Solids)]
    found = []
    # A part lists what is in its folders beside these once more. Each object is shown once.
    folders = [
        each
        for each in getattr(thing.getLinkedObject(True), "Group", ())
        if each.isDerivedFrom("App::DocumentObjectGroup") and each.Visibility
    ]
    in_folders = {f"{each.Name}." for folder in folders for each in folder.Group}
    for name in inside:
        if name in in_folders:
            continue
        shown = thing.isElementVisible(name.rstrip("."))
        if shown == -1:
            shown = root.getSubObject(path + name, 1).Visibility
        if shown:
            found += solids(root, path + name)
    return sorted(found)


def arrayed(thing):
    return getattr(thing, "ElementCount", 0) > 0


def main():
    out = {}
    for seed in range(COUNT):
        dice = random.Random(seed)
        FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Document").SetBool("SaveBinaryBrep", seed % 2 == 1)
        document = FreeCAD.newDocument(f"made{seed}")
        free = made(document, dice)
        document.recompute()
        path = os.path.join(FOLDER, f"made{seed}.FCStd")
        document.saveAs(path)
        out[path] = {thing.Label: solids(thing) for thing in free if thing.Visibility}
        FreeCAD.closeDocument(document.Name)
    with open(os.path.join(FOLDER, "found.json"), "w") as file:
        json.dump(out, file)


main()
