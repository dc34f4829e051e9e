"""What may touch another part is meshed more finely: facets of one surface must not part by more than a deflection.

A part that is one solid and comes near no other needs no such care. `test_touching_faces` has the faces one by one.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest
from OCP.BRepBuilderAPI import BRepBuilderAPI_NurbsConvert

import hlr
from hlr import _kernel
from hlr.pipeline import session
from hlr.pipeline.session import Session
from hlr.request.accuracy import ALONE, TOUCHING
from hlr.scene.build import build
from hlr.source import open_source
from support.at_size import AT_SIZE

RADIUS, DEFLECTION = 10.0, 0.02


def shaft(x: float) -> cq.Solid:
    return cq.Solid.makeCylinder(RADIUS, 30, cq.Vector(x, 0, 0))


def ring(x: float) -> cq.Solid:
    """A ring, which bends both ways."""
    return cq.Solid.makeTorus(RADIUS, 3, cq.Vector(x, 0, 0))


def through_itself() -> cq.Shape:
    """A tube that bends so sharply that its wall passes through itself."""
    path = cq.Workplane("XY").spline([(0, 0), (14.9, 8), (18.3, 16), (3.9, 24), (14.2, 32)])
    return cq.Workplane("XZ").circle(2.9).sweep(path).val()


def meshed(*solids):
    return open_source(cq.Compound.makeCompound(solids)).mesh(DEFLECTION, 0.5)


def chord_error(part, x):
    """How far the middles of a shaft's chords lie inside it."""
    a, b, c = (part.points[part.triangles[:, k]] for k in range(3))
    middles = np.concatenate([(a + b) / 2, (b + c) / 2, (c + a) / 2]) - (x, 0, 0)
    wall = (middles[:, 2] > 0.1) & (middles[:, 2] < 29.9)
    return RADIUS - np.hypot(middles[wall, 0], middles[wall, 1]).min()


def test_only_parts_that_come_near_others_are_meshed_finely():
    found = meshed(shaft(0), shaft(2 * RADIUS), shaft(100))
    assert found.touching.tolist() == [3, 3, 0]
    errors = [chord_error(part, x) for part, x in zip(found.parts, (0, 2 * RADIUS, 100), strict=True)]
    fine, coarse = TOUCHING * DEFLECTION, ALONE * DEFLECTION
    assert max(errors[:2]) <= fine * 1.001
    assert fine < errors[2] <= coarse * 1.001


@pytest.mark.parametrize("make", [shaft, ring])
def test_a_solid_alone_has_fewer_triangles(make):
    alone, beside = meshed(make(0)), meshed(make(0), make(20))
    assert not alone.touching.any() and beside.touching.all()
    assert len(alone.parts[0].triangles) < 0.85 * len(beside.parts[0].triangles)


def test_within_the_contact_depth_they_may_touch():
    for gap, near in ((0.0, True), (2.4 * 2 * DEFLECTION, True), (1.0, False)):
        found = meshed(shaft(0), shaft(2 * RADIUS + gap))
        assert found.touching.tolist() == [3 * near, 3 * near], gap


def test_instances_of_one_shape_have_one_mesh_and_the_finest_counts():
    one = shaft(0)
    moved = [one.moved(cq.Location(cq.Vector(x, 0, 0))) for x in (0, 20, 300)]
    found = meshed(*moved)
    assert found.touching.tolist() == [3, 3, 0]
    assert len({len(part.triangles) for part in found.parts}) == 1


def test_lines_of_a_sketch_touch_nothing():
    found = meshed(shaft(0), cq.Edge.makeLine(cq.Vector(-20, 0, 15), cq.Vector(20, 0, 15)))
    assert not found.touching.any()


def test_faces_outside_a_solid_may_touch_one_another():
    assert meshed(*shaft(0).Faces()).touching.tolist() == [3]


def test_a_part_alone_is_meshed_alike_wherever_others_are():
    beside, alone = meshed(shaft(0), shaft(20), shaft(100)), meshed(shaft(100))
    assert np.array_equal(beside.parts[2].points, alone.parts[0].points)
    assert np.array_equal(beside.parts[2].triangles, alone.parts[0].triangles)


def test_a_surface_through_itself_is_meshed_as_finely_as_parts_that_touch():
    opened = Session(through_itself(), [], hlr.Options())
    scene, found = opened.scene_at(DEFLECTION)
    assert scene.through_themselves == {0} and found.touching.tolist() == [len(through_itself().Faces())]
    assert len(scene.triangles) > 1.2 * sum(len(p.triangles) for p in opened.source.mesh(DEFLECTION, 0.5).parts)
    # A second drawing at a scale where it is not asked for does not depend on the first.
    assert not opened.source.mesh(DEFLECTION, 0.5).touching.any()


def test_the_plan_says_how_many():
    def decided(*solids):
        return next(
            d
            for d in hlr.draw(cq.Compound.makeCompound(solids), **AT_SIZE).plan
            if d.name == "finer mesh where parts touch"
        )

    assert not decided(shaft(0)).on and decided(shaft(0)).reason == "one solid touches no other"
    assert decided(shaft(0), shaft(100)).reason == "no part comes near another"
    three = decided(shaft(0), shaft(20), shaft(100))
    assert (
        three.on
        and three.reason == "2 parts may touch others"
        and three.counts == {"touching_parts": 2, "touching_faces": 6}
    )


def why(scene_of, **options):
    decided = hlr.draw(scene_of, **options, **AT_SIZE).plan
    return next((d.reason, d.counts["touching_parts"]) for d in decided if d.name == "finer mesh where parts touch")


def test_the_plan_names_a_surface_through_itself():
    far = shaft(0).moved(cq.Location(cq.Vector(300, 0, 0)))
    assert why(through_itself()) == ("its surface passes through itself", 1)
    assert why(cq.Compound.makeCompound([through_itself(), far])) == ("1 part may touch others or themselves", 1)


def test_the_plan_says_that_filled_faces_need_it():
    reason = "the light on filled faces changes from triangle to triangle"
    assert why(shaft(0), fill=True) == (reason, 1)
    assert why(cq.Compound.makeCompound([shaft(0), shaft(100)]), fill=True) == (reason, 2)


def test_parts_of_a_model_that_is_meshed_twice_count_once(monkeypatch):
    meshings = []

    def counted(*how):
        meshings.append(how)
        return build(*how)

    monkeypatch.setattr(session, "build", counted)
    # The control points of the balls reach farther than these do: their scale is larger than was foreseen.
    ball = cq.Solid.makeSphere(5, angleDegrees1=-90, angleDegrees2=90)
    ball = cq.Shape.cast(BRepBuilderAPI_NurbsConvert(ball.wrapped).Shape())
    two = cq.Compound.makeCompound([ball, ball.moved(cq.Location(cq.Vector(0, 0, 10)))])
    drawing = hlr.draw(two, (1, 1, 1), fit=(100, 100))
    assert len(meshings) == 2
    found = next(d for d in drawing.plan if d.name == "finer mesh where parts touch")
    assert found.counts == {"touching_parts": 2, "touching_faces": 2}


@pytest.mark.parametrize("shares", [[0.5, 0.0, 1], [1.5, 1, 1], [1, 1, float("nan")], [0.5, 0.5], []])
def test_shares_that_are_none_are_refused(shares):
    source = open_source(shaft(0))
    source.mesh(DEFLECTION, 0.5)
    with pytest.raises(ValueError, match="shares"):
        source._part_tessellator._model.mesh(DEFLECTION, 0.5, None, np.array(shares, float))


def test_boxes_that_come_near_are_found():
    box = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
    corners = np.stack([box, box + (1.1, 0, 0), box + (9, 9, 9)])
    assert _kernel.boxes_near(corners, 0.0).tolist() == [False, False, False]
    assert _kernel.boxes_near(corners, 0.06).tolist() == [True, True, False]
