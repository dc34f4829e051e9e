"""Flat faces as B-spline surfaces, as converters of STEP and IGES write them: drawn and cut as planes are.

A plane of a section that steps is put on a flat face that it would run beside. The floor of a pocket was not known as
flat, and was hatched where the plane ran a millionth of a millimetre below it.
"""

from __future__ import annotations

from collections import Counter

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.source.cad.flat_faces import flat_heights
from support.at_size import AT_SIZE
from support.free_form import as_free_form, lengths

FLOOR = 2.0

STEPS = [
    (FLOOR + 3e-7, (0, 7.0)),
    (7.0, (0, FLOOR + 3e-7)),
    (FLOOR - 1e-6, (0, 7.0)),
    (7.0, (0, FLOOR - 1e-6)),
    (FLOOR - 4e-6, (0, 7.0)),
]


def block() -> cq.Shape:
    """With a pocket and a hole."""
    pocket = cq.Workplane().box(40, 30, 20).faces(">Z").workplane().rect(20, 10).cutBlind(FLOOR - 10)
    return pocket.faces("<Z").workplane().hole(6).val()


@pytest.mark.parametrize("section", STEPS)
def test_a_step_beside_the_floor_of_a_pocket(section: tuple[object, ...]) -> None:
    flat, free = (hlr.draw(shape, "top", section=section, **AT_SIZE) for shape in (block(), as_free_form(block())))
    assert lengths(free) == pytest.approx(lengths(flat), abs=0.5)
    assert Counter(line.kind for line in flat.lines) == Counter(line.kind for line in free.lines)
    assert flat.notes == free.notes


def test_views_show_no_more_lines() -> None:
    for view in ("iso", "front", (0.3, -0.5, 0.7)):
        flat, free = (hlr.draw(shape, view, **AT_SIZE) for shape in (block(), as_free_form(block())))
        assert lengths(free) == pytest.approx(lengths(flat), abs=0.5)


def test_a_turned_block_has_the_same_flat_faces() -> None:
    turned = block().rotate(cq.Vector(), cq.Vector(1, 2, 3), 37).translate(cq.Vector(100, 200, 300))
    for face in turned.Faces():
        if face.geomType() == "PLANE":
            way = np.array(face.normalAt().toTuple())
            flat, free = (np.sort(flat_heights(s.wrapped, way)) for s in (turned, as_free_form(turned)))
            assert len(flat) and free == pytest.approx(flat, abs=1e-9)


def test_a_bent_face_whose_corners_are_level_is_not_flat() -> None:
    arch = cq.Workplane("XZ").moveTo(-5, 0).threePointArc((0, 2), (5, 0)).lineTo(-5, 0).close().extrude(8).val()
    up = np.array([0.0, 0.0, 1.0])
    assert flat_heights(as_free_form(arch).wrapped, up) == pytest.approx([0.0])
