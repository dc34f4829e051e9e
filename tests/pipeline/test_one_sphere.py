"""A sphere alone is meshed coarsely where lines are all that is asked for: its one line stays the same."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import hlr
from hlr.pipeline.session import Session
from hlr.request.check import checked
from hlr.source import open_source

cq = pytest.importorskip("cadquery")

VIEWS = [tuple(v) for v in np.random.default_rng(7).normal(size=(20, 3))]


def ball(radius=10.0) -> Any:
    return cq.Workplane().sphere(radius)


def half(up: int) -> Any:
    return ball().intersect(cq.Workplane().box(40, 40, 40).translate((0, 0, 20 * up)))


def capsule() -> Any:
    upper, lower = ball().translate((0, 0, 8)), ball().translate((0, 0, -8))
    return cq.Workplane().cylinder(16, 10).union(upper).union(lower)


def turned_round(shape: Any) -> Any:
    return cq.Shape.cast(shape.val().wrapped.Reversed())


def shell(faces: list[Any]) -> Any:
    """Faces as they are, in one shell that is no solid."""
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Shell

    made, builder = TopoDS_Shell(), BRep_Builder()
    builder.MakeShell(made)
    for face in faces:
        builder.Add(made, face.wrapped)
    return cq.Shell(made)


SPHERES = {
    "as made": ball,
    "turned and moved": lambda: ball().rotate((0, 0, 0), (1, 2, 3), 50).translate((5, -7, 900)),
    "mirrored": lambda: cq.Workplane(ball().val().mirror("XZ", (0, 3, 0))),
    "a shell that is no solid": lambda: shell(ball().faces().vals()),
}

OTHERS = {
    "box": lambda: cq.Workplane().box(3, 4, 5),
    "cylinder": lambda: cq.Workplane().cylinder(10, 4),
    "frustum": lambda: cq.Solid.makeCone(6, 3, 8),
    "filleted box": lambda: cq.Workplane().box(9, 9, 9).edges().fillet(2),
    "hemisphere": lambda: half(1),
    "half a sphere's face": lambda: shell(half(1).faces("%SPHERE").vals()),
    "a sphere in two halves": lambda: half(1).union(half(-1), clean=False),
    "capsule": capsule,
    "box with a hole": lambda: cq.Workplane().box(9, 9, 9).faces(">Z").workplane().hole(3),
    "drilled sphere": lambda: ball().cut(cq.Workplane().cylinder(40, 2)),
    "torus": lambda: cq.Solid.makeTorus(10, 3),
    "concave fillet": lambda: cq.Workplane().box(9, 9, 3).union(cq.Workplane().box(3, 3, 9)).edges("|X").fillet(0.5),
    "inside out": lambda: turned_round(ball()),
    "with a void": lambda: ball().cut(ball(5.0)),
    "two in one part": lambda: cq.Compound.makeCompound([ball().val(), ball(3.0).translate((30, 0, 0)).val()]),
}


@pytest.mark.parametrize("make", SPHERES.values(), ids=SPHERES)
def test_whole_spheres_are_found(make):
    assert open_source(make()).is_one_sphere()


@pytest.mark.parametrize("make", OTHERS.values(), ids=OTHERS)
def test_nothing_else_is(make):
    assert not open_source(make()).is_one_sphere()


def test_two_parts_are_not_one():
    assert not open_source([ball().val(), ball(3.0).translate((30, 0, 0)).val()]).is_one_sphere()


@pytest.mark.slow
@pytest.mark.parametrize("make", SPHERES.values(), ids=SPHERES)
def test_the_circle_is_that_of_a_fine_mesh_to_the_last_bit(make, monkeypatch):
    shape, views = make(), ["front", "top", "iso", (1, -2, 0), (0, -1, 1e-9), *VIEWS]
    for options in (hlr.Options(smooth=True, details=True), hlr.Options(scale=0.3, hidden=True)):
        drawings = hlr.draw_views(shape, views, options)
        with monkeypatch.context() as patch:
            patch.setattr("hlr.pipeline.session.SPHERE_MESH", 1.0)
            wanted = hlr.draw_views(shape, views, options)
        for drawing, expected in zip(drawings, wanted, strict=True):
            assert not fine(drawing)
            (line,), (other,) = drawing.lines, expected.lines
            assert (line.kind, line.visible, line.curve.whole) == ("outline", True, True)
            assert (line.points == other.points).all()
            assert (line.points3 == other.points3).all()
            assert drawing.to_svg() == expected.to_svg()
            assert off_circle(line) <= 0.4 * drawing.accuracy.used, "a tenth for chords, a quarter for points left out"


def fine(drawing: hlr.Drawing) -> bool:
    return next(decision.on for decision in drawing.plan if decision.name == "fine mesh")


def off_circle(line: hlr.Line) -> float:
    """How far the chords between the line's points are off its circle, millimetres on paper."""
    middle = 0.5 * (line.points[1:] + line.points[:-1])
    return float(np.abs(np.linalg.norm(middle - line.curve.centre, axis=1) - line.curve.radii[0]).max())


@pytest.mark.parametrize(
    "options",
    [{"fill": True}, {"seam": True}, {"fit": (30, 20)}, {"window": (0, 0, 5, 5)}, {"perspective": hlr.Perspective()}],
    ids=["fill", "seam", "fit", "window", "perspective"],
)
def test_what_needs_the_mesh_has_a_fine_one(options):
    assert fine(hlr.draw(ball(2.0), **options))


def test_pictures_have_a_fine_mesh():
    session = Session(ball(), ["iso"], checked(hlr.Options()))
    session.drafts()
    pictured = len(session.scene.triangles)
    session.drafts(lines_alone=True)
    assert 100 < len(session.scene.triangles) < 500
    assert pictured > 5000
