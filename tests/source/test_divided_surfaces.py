"""Edges that only divide a surface into faces are seams; edges between two surfaces stay tangent edges."""

from __future__ import annotations

import pytest

import hlr
from hlr.source import open_source

cq = pytest.importorskip("cadquery")


def halves(whole):
    """Both halves of a solid, joined without merging their faces."""
    half = cq.Workplane().box(100, 100, 100, centered=(True, False, True))
    return whole.intersect(half, clean=False).union(whole.intersect(half.mirror("XZ"), clean=False), clean=False)


def vase():
    profile = cq.Workplane("XZ").lineTo(3, 0).spline([(2, 2), (3, 4), (1, 6)], includeCurrent=True)
    return profile.lineTo(0, 6).close()


def turned(half):
    """A half body and the same turned about z, joined. The faces of the second have a placement of their own."""
    other = half.val().moved(cq.Location(cq.Vector(), cq.Vector(0, 0, 1), 180))
    return half.union(cq.Workplane(obj=other), clean=False)


def as_splines(whole):
    from OCP.BRepBuilderAPI import BRepBuilderAPI_NurbsConvert

    return cq.Workplane(obj=cq.Shape.cast(BRepBuilderAPI_NurbsConvert(whole.val().wrapped, True).Shape()))


def cylinder():
    return cq.Workplane().cylinder(10, 3)


def stacked(radius):
    lower = cq.Workplane().circle(3).extrude(4)
    return lower.union(cq.Workplane().workplane(offset=4).circle(radius).extrude(4), clean=False)


def bow(radius):
    """A plate with an arc of radius 3 that goes on as an arc of another radius."""
    arcs = cq.Workplane().moveTo(0, -3).radiusArc((3, 0), -3).radiusArc((3 - radius, radius), -radius)
    return arcs.lineTo(-20, radius).lineTo(-20, -3).close().extrude(2)


@pytest.mark.parametrize(
    ("make", "seams"),
    [
        (lambda: halves(cylinder()), 4),
        (lambda: halves(cq.Workplane(obj=cq.Solid.makeCone(3, 1, 5))), 4),
        (lambda: halves(cq.Workplane(obj=cq.Solid.makeCone(3, 0, 5))), 3),
        (lambda: halves(cq.Workplane().sphere(4)), 2),
        (lambda: halves(cq.Workplane(obj=cq.Solid.makeTorus(6, 2))), 4),
        (lambda: halves(vase().revolve(360, (0, 0), (0, 1))), 4),
        (lambda: turned(vase().revolve(180, (0, 0), (0, 1))), 4),
        (lambda: turned(cq.Workplane().moveTo(3, 0).threePointArc((0, 3), (-3, 0)).close().extrude(4)), 4),
        (lambda: as_splines(halves(cylinder())), 4),
        (lambda: halves(cq.Workplane().box(5, 5, 5)), 4),
        (lambda: stacked(3), 3),
    ],
    ids=["cylinder", "cone", "pointed", "sphere", "torus", "vase", "turned", "placed", "splines", "box", "stacked"],
)
def test_an_edge_that_divides_a_surface_is_a_seam(make, seams, classes):
    (part,) = open_source(make()).mesh(0.02, 0.2).parts
    _, smooth, found, _ = classes(part)
    assert (smooth, found) == (0, seams)


@pytest.mark.parametrize(
    ("make", "expected"),
    [
        # A cylinder beside a plane, rounds beside one another, and arcs of nearly the same radius.
        (lambda: cq.Workplane().slot2D(10, 4).extrude(2), [8, 4, 0, 0]),
        (lambda: cq.Workplane().box(3, 4, 5).edges().fillet(1), [0, 48, 0, 0]),
        (lambda: bow(3.001), [12, 3, 0, 0]),
        # A step of a thousandth has edges of its own.
        (lambda: stacked(3.001), [4, 0, 2, 0]),
        # Halves that are tilted against one another have a fold.
        (
            lambda: cq.Workplane().polyline([(-4, 0), (0, 0.1), (4, 0), (4, 3), (-4, 3)]).close().extrude(2),
            [15, 0, 0, 0],
        ),
    ],
    ids=["slot", "fillets", "bow", "step", "fold"],
)
def test_an_edge_between_two_surfaces_is_no_seam(make, expected, classes):
    (part,) = open_source(make()).mesh(0.02, 0.2).parts
    assert classes(part) == expected


def test_seams_are_drawn_on_request_only():
    def kinds(**options):
        return {line.kind for line in hlr.draw(halves(cylinder()), "iso", **options).lines}

    assert kinds() == {"sharp", "outline"}
    assert kinds(seam=True) == {"sharp", "outline", "seam"}
