"""Runs inside FreeCAD: five documents with pages of kinds that go wrong easily, and FreeCAD's drawings of their views.

Links in groups, arrays, scaled links, projection groups, and bodies in turned placements.
"""

import os
import time

import FreeCAD
import TechDraw

FOLDER = os.environ["HLR_FREECAD_FOLDER"]
V = FreeCAD.Vector


def placed(x, y, z, axis=(0, 0, 1), angle=0):
    return FreeCAD.Placement(V(x, y, z), FreeCAD.Rotation(V(*axis), angle))


def box(document, name, size, place=None):
    thing = document.addObject("Part::Box", name)
    thing.Length, thing.Width, thing.Height = size
    thing.Placement = place or placed(0, 0, 0)
    return thing


def pin(document, name, radius, height, place=None):
    thing = document.addObject("Part::Cylinder", name)
    thing.Radius, thing.Height = radius, height
    thing.Placement = place or placed(0, 0, 0)
    return thing


def view(document, page, sources, direction, right, **values):
    thing = document.addObject("TechDraw::DrawViewPart", "View")
    page.addView(thing)
    thing.Source = sources
    thing.Direction, thing.XDirection = V(*direction), V(*right)
    for name, value in {"ScaleType": "Custom", "X": 100, "Y": 100, **values}.items():
        setattr(thing, name, value)
    return thing


def three(document, page, sources, **values):
    view(document, page, sources, (0, -1, 0), (1, 0, 0), X=80, Y=220, HardHidden=True, **values)
    view(document, page, sources, (0, 0, 1), (1, 0, 0), X=80, Y=100, HardHidden=True, **values)
    view(document, page, sources, (1, -1, 1), (1, 1, 0), X=280, Y=180, **values)


def linked_groups(document, page):
    """A frame of posts: an array of links that are shown, in a turned part, that is linked twice."""
    post = box(document, "Post", (6, 6, 40), placed(2, 3, 0))
    posts = document.addObject("App::Link", "Posts")
    posts.LinkedObject = post
    posts.ShowElement = True
    posts.ElementCount = 3
    for number, each in enumerate(posts.ElementList):
        each.Placement = placed(30 * number, 0, 0, (0, 0, 1), 20 * number)
    plate = box(document, "Plate", (80, 20, 4), placed(0, -5, 40))
    frame = document.addObject("App::Part", "Frame")
    frame.Group = [posts, plate]
    post.Visibility = False
    frame.Placement = placed(0, 0, 0, (0, 0, 1), 10)
    copy = document.addObject("App::Link", "Copy")
    copy.LinkedObject = frame
    copy.Placement = placed(0, 60, 0, (0, 0, 1), -15)
    whole = document.addObject("App::Part", "Whole")
    whole.Group = [frame, copy]
    document.recompute()
    three(document, page, [whole])


def scaled_links(document, page):
    """A cone linked at a half, at one and a half, and uneven."""
    cone = document.addObject("Part::Cone", "Cone")
    cone.Radius1, cone.Radius2, cone.Height = 10, 4, 20
    things = [cone]
    for number, scale in enumerate(((0.5, 0.5, 0.5), (1.5, 1.5, 1.5))):
        link = document.addObject("App::Link", "Link")
        link.LinkedObject = cone
        link.ScaleVector = V(*scale)
        link.Placement = placed(35 * (number + 1), 0, 0, (1, 0, 0), 30 * number)
        things.append(link)
    brick = box(document, "Brick", (10, 10, 10), placed(110, 0, 0))
    flat = document.addObject("App::Link", "Flat")
    flat.LinkedObject = brick
    flat.ScaleVector = V(2, 1, 0.5)
    flat.Placement = placed(110, 25, 0, (0, 0, 1), 30)
    # Named itself in a view, 0.20 would move such a link by the place of its target as well.
    group = document.addObject("App::Part", "Bricks")
    group.Group = [brick, flat]
    document.recompute()
    three(document, page, [*things, group])


def arrays(document, page):
    """Drilled bricks in rows and around an axis, by the workbench Draft."""
    import Draft

    brick = document.addObject("Part::Cut", "Drilled")
    brick.Base = box(document, "Brick", (12, 8, 6))
    brick.Tool = pin(document, "Drill", 2, 20, placed(6, 4, -5))
    document.recompute()
    rows = Draft.make_ortho_array(brick, V(20, 0, 0), V(0, 15, 0), V(0, 0, 12), 3, 2, 2, use_link=True)
    wheel = Draft.make_polar_array(brick, 7, 360, V(0, 0, 0), use_link=False)
    wheel.Placement = placed(100, 20, 0, (1, 0, 0), 40)
    brick.Visibility = False
    document.recompute()
    three(document, page, [rows, wheel])


def turned_bodies(document, page):
    """Bodies of two features each, turned, one of them in a turned part."""
    bodies = []
    for number in range(2):
        body = document.addObject("PartDesign::Body", "Body")
        block = document.addObject("PartDesign::AdditiveBox", "Block")
        block.Length, block.Width, block.Height = 30, 20, 10
        body.addObject(block)
        hole = document.addObject("PartDesign::SubtractiveCylinder", "Hole")
        hole.Radius, hole.Height = 4, 30
        hole.Placement = placed(10, 10, -5)
        body.addObject(hole)
        body.Placement = placed(50 * number, 0, 0, (1, 2, 3), 35 + 40 * number)
        bodies.append(body)
    part = document.addObject("App::Part", "Part")
    part.addObject(bodies[1])
    part.Placement = placed(0, 20, 10, (0, 1, 0), 25)
    document.recompute()
    three(document, page, [bodies[0], part])


def projection_group(document, page):
    """A bracket in a group of six projections, in the third angle, at a scale of a half."""
    fuse = document.addObject("Part::MultiFuse", "Bracket")
    fuse.Shapes = [box(document, "Base", (60, 40, 8)), box(document, "Wall", (8, 40, 40))]
    cut = document.addObject("Part::Cut", "Holes")
    cut.Base, cut.Tool = fuse, pin(document, "Drill", 7, 30, placed(40, 15, -5))
    document.recompute()
    group = document.addObject("TechDraw::DrawProjGroup", "Group")
    page.addView(group)
    group.Source = [cut]
    group.ScaleType, group.Scale = "Custom", 0.5  # before the views: 1.0 draws none anew for it
    group.addProjection("Front")
    group.Anchor.Direction, group.Anchor.XDirection, group.Anchor.RotationVector = V(0, -1, 0), V(1, 0, 0), V(1, 0, 0)
    for name in ("Left", "Right", "Top", "Bottom", "FrontTopRight"):
        group.addProjection(name)
    group.ProjectionType = "Third Angle"
    group.X, group.Y = 200, 150
    for each in group.Views:
        each.HardHidden = True


def wait_for(view):
    """From 0.21 on another thread removes hidden lines, and says so through Qt's queue of events."""
    if FreeCAD.Version()[:2] == ["0", "20"]:
        return
    from PySide import QtCore

    events = QtCore.QCoreApplication.instance() or QtCore.QCoreApplication([])
    until = time.time() + 20
    while not view.getVisibleEdges() and time.time() < until:
        events.processEvents()
        time.sleep(0.02)


def main():
    for make in (linked_groups, scaled_links, arrays, turned_bodies, projection_group):
        document = FreeCAD.newDocument(make.__name__)
        page = document.addObject("TechDraw::DrawPage", "Page")
        template = document.addObject("TechDraw::DrawSVGTemplate", "Template")
        template.Template = os.path.join(FreeCAD.getResourceDir(), "Mod/TechDraw/Templates/A3_Landscape_blank.svg")
        page.Template = template
        make(document, page)
        document.recompute()
        folder = os.path.join(FOLDER, make.__name__)
        os.makedirs(folder, exist_ok=True)
        for thing in document.Objects:
            if thing.isDerivedFrom("TechDraw::DrawViewPart"):
                wait_for(thing)
                with open(os.path.join(folder, f"{make.__name__}.{thing.Name}.frag.svg"), "w") as file:
                    file.write(TechDraw.viewPartAsSvg(thing))
        document.saveAs(os.path.join(folder, f"{make.__name__}.FCStd"))


main()
