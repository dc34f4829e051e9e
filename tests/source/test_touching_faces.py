"""Of a part that is one solid, only the faces that come near another part are meshed more finely.

A pin goes through the wall of a long tube: the wall and the pin are fine, the rounded ends of both are not.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest
from OCP.BRepBuilderAPI import BRepBuilderAPI_NurbsConvert

import hlr
from hlr import _kernel
from hlr.pipeline.session import Session
from hlr.source import open_source
from support.at_size import AT_SIZE

DEFLECTION = 0.02


def tube() -> cq.Solid:
    """200 long, with rounded ends."""
    return cq.Workplane().circle(20).circle(16).extrude(200).faces(">Z or <Z").edges().fillet(1.5).val()


def pin(x: float = 0.0) -> cq.Solid:
    """Across the tube, in its middle: its ends stand out."""
    return (
        cq.Workplane("YZ").circle(4).extrude(70).faces("<X or >X").edges().fillet(1.5).translate((x - 35, 3, 100)).val()
    )


def at(x: float) -> cq.Location:
    return cq.Location(cq.Vector(x, 0, 0))


def meshed(*solids, wholly=False):
    source = open_source(cq.Compound.makeCompound(solids))
    return source.mesh(DEFLECTION, 0.5, finer=source.names() if wholly else ())


def triangles(part) -> list[int]:
    """Triangles of each face."""
    return np.bincount(part.triangle_face, minlength=len(part.face_planar)).tolist()


def kinds(shape: cq.Shape) -> list[str]:
    return [face.geomType() for face in shape.Faces()]


def test_faces_that_come_near_no_other_part_are_meshed_coarsely():
    together, alone = meshed(tube(), pin()), [meshed(make()).parts[0] for make in (tube, pin)]
    # The walls of the tube and the pin, and no other face.
    assert together.touching.tolist() == [2, 1]
    fine = meshed(tube(), pin(), wholly=True)
    assert fine.touching.tolist() == [len(tube().Faces()), len(pin().Faces())]
    for i, shape in enumerate((tube(), pin())):
        rows = zip(kinds(shape), *map(triangles, (together.parts[i], fine.parts[i], alone[i])), strict=True)
        for kind, found, finest, coarsest in rows:
            if kind == "CYLINDER":
                assert found == finest > coarsest
            elif kind == "TORUS" and shape.BoundingBox().zlen > 100:
                # Beside a fine wall, its own border is fine, too.
                assert 0.9 * coarsest < found < 0.75 * finest


@pytest.mark.parametrize("solids", [(tube, pin), (lambda: cq.Workplane().box(60, 60, 20).edges().fillet(4).val(), pin)])
def test_a_coarse_face_fits_the_fine_one_beside_it(solids):
    for part in meshed(*(make() for make in solids)).parts:
        corners = part.triangles
        sides = np.sort(np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]]), axis=1)
        _, counts = np.unique(sides, axis=0, return_counts=True)
        assert (counts == 2).all()


def test_a_face_that_is_used_several_times_is_fine_if_one_of_them_needs_it():
    one = tube()
    found = meshed(one.moved(at(0)), pin(), one.moved(at(100)))
    assert found.touching.tolist() == [2, 1, 0]
    assert triangles(found.parts[0]) == triangles(found.parts[2])


def test_where_parts_stand_turned_their_faces_are_found():
    turn = cq.Location(cq.Vector(5, 6, 7), cq.Vector(1, 2, 3), 40)
    found = meshed(tube().moved(turn), pin().moved(turn))
    # The box of the wall is wider there, and holds the ends of the pin; those of the tube are still far from it.
    assert found.touching.tolist() == [2, len(pin().Faces())]


def test_faces_outside_a_solid_are_all_fine():
    """They may touch one another."""
    shell = cq.Shell.makeShell(tube().Faces())
    # Solids come first.
    assert meshed(pin(), shell).touching.tolist() == [1, len(shell.Faces())]
    assert meshed(tube().moved(at(300)), shell).touching.tolist() == [0, len(shell.Faces())]


def test_a_part_through_itself_is_wholly_fine_where_one_of_its_faces_was():
    path = cq.Workplane("XY").spline([(0, 0), (14.9, 8), (18.3, 16), (3.9, 24), (14.2, 32)])
    bent = cq.Workplane("XZ").circle(2.9).sweep(path).val()
    session = Session(
        cq.Compound.makeCompound([bent, cq.Solid.makeBox(4, 4, 4, cq.Vector(-2, -4, -2))]), [], hlr.Options()
    )
    # The box touches one end, and comes near the wall.
    assert 0 < session.source.mesh(DEFLECTION, 0.5).touching[0] < len(bent.Faces())
    scene, found = session.scene_at(DEFLECTION)
    assert scene.through_themselves == {0} and found.touching[0] == len(bent.Faces())


def test_the_plan_counts_the_faces():
    drawing = hlr.draw(cq.Compound.makeCompound([tube(), pin()]), **AT_SIZE)
    found = next(d for d in drawing.plan if d.name == "finer mesh where parts touch")
    assert found.reason == "2 parts may touch others"
    assert found.counts == {"touching_parts": 2, "touching_faces": 3}


def spline() -> cq.Shape:
    """A barrel of splines."""
    barrel = cq.Workplane("XZ").moveTo(0, 0).lineTo(5, 0).threePointArc((8, 6), (5, 12)).lineTo(0, 12).close().revolve()
    return cq.Shape.cast(BRepBuilderAPI_NurbsConvert(barrel.val().wrapped).Shape())


def vase() -> cq.Shape:
    outline = cq.Workplane("XZ").moveTo(0, 0).lineTo(4, 0).spline([(7, 5), (3, 9), (5, 14)], includeCurrent=True)
    return outline.lineTo(0, 14).close().revolve().val()


SHAPES = {
    "ball": lambda: cq.Solid.makeSphere(5, angleDegrees1=-90, angleDegrees2=90),
    "cap": lambda: cq.Workplane().sphere(10).intersect(cq.Workplane().box(30, 30, 4).translate((0, 0, 8))).val(),
    "ring": lambda: cq.Solid.makeTorus(10, 3),
    "quarter of a ring": lambda: cq.Workplane("XZ").center(10, 0).circle(3).revolve(90, (-10, 0), (-10, 1)).val(),
    "cone": lambda: cq.Solid.makeCone(6, 0, 9),
    "rounded box": lambda: cq.Workplane().box(8, 9, 10).edges().fillet(2).val(),
    "barrel": spline,
    "vase": vase,
    "extruded": lambda: cq.Workplane().ellipse(6, 3).extrude(7).val(),
    "twisted": lambda: cq.Workplane().rect(6, 3).twistExtrude(9, 70).val(),
}


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("angle", [0.0, 33.0])
def test_whatever_comes_near_a_face_is_found(name, angle):
    """A small box at the outermost corner of each face in each direction is near that face."""
    turned = SHAPES[name]().moved(cq.Location(cq.Vector(1, 2, 3), cq.Vector(3, 1, 2), angle))
    (part,) = meshed(turned).parts
    for face in range(len(part.face_planar)):
        corners = part.points[np.unique(part.triangles[part.triangle_face == face])]
        for way in np.vstack([np.eye(3), -np.eye(3), [[0.6, 0.0, 0.8]]]):
            far = corners[np.argmax(corners @ way)] + 2.0 * DEFLECTION * way
            speck = cq.Solid.makeBox(0.01, 0.01, 0.01, cq.Vector(*(far - 0.005)))
            source = open_source(cq.Compound.makeCompound([turned, speck]))
            model = source._part_tessellator._model
            places = np.ascontiguousarray(source._places[:, :3])
            near, counts = _kernel.faces_near(model, source._used_numbers, places, np.zeros(2, bool), 2.0 * DEFLECTION)
            assert near[face] and counts[1] > 0, (face, way)
