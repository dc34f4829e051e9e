"""Faces of different parts in one plane, shaded: a label in a block, a bush in a plate.

Their corners lie elsewhere, and each is rounded to the grid of the picture. The part that comes first is shown all
over: where depths followed the rounded corners, wedges and stripes of both parts took turns.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr

VIEWS = ["iso", (0.3, -1.0, 0.5)]
SIZES = [(600, 500), (97, 83)]

EDGE = 1
"""Pixels whose centre lies within a step of the grid, 1/256 pixel, of an edge: they may show the wall below it."""


def assembled(*parts):
    assembly = cq.Assembly()
    for name, shape in parts:
        assembly.add(shape, name=name)
    return assembly


def seen(source, **options):
    """How many pixels show each part, by name."""
    picture = hlr.preview(source, ids=True, **options)
    return {part.name: int((picture.part_ids == i).sum()) for i, part in enumerate(picture.parts)}


@pytest.mark.parametrize("perspective", [None, hlr.Perspective()])
@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("view", VIEWS)
def test_the_part_that_comes_first_is_shown_all_over(view, size, perspective):
    block = cq.Workplane().box(40, 30, 10)
    label = cq.Workplane().box(20, 10, 4).translate((3.3, 2.7, 3))
    plug = cq.Workplane().cylinder(10, 4).translate((-12, 7, 0))
    options = {"view": view, "size": size, "perspective": perspective}
    found = seen(assembled(("block", block), ("label", label), ("plug", plug)), **options)
    assert found["block"] > 2000 and found["label"] + found["plug"] <= EDGE
    found = seen(assembled(("label", label), ("plug", plug), ("block", block)), **options)
    alone = seen(assembled(("label", label), ("plug", plug), ("hidden", block.translate((0, 0, -1e-3)))), **options)
    for name in ("label", "plug"):
        assert found[name] == pytest.approx(alone[name], abs=10 * EDGE)


@pytest.mark.parametrize("view", VIEWS)
def test_a_bush_flush_with_its_plate_has_no_stripes(view):
    plate = cq.Workplane().box(40, 30, 10).faces(">Z").workplane().hole(16)
    bush = cq.Workplane().cylinder(10, 10)
    shaft = cq.Workplane().cylinder(20, 8)
    found = seen(assembled(("plate", plate), ("shaft", shaft), ("bush", bush)), view=view, size=(600, 500))
    assert found["plate"] > 50_000 and found["bush"] == 0


@pytest.mark.parametrize("scale", [0.01, 1.0, 1000.0])
@pytest.mark.parametrize("antialias", [False, True])
def test_a_sheet_a_millionth_above_a_plate_is_seen_whole(antialias, scale):
    """A plate of 400 mm, and on it a sheet that rises by a ten-thousandth of a millimetre."""
    plate = cq.Workplane().box(400 * scale, 300 * scale, scale)
    sheet = cq.Workplane().box(100 * scale, 100 * scale, scale).translate((-80 * scale, 30 * scale, 1e-4 * scale))
    assembly = cq.Assembly()
    assembly.add(plate, name="plate", color=cq.Color("white"))
    assembly.add(sheet, name="sheet", color=cq.Color("red"))
    picture = hlr.preview(assembly, view="iso", size=(600, 500), antialias=antialias, ids=True)
    own = picture.part_ids == 1
    # A square of 100 mm, seen along the diagonal of a cube.
    expected = (100 * scale * picture.scale) ** 2 / np.sqrt(3)
    assert own.sum() == pytest.approx(expected, rel=0.02)
    red = (picture.pixels[:, :, 1] < 100) & (picture.pixels[:, :, 0] > 150)
    assert red.sum() == pytest.approx(expected, rel=0.02)
