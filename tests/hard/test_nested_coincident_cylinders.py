"""Cylinders that share one surface and are cut into faces differently: two halves here, three thirds there.

Seams and chords of the two meshes fall on different generators, so each pierces the other everywhere. Seen from outside
the pair must look like one.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest
from hard.brep import compound, like, ring, same, turn

import hlr
from support.at_size import AT_SIZE
from support.expected import Ink, expect, ink

RADIUS, HEIGHT = 10.0, 30.0


def in_sectors(count, turned, low=0.0, high=HEIGHT, inner=0.0, outer=RADIUS):
    """A cylinder or tube whose wall consists of `count` faces, the first border at this angle."""
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeRevol
    from OCP.gp import gp_Ax1, gp_Dir, gp_Pnt

    face = cq.Workplane("XZ").moveTo(inner, low).lineTo(outer, low).lineTo(outer, high).lineTo(inner, high).close()
    surface = cq.Face.makeFromWires(face.val())
    step = 360 / count
    sectors = []
    for k in range(count):
        axis = gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1))
        solid = cq.Shape.cast(BRepPrimAPI_MakeRevol(surface.wrapped, axis, 3.141592653589793 * step / 180).Shape())
        sectors.append(solid.rotate((0, 0, 0), (0, 0, 1), turned + k * step))
    return sectors[0].fuse(*sectors[1:]) if count > 1 else sectors[0]


def test_a_cylinder_twice_is_drawn_like_one(picture):
    whole = cq.Solid.makeCylinder(RADIUS, HEIGHT)
    for view in ("iso", "front", (0.3, -1, 0.2)):
        alone = hlr.draw(whole, view, **AT_SIZE)
        pair = hlr.draw(compound(whole, in_sectors(3, 17.0)), view, **AT_SIZE)
        same(alone, pair)
        if view == "iso":
            picture(pair)


NEAR = 20
"""Degrees from a generator seen edge-on, within which contact tolerance may decide about a rim."""


@pytest.mark.slow
def test_a_tube_around_a_cylinder_of_its_own_bore(picture):
    """A ring around a cylinder of its own bore, seen from above: only the front half of its inner rim is seen."""
    view = turn((0, -1, 0), (1, 0, 0), -35)
    low, top, wide = 5.0, 9.0, 24.0
    model = compound(cq.Solid.makeCylinder(RADIUS, 16), in_sectors(3, 41.0, low, top, RADIUS, wide))
    drawing = hlr.draw(model, view, **AT_SIZE)
    seen = [*ring(RADIUS, 16), *ring(wide, top), *ring(wide, low, 180, 360), *ring(RADIUS, top, 200, 340)]
    entry = RADIUS * np.sin(np.radians(NEAR)) * np.tan(np.radians(35))
    seen += [((x, 0, top + entry), (x, 0, 16)) for x in (RADIUS, -RADIUS)]
    seen += [((x, 0, low), (x, 0, top)) for x in (wide, -wide)]
    unseen = [*ring(wide, low, 0, 180), *ring(RADIUS, 0, NEAR, 180 - NEAR)]
    for z in (top, low):
        unseen += ring(RADIUS, z, NEAR, 180 - NEAR)
    unseen += [*ring(RADIUS, low, 200, 340), *ring(RADIUS, 0, 200, 340)]
    either = [((x, 0, 0), (x, 0, 16)) for x in (RADIUS, -RADIUS)]
    for z in (0, low, top):
        either += ring(RADIUS, z, -NEAR, NEAR) + ring(RADIUS, z, 180 - NEAR, 180 + NEAR)
    like(drawing, expect(drawing, seen, unseen), either=either)
    # Where a rim of the tube touches the generator of the cylinder, a hidden line, the two lie on one another.
    picture(drawing, "tube", twice=0.3)


@pytest.mark.slow
@pytest.mark.parametrize("view", ["iso", (0.2, -1, 0.6)])
def test_a_cylinder_inside_a_longer_one_shows_its_rims_in_front(view):
    """They lie in the surface of the other: like coplanar faces, neither hides the other's lines."""
    outer = cq.Solid.makeCylinder(RADIUS, HEIGHT)
    drawing = hlr.draw(compound(outer, in_sectors(2, 23.0, 8, 20)), view, **AT_SIZE)
    alone = ink(hlr.draw(outer, view, **AT_SIZE))
    front = float(np.degrees(np.arctan2(drawing.view.direction[1], drawing.view.direction[0])))
    seen, unseen, either = [], [], []
    for z in (8, 20):
        seen += ring(RADIUS, z, front - 90 + NEAR, front + 90 - NEAR)
        unseen += ring(RADIUS, z, front + 90 + NEAR, front + 270 - NEAR)
        for side in (90, -90):
            either += ring(RADIUS, z, front + side - NEAR, front + side + NEAR)
    rims = expect(drawing, seen, unseen)
    both = (np.concatenate([getattr(rims, k), getattr(alone, k)]) for k in ("visible", "hidden"))
    like(drawing, Ink(*both), either=either)
