"""Small models whose lines OpenCASCADE's own projection gets right in general views."""

import cadquery as cq


def plate():
    """Straight edges, tangent edges, circles and outlines, all facing z."""
    return cq.Workplane().box(40, 30, 20).edges("|Z").fillet(6).faces(">Z").workplane().cboreHole(8, 14, 5)


def cylinder():
    """A cylinder off the origin, turned."""
    return cq.Workplane().cylinder(20, 6).rotate((0, 0, 0), (1, 0.3, 0), 25).translate((30, -20, 10))


def vase():
    """A part of a torus and a cone, turned around z."""
    return (
        cq.Workplane("XZ").lineTo(10, 0).threePointArc((14, 6), (10, 12)).lineTo(6, 20).lineTo(0, 20).close().revolve()
    )


def pair():
    """Two boxes, one before the other."""
    return cq.Workplane().box(10, 10, 10).add(cq.Workplane().box(5, 5, 5).translate((4, -20, 3)))


def path():
    """An edge beside a box. (OpenCASCADE's projection does not see where an edge enters a solid.)"""
    return cq.Workplane().box(10, 10, 10).add(cq.Edge.makeLine((-9, 8, 9), (9, 7, -3)))


MODELS = {"plate": plate, "cylinder": cylinder, "vase": vase, "pair": pair, "path": path}
STRAIGHT = {"pair", "path"}
"""Those whose edges are all straight."""
