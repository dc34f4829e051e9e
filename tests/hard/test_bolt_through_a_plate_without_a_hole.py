"""A bolt modelled through solid material, as in many an assembly: no edge lies where it enters.

Programs that look only at edges and contours let the shank show through the plate (FreeCAD: parts of an assembly are
taken as if apart) or lose the end of its generators. Here visibility changes in the middle of generators and there
alone, on the planes of the plate.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest
from hard.brep import box_edges, like, ring, turn

import hlr
from support.at_size import AT_SIZE
from support.expected import expect, of_kind

SIDE, THICK = 30.0, 4.0
SHANK, LOW, TOP = 5.0, -12.0, 14.0
VIEW = turn((0, -1, 0), (1, 0, 0), -40)
"""Forty degrees above the front."""


def model():
    assembly = cq.Assembly()
    assembly.add(cq.Workplane().box(2 * SIDE, 2 * SIDE, 2 * THICK), name="plate")
    assembly.add(cq.Workplane(obj=cq.Solid.makeCylinder(SHANK, TOP - LOW, cq.Vector(0, 0, LOW))), name="bolt")
    return assembly


ENTRY = 0.6
"""The outline is that generator of the mesh that the contour runs along: up to half a chord beside the true one, where
the slanting plane is met higher or lower by as much."""


def expected(drawing, entry):
    low, high = (-SIDE, -SIDE, -THICK), (SIDE, SIDE, THICK)
    seen, unseen = box_edges(low, high, VIEW)
    seen += ring(SHANK, TOP)
    for x in (SHANK, -SHANK):
        seen.append(((x, 0, THICK + entry), (x, 0, TOP)))
        unseen.append(((x, 0, LOW + entry), (x, 0, THICK - entry)))
    return expect(drawing, seen, unseen + ring(SHANK, LOW))


def intersections(drawing):
    """Above the front half is seen; what is about the generators may go either way."""
    seen, unseen = ring(SHANK, THICK, 180, 360), ring(SHANK, THICK, 0, 180) + ring(SHANK, -THICK)
    ends = [((x, 0, LOW), (x, 0, THICK + ENTRY)) for x in (SHANK, -SHANK)]
    return seen + unseen + ends


def test_the_plate_hides_the_shank_from_where_it_enters(picture):
    drawing = hlr.draw(model(), VIEW, **AT_SIZE)
    like(drawing, expected(drawing, ENTRY), either=intersections(drawing))
    picture(drawing, twice=1.0)


def test_the_generators_enter_at_the_very_height():
    drawing = hlr.draw(model(), VIEW, **AT_SIZE)
    for x in (SHANK, -SHANK):
        sides = [line.points3 for line in of_kind(drawing, "outline", True) if abs(line.points3[:, 0] - x).max() < 0.1]
        low = min(side @ np.asarray(drawing.view.up) for side in np.concatenate(sides))
        right = np.array([x, 0, THICK]) @ np.asarray(drawing.view.up)
        assert low == pytest.approx(right, abs=2 * drawing.accuracy.used)


def test_the_circle_where_it_enters_is_drawn():
    drawing = hlr.draw(model(), VIEW, **AT_SIZE)
    found = of_kind(drawing, "intersection")
    points = np.concatenate([line.points3 for line in found])
    near = drawing.accuracy.used
    assert np.abs(np.hypot(points[:, 0], points[:, 1]) - SHANK).max() < near
    assert np.abs(np.abs(points[:, 2]) - THICK).max() < near
    seen = np.concatenate([line.points3 for line in found if line.visible])
    # Upon the plate, on the side of the viewer; the other half lies behind the shank.
    assert (seen[:, 2] > 0).all() and seen[:, 1].max() < near
    length = sum(np.linalg.norm(np.diff(line.points3, axis=0), axis=1).sum() for line in found if line.visible)
    # Beside the two generators the contact tolerance decides.
    assert length == pytest.approx(np.pi * SHANK, rel=0.03)
